"""Exercise 3: three motors that each turn one link in space, whatever the others do."""

import xr3

PRECISION = 0.1135  # degrees a count, of E, D and C


def counts(degrees):
    """The nearest whole number of counts."""
    return round(degrees / PRECISION)


robot = xr3.Robot()
at = {"E": 0, "D": 0, "C": 0}


def step(what, **add):
    """Adds counts to motors, moves, and prints the joint angles that follow."""
    for label, number in add.items():
        at[label] += number
    robot.go(at)
    theta = (-90 + PRECISION * at["E"], 90 - PRECISION * (at["D"] + at["E"]), PRECISION * (at["D"] - at["C"]))
    print(what, at, "theta2, 3, 4:", *(f"{angle:.2f}" for angle in theta))


# Each motor sets the direction of its own link: forward is E+, up is D+, outwards is C+.
step("1.", E=counts(20), D=counts(-20), C=counts(30))
# The belts keep forearm and hand as they are.
step("2.", E=counts(15))
# As one piece: theta3 and theta4 stay, so D goes against E, and C with D.
step("3.", E=counts(-10), D=-counts(-10), C=-counts(-10))
robot.close()
