#!/usr/bin/env python3
"""Makes bowling_pin.msh: a ten-pin bowling pin, scaled to a height of one metre.

Run as snowman.py. 476 nodes, 1,550 tets, made with Gmsh 4.15.0 (gmsh from PyPI), numpy 2.4.6, Python 3.11, x86-64.

A spline through twelve diameters of a ten-pin is revolved about the y axis. Up is +y, the lowest nodes
are at y = 0.
"""

import math

import tets

# (height, diameter) in inches, of a pin 15 inches high; the last is where the round top begins.
PROFILE = [
    (0.0, 2.25),
    (0.75, 2.83),
    (2.25, 3.91),
    (3.375, 4.51),
    (4.5, 4.77),
    (5.875, 4.56),
    (7.25, 3.7),
    (8.625, 2.47),
    (9.375, 1.96),
    (10.0, 1.80),
    (11.75, 2.10),
    (13.5, 2.55),
]
HEIGHT = 15.0
SIZE = 0.0505  # edge length aimed at


def build(occ):
    side = [occ.addPoint(d / 2 / HEIGHT, y / HEIGHT, 0) for y, d in PROFILE]
    top = occ.addPoint(0, 1.0, 0)
    foot = occ.addPoint(0, 0, 0)
    # A quarter of an ellipse closes the head.
    (y, d) = PROFILE[-1]
    head = [
        occ.addPoint(d / 2 / HEIGHT * math.cos(a), (y + (HEIGHT - y) * math.sin(a)) / HEIGHT, 0)
        for a in (math.pi / 8, math.pi / 4, 3 * math.pi / 8)
    ]
    curves = [
        occ.addLine(foot, side[0]),
        occ.addSpline(side),
        occ.addSpline([side[-1], *head, top]),
        occ.addLine(top, foot),
    ]
    half = occ.addPlaneSurface([occ.addCurveLoop(curves)])
    made = occ.revolve([(2, half)], 0, 0, 0, 0, 1, 0, 2 * math.pi)
    return [entity for entity in made if entity[0] == 3]


if __name__ == "__main__":
    tets.run(__file__, 475, SIZE, build)
