"""Exercise 3: move upper arm, forearm and hand in three steps, and print theta2, theta3 and theta4 after each of them.

The sheet says for each step which directions change, and which angles or directions stay."""

import xr3

PRECISION = 0.1135  # degrees a count, of E, D and C

robot = xr3.Robot()
at = {"E": 0, "D": 0, "C": 0}  # counts from the soft home


def step(what, **add):
    """Adds counts to motors, and moves."""
    for label, number in add.items():
        at[label] += number
    robot.go(at)
    print(what, at)  # TODO: and theta2, theta3 and theta4


step("1.", E=0, D=0, C=0)  # TODO: the counts of step 1

# TODO: steps 2 and 3.
robot.close()
