"""Exercise 7, by Eva: turned the base the wrong way with the block, and opened the jaws in the air."""

import xr3

arm = xr3.connect()
arm.go({"A": -16})
arm.go({"F": 71, "E": 381, "D": -343, "B": 260})
arm.go({"E": 543, "D": -479})
arm.send("A+90\r")
arm.at["A"] += 90 - arm.wait("A")
arm.go({"E": 381, "D": -343})
arm.go({"F": 320})
arm.go({"A": -16})
print("green is at its goal")
arm.close()
