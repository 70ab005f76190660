# expects: keep_out: it was at
"""Gives each joint the speed of the other one: the shoulder is still further ahead."""

import xr3

robot = xr3.connect(arm=xr3.ADEPT_ONE)
robot.set_speed("E", 220)
robot.set_speed("D", 100)
for part in range(1, 10 + 1):
    for label, counts in ("E", 470), ("D", 1029):
        robot.move(label, counts * part // 10 - counts * (part - 1) // 10)
    robot.wait("E")
    robot.wait("D")
robot.close()
