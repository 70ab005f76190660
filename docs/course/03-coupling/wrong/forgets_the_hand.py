# expects: joint: it is at -39.952 degrees
"""Keeps the elbow's angle in step 3, and forgets that the elbow's motor turns the hand against the forearm."""

import xr3

with xr3.Robot() as robot:
    robot.go({"E": 176, "D": -176, "C": 264})
    robot.go({"E": 308})
    robot.go({"E": 220, "D": -88})
