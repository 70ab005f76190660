"""Exercise 7, by Gita: a typing error, which Python finds only when it comes to this line."""

import sys

import xr3

ABOVE = {"green": {"F": 71, "E": 381, "D": -343, "B": 260}}
sys.tracebacklimit = 0  # only the last line of a message

arm = xr3.connect()
arm.go({"A": -16})
arm.go(ABOVE["green"])
print("above green")
arm.go(ABOVE["gren"])
