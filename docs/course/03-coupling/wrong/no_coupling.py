# expects: joint: it is at 55.042 degrees
"""Computes D and C from theta3 = 90 and theta4 = -50 alone, as if each motor turned its own joint only."""

import xr3

with xr3.Robot() as robot:
    robot.go({"E": 176, "D": 0, "C": 440})
    robot.go({"E": 308})
    robot.go({"E": 220, "D": 88, "C": 528})
