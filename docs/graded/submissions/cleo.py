"""Exercise 7, by Cleo: the ends of the lines are missing, so the robot waits for more digits."""

import xr3

arm = xr3.connect()
for move in "F+71", "E+120", "D-120":
    arm.send(move)
    print("sent", move)
arm.close()
