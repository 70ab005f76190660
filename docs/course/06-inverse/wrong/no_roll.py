# expects: block: its yaw is
"""Leaves the last joint alone, so the pin turns with the arm."""

import math

import xr3

A1, A2 = 425, 375  # lengths of the two links, mm
TOP, HAND = 877, 200  # height of the arm, length from the slide to the tip, mm
OPEN = -40  # count of A at which the jaws are wide open


def angles(x, y, elbow):
    """The angles theta1 and theta2 in degrees for a place on the table. elbow is +1 or -1."""
    cosine = (x * x + y * y - A1 * A1 - A2 * A2) / (2 * A1 * A2)
    if not -1 <= cosine <= 1:
        raise SystemExit(f"x {x}, y {y} mm is out of reach")
    bend = elbow * math.acos(cosine)  # from the first link to the second, seen from above
    first = math.atan2(y, x) - math.atan2(A2 * math.sin(bend), A1 + A2 * math.cos(bend))
    return math.degrees(first), -math.degrees(bend)  # frame 2 hangs upside down: hence the minus


def near(angle):
    """The same direction, from -180 to 180 degrees."""
    return math.remainder(angle, 360)


def counts(x, y, z, yaw):
    """The motor counts from the soft home, for the first elbow that is within the limits."""
    for elbow in (-1, 1):
        theta1, theta2 = angles(x, y, elbow)
        theta1 = near(theta1)
        if abs(theta1) <= 150 and abs(theta2) <= 147:
            d3 = TOP - HAND - z
            return {"E": round(theta1 / 0.1), "D": round(theta2 / 0.1),
                    "C": round((d3 - 100) / 0.5)}
    raise SystemExit(f"x {x}, y {y} mm: both elbows are past a limit")


robot = xr3.connect(arm=xr3.ADEPT_ONE)
robot.go({"A": OPEN})
robot.go(counts(500, 300, 620, 0))  # above point 1
robot.go(counts(500, 300, 520, 0))
print("point 1:", robot.at)
robot.close_jaws()
robot.go(counts(500, 300, 620, 0))
robot.go(counts(300, -450, 620, 0))  # above point 2
robot.go(counts(300, -450, 520, 0))
print("point 2:", robot.at)
robot.go({"A": OPEN})
robot.go(counts(300, -450, 620, 0))
robot.go(counts(-420, -300, 650, 0))
print("point 3:", robot.at)
robot.close()
