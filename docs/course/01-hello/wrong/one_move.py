# expects: no_warnings: number_out_of_range
"""Sends all 140 counts at once: a move has at most 127."""

import xr3

robot = xr3.connect()
robot.ask("E?")
robot.send("E+140\r")
robot.wait("E")
robot.close()
