# expects: joint: it is at 110 counts
"""Goes from count to count without the switches: what has slipped in the first moves stays."""

import xr3

with xr3.Robot() as robot:
    robot.go({"F": 60, "E": 60, "D": -60, "C": 60, "B": 60})
    robot.go({"F": 100, "E": 150, "D": -100, "C": 50, "B": 96})
