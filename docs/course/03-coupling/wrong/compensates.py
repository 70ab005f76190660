# expects: joint: it is at 90 degrees
"""Moves the elbow against the shoulder in step 2. The belt has kept the forearm's direction; now it is lost."""

import xr3

with xr3.Robot() as robot:
    robot.go({"E": 176, "D": -176, "C": 264})
    robot.go({"E": 308, "D": -308})
    robot.go({"E": 220, "D": -220, "C": 352})
