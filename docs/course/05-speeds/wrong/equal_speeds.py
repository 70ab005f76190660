# expects: keep_out: it was at
"""Both joints run at the same speed. The shoulder is ahead, and the tip swings to the left."""

import xr3

robot = xr3.connect(arm=xr3.ADEPT_ONE)
for part in range(1, 10 + 1):
    for label, counts in ("E", 470), ("D", 1029):
        robot.move(label, counts * part // 10 - counts * (part - 1) // 10)
    robot.wait("E")
    robot.wait("D")
robot.close()
