# expects: joint: it is at -116 counts
"""Starts the second move before the first one has ended: the 8-bit counter wraps."""

import xr3

robot = xr3.connect()
robot.ask("E?")
robot.send("E+50\r")
robot.send("E+90\r")
robot.wait("E")
robot.close()
