"""Exercise 2: forward kinematics by link matrices, and a search with them."""

import math

import xr3

HEIGHT = 250  # mm


def link(theta, d, a, alpha):
    """The link matrix of one row of the Denavit-Hartenberg table: degrees and mm."""
    ct, st = math.cos(math.radians(theta)), math.sin(math.radians(theta))
    ca, sa = math.cos(math.radians(alpha)), math.sin(math.radians(alpha))
    return [[ct, -ca * st, sa * st, a * ct],
            [st, ca * ct, -sa * ct, a * st],
            [0, sa, ca, d],
            [0, 0, 0, 1]]


def product(left, right):
    """The product of two matrices."""
    return [[sum(left[i][k] * right[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def tool(counts):
    """T(0,5), the tool frame at these motor counts: the links from the base to the tool."""
    f, e, d, c, b = (counts[label] for label in "FEDCB")
    result = link(0.2269 * f, 260.4, 0, -90)
    for row in ((-90 + 0.1135 * e, 0, 228.6, 0),
                (90 - 0.1135 * (d + e), 0, 228.6, 0),
                (0.1135 * (d - c), 0, 9.5, -90),
                (-90 + 0.3125 * b, 168.3, 0, 0)):
        result = product(result, link(*row))
    return result


def tip(counts):
    """The tool tip, mm: the last column."""
    return [row[3] for row in tool(counts)[:3]]


# Angles to counts: subtract the home value, divide by the degrees of a count, round.
goal = {"F": round(30 / 0.2269), "E": round((-70 + 90) / 0.1135), "D": -220, "C": 0,
        "B": round((-60 + 90) / 0.3125)}
print("hand straight down:", goal, "tip", [round(mm, 1) for mm in tip(goal)])

# A larger C turns the hand outwards. Of all C, the one whose tip is nearest to the height.
goal["C"] = min(range(0, 500), key=lambda c: abs(tip({**goal, "C": c})[2] - HEIGHT))
print("hand outwards:", goal, "tip", [round(mm, 1) for mm in tip(goal)])

with xr3.Robot() as robot:
    robot.go(goal)
