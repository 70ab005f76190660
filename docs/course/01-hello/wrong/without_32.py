# expects: time_up
"""Waits for the byte 0. But the reply of a joint that has arrived is 32, so this never ends."""

import xr3

robot = xr3.connect()
robot.send("E+50\r")
while robot.ask("E?") != 0:
    pass
robot.send("E+90\r")
while robot.ask("E?") != 0:
    pass
robot.close()
