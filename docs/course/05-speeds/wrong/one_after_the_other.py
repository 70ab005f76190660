# expects: keep_out: it was at
"""Moves the shoulder to its end, and then the elbow: the tip makes two large arcs."""

import xr3

with xr3.Robot(arm=xr3.ADEPT_ONE) as robot:
    robot.go({"E": 470})
    robot.go({"D": 1029})
