"""3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
switch that closes at a known position. Searching for it tells where the joint is.

    python3 3_home.py [HOST [PORT]]
"""

import sys

import xr3

# Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool down.
# The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
SWITCHES = {"D": 40, "E": -40, "C": 40, "B": -25, "F": 30, "A": 16}
FARTHEST = 2500  # more counts than the full travel of any joint

robot = xr3.connect()


def is_closed(joint):
    return robot.ask(joint + "V") == 1  # this answer is 0 or 1, without the 32


def step(joint, counts):
    """Moves the joint and returns the counts that were left, 0 if it has arrived."""
    robot.send(f"{joint}{counts:+d}\r")
    return robot.wait(joint)  # as in example 2; cancels the move of a blocked joint


def search(joint, counts, closed):
    """Moves in steps of `counts` until the switch is closed (True) or open (False)."""
    gone = 0
    while is_closed(joint) != closed:
        left = step(joint, counts)
        gone += abs(counts) - left
        if left == abs(counts) or gone > FARTHEST:
            sys.exit(f"{joint} went {gone} counts and found no switch. Is it blocked at a limit, "
                     "or stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino "
                     "XR-3 with its own workcell, in the profile paper)")


# Some controllers report their switches inverted. The answer to I shows it: the highest of its six
# bits belongs to no switch and should be 0.
if robot.ask("I") - 32 >= 32:
    sys.exit("the switches of D and of all other joints read 1 when they are open, as in the "
             "profile mark3. This example is for the profile paper")


for joint, place in SWITCHES.items():
    way = 1 if place > 0 else -1
    search(joint, 5 * way, True)  # quickly, until the switch closes
    search(joint, -5 * way, False)  # back, until it opens again
    search(joint, way, True)  # slowly, to find the exact count at which it closes
    print(f"{joint} is on its switch, at {place:+d}")

# All switches at once: I reports joints C to F, J reports A and B.
print(f"switches closed: {robot.ask('I') - 32} of I, {robot.ask('J') - 32} of J")

# The soft home is at count 0: move each joint back by the count of its switch.
for joint, place in SWITCHES.items():
    if step(joint, -place) > 0:
        sys.exit(f"{joint} stopped short of the soft home. Look at the page or at `xr3 watch`")
print("at the soft home")

robot.close()
