"""3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
switch that closes at one place of its way. Looking for that place is how a robot finds out.

    python3 3_home.py [HOST [PORT]]
"""

import sys

import xr3

# Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool down.
# The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
SWITCHES = {"D": 40, "E": -40, "C": 40, "B": -25, "F": 30, "A": 16}

robot = xr3.Robot(*sys.argv[1:3])


def is_closed(joint):
    return robot.ask(joint + "V") == 1  # this answer is a plain 0 or 1, nothing is added


def step(joint, counts):
    robot.send(f"{joint}{counts:+d}\r")
    robot.wait(joint)  # asks as in example 2, and stops the joint if it cannot go on


for joint, place in SWITCHES.items():
    way = 1 if place > 0 else -1
    while not is_closed(joint):  # quickly, until the switch closes
        step(joint, 5 * way)
    while is_closed(joint):  # back, until it opens again
        step(joint, -way)
    while not is_closed(joint):  # slowly: now we know to the count where it closes
        step(joint, way)
    print(f"{joint} stands on its switch, at {place:+d}")

# All switches at once: I tells of joints C to F, J of A and B.
print(f"switches closed: {robot.ask('I') - 32} of I, {robot.ask('J') - 32} of J")

# From here the soft home is as far away as the switches are from it.
for joint, place in SWITCHES.items():
    step(joint, -place)
print("at the soft home")

robot.close()
