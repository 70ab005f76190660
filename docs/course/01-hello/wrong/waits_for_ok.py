# expects: failed
"""Reads a reply to a move. There is none, and after a while the program gives up."""

import xr3

robot = xr3.Robot(timeout_s=1)
for counts in 50, 90:
    robot.send(f"E+{counts}\r")
    print("the robot says", robot.read(2))
robot.close()
