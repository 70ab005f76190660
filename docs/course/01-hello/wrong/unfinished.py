# expects: joint: it is at 50 counts
"""Forgets the end of the line. The wait of the first move ends its number, but nothing ends the second one."""

import xr3

robot = xr3.connect()
robot.send("E+50")
robot.wait("E")
robot.send("E+90")
robot.close()
