"""3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
switch that closes at one place of its way. Looking for that place is how a robot finds out.

    python3 3_home.py [HOST [PORT]]
"""

import sys

import xr3

# Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool down.
# The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
SWITCHES = {"D": 40, "E": -40, "C": 40, "B": -25, "F": 30, "A": 16}
FARTHEST = 2500  # no joint has so many counts to go from one end of its way to the other

robot = xr3.connect()


def is_closed(joint):
    return robot.ask(joint + "V") == 1  # this answer is a plain 0 or 1, nothing is added


def step(joint, counts):
    """Moves the joint and returns how many counts were left, if it could not go on."""
    robot.send(f"{joint}{counts:+d}\r")
    return robot.wait(joint)  # asks as in example 2, and stops a joint that stands


def search(joint, counts, closed):
    """Steps of so many counts until the switch is as wanted: closed, or open."""
    gone = 0
    while is_closed(joint) != closed:
        left = step(joint, counts)
        gone += abs(counts) - left
        if left == abs(counts) or gone > FARTHEST:
            sys.exit(f"{joint} went {gone} counts and found no switch. Is it blocked at a limit, "
                     "or stalled? Does time stand? (The examples 3 to 6 are for the Rhino XR-3 "
                     "with its own workcell, in the profile paper)")


# A robot may tell of its switches the other way round. I shows it: the highest of its six bits
# belongs to no switch, and should be 0.
if robot.ask("I") - 32 >= 32:
    sys.exit("the switches of D and of all other joints tell 1 when they are open, as in the "
             "profile mark3. This example is for the profile paper")


for joint, place in SWITCHES.items():
    way = 1 if place > 0 else -1
    search(joint, 5 * way, True)  # quickly, until the switch closes
    search(joint, -5 * way, False)  # back, until it opens again
    search(joint, way, True)  # slowly: now we know to the count where it closes
    print(f"{joint} stands on its switch, at {place:+d}")

# All switches at once: I tells of joints C to F, J of A and B.
print(f"switches closed: {robot.ask('I') - 32} of I, {robot.ask('J') - 32} of J")

# From here the soft home is as far away as the switches are from it.
for joint, place in SWITCHES.items():
    if step(joint, -place) > 0:
        sys.exit(f"{joint} stands and is not at the soft home. Look at the page or at `xr3 watch`")
print("at the soft home")

robot.close()
