#!/usr/bin/env python3
"""Makes lump.msh: a ball, for clay, as one tetrahedral mesh.

Run as snowman.py says. Made with Gmsh 4.15.0 (gmsh from PyPI), numpy 2.4.6, Python 3.11, x86-64:
326 nodes, 1,134 tets.

The body, in metres: a ball of radius 0.3 around (0, 0.3, 0).
"""

import math

import tets

RADIUS = 0.3
SIZE = 0.085  # edge length aimed at
NODES = 326


def build(occ):
    ball = occ.addSphere(0, 0, RADIUS, RADIUS)
    # Its poles, along z, come to lie along y.
    occ.rotate([(3, ball)], 0, 0, 0, 1, 0, 0, -math.pi / 2)
    return [(3, ball)]


if __name__ == "__main__":
    tets.run(__file__, NODES, SIZE, build)
