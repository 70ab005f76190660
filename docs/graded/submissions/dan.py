"""Exercise 7, by Dan: has the wrong sign for the shoulder, so the arm folds back over its own base."""

import xr3

arm = xr3.connect()
arm.go({"A": -16, "F": 71, "B": 260})
for part in -120, -120, -120:
    arm.send(f"E{part:+d}\r")
    left = arm.wait("E")
    print("shoulder:", left, "counts left")
arm.close()
