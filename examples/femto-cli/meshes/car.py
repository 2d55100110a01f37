#!/usr/bin/env python3
"""Makes car.msh: a car-like body of four metres, wheels included, in one piece.

Run as snowman.py. 4,739 nodes, 19,885 tets, made with Gmsh 4.15.0 (gmsh from PyPI), numpy 2.4.6, Python 3.11, x86-64.

A side view with bonnet, windscreen, roof and tail is pulled across the width; four wheels are fused to
it. The car points to +x, up is +y, the wheels stand on y = 0.
"""

import tets

# Side view, metres: (x, y), from the lower rear corner round.
SIDE = [
    (-2.0, 0.35),
    (2.0, 0.35),
    (2.05, 0.62),
    (1.95, 0.80),
    (0.95, 0.90),
    (0.35, 1.35),
    (-0.95, 1.38),
    (-1.65, 0.95),
    (-2.05, 0.90),
]
WIDTH = 1.6
WHEEL = 0.35  # radius
AXLES = [-1.3, 1.3]
TYRE = 0.25  # width
SIZE = 0.114  # edge length aimed at


def build(occ):
    points = [occ.addPoint(x, y, -WIDTH / 2) for x, y in SIDE]
    lines = [occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
    side = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    made = occ.extrude([(2, side)], 0, 0, WIDTH)
    hull = [entity for entity in made if entity[0] == 3]
    wheels = [
        (3, occ.addCylinder(x, WHEEL, z, 0, 0, TYRE, WHEEL))
        for x in AXLES
        for z in (-WIDTH / 2 - TYRE / 5, WIDTH / 2 - 4 * TYRE / 5)
    ]
    body, _ = occ.fuse(hull, wheels)
    return body


if __name__ == "__main__":
    tets.run(__file__, 4734, SIZE, build)
