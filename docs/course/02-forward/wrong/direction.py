# expects: tip: it is at x 255.5, y 147.2, z 210.4 mm
"""Forgets that the elbow's angle gets smaller as its count gets larger."""

import math

import xr3
from xr3.kinematics import product


def link(theta, d, a, alpha):
    """The link matrix of one row of the table."""
    ct, st, ca, sa = (f(math.radians(angle)) for angle in (theta, alpha) for f in (math.cos, math.sin))
    return [[ct, -ca * st, sa * st, a * ct], [st, ca * ct, -sa * ct, a * st], [0, sa, ca, d], [0, 0, 0, 1]]


def height(f, e, d, c, b):
    """The z of the tip."""
    rows = ((0.2269 * f, 260.4, 0, -90), (-90 + 0.1135 * e, 0, 228.6, 0), (90 + 0.1135 * (d + e), 0, 228.6, 0),
            (0.1135 * (d - c), 0, 9.5, -90), (-90 + 0.3125 * b, 168.3, 0, 0))
    result = link(*rows[0])
    for row in rows[1:]:
        result = product(result, link(*row))
    return result[2][3]


c = min(range(0, 500), key=lambda c: abs(height(132, 176, -220, c, 96) - 250))
with xr3.Robot() as robot:
    robot.go({"F": 132, "E": 176, "D": -220, "C": c, "B": 96})
