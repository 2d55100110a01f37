#!/usr/bin/env python3
"""Makes snowman.msh: three fused spheres as one tetrahedral mesh.

Run:

    apt-get install libglu1-mesa libxft2 libxinerama1 libxcursor1   # Debian 12
    python3 -m venv venv
    venv/bin/pip install gmsh==4.15.0 numpy==2.4.6
    venv/bin/python snowman.py [OUT.msh]

Made with Gmsh 4.15.0 (gmsh from PyPI), numpy 2.4.6, Python 3.11, x86-64:
509 nodes, 1,716 tets, in a file of format 4.1 (ASCII). Runs with these versions
give the same bytes each time; another Gmsh version may give other counts.

The body, in metres: spheres of radius 0.28, 0.20 and 0.14, centred on the y axis
at y = 0.28, 0.62 and 0.86. Up is +y, the lowest node is at y = 0 and the highest
at y = 1.
"""

import math

import tets

SPHERES = [(0.28, 0.28), (0.62, 0.20), (0.86, 0.14)]  # (height of centre, radius)
SIZE = 0.0733  # edge length aimed at


def build(occ):
    # A sphere's poles and seam lie along z. Stacked along z, the spheres meet in
    # circles of latitude; the whole is then turned so that z becomes y.
    balls = [(3, occ.addSphere(0, 0, z, r)) for z, r in SPHERES]
    body, _ = occ.fuse(balls[:1], balls[1:])
    occ.rotate(body, 0, 0, 0, 1, 0, 0, -math.pi / 2)
    return body


if __name__ == "__main__":
    tets.run(__file__, 509, SIZE, build)
