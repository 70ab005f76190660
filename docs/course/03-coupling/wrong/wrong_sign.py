# expects: joint: it is at 94.994 degrees
"""Moves D and C with the shoulder in step 3, instead of against it."""

import xr3

with xr3.Robot() as robot:
    robot.go({"E": 176, "D": -176, "C": 264})
    robot.go({"E": 308})
    robot.go({"E": 220, "D": -264, "C": 176})
