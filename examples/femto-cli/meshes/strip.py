#!/usr/bin/env python3
"""Makes strip.msh: a strip with a notch in one edge, to be torn, as one tetrahedral mesh.

Run as snowman.py says. Made with Gmsh 4.15.0 (gmsh from PyPI), numpy 2.4.6, Python 3.11, x86-64:
1,164 nodes, 3,546 tets.

The body, in metres: 0 to 1 along x, 0 to 0.4 along y, 0.04 thick; the notch, a wedge of 0.06 by 0.12, is in the middle
of the upper edge.
"""

import tets

SIZE = 0.035  # edge length aimed at
NODES = 1164


def build(occ):
    outline = [(0, 0), (1, 0), (1, 0.4), (0.53, 0.4), (0.5, 0.28), (0.47, 0.4), (0, 0.4)]
    points = [occ.addPoint(x, y, -0.02) for x, y in outline]
    lines = [occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
    face = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    return [body for body in occ.extrude([(2, face)], 0, 0, 0.04) if body[0] == 3]


if __name__ == "__main__":
    tets.run(__file__, NODES, SIZE, build)
