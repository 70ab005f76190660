# expects: max_sim_seconds: it was after
"""Cuts the way into 60 moves, and waits for each of them: on the line, but slow."""

import xr3

robot = xr3.connect(arm=xr3.ADEPT_ONE)
for part in range(1, 60 + 1):
    for label, counts in ("E", 470), ("D", 1029):
        robot.move(label, counts * part // 60 - counts * (part - 1) // 60)
    robot.wait("E")
    robot.wait("D")
robot.close()
