# expects: no_warnings: speed_out_of_range
"""Asks for a speed over 255: the command is ignored, and the elbow keeps its old speed."""

import xr3

robot = xr3.connect(arm=xr3.ADEPT_ONE)
robot.set_speed("E", 137)
robot.send("D300S")
for part in range(1, 10 + 1):
    for label, counts in ("E", 470), ("D", 1029):
        robot.move(label, counts * part // 10 - counts * (part - 1) // 10)
    robot.wait("E")
    robot.wait("D")
robot.close()
