# expects: joint: it is at 85.006 degrees
"""Moves the shoulder alone in step 3. Forearm and hand keep their directions, so the arm is no rigid piece."""

import xr3

with xr3.Robot() as robot:
    robot.go({"E": 176, "D": -176, "C": 264})
    robot.go({"E": 308})
    robot.go({"E": 220})
