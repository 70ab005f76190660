"""3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
switch that closes at a known position. Searching for it tells where the joint is.

    python3 3_home.py [HOST [PORT]]
"""

import sys

import xr3

# Where the switches close, in counts from the soft home: upper arm upright, forearm level, tool
# down. Seen from there each is open before this count, and closed from it on: for a few dozen
# counts on a real arm, for longer in the simulator. The elbow comes first, since it lifts the hand
# off the table; the jaws, joint A, come last.
SWITCHES = {"D": 40, "E": -40, "C": 40, "B": -25, "F": 30, "A": 16}

# One byte reports several switches: I those of joints C to F, J those of A and B. Each has one bit.
BITS = {"D": ("I", 2), "E": ("I", 4), "C": ("I", 1), "B": ("J", 2), "F": ("I", 8), "A": ("J", 1)}

STEP = 10  # counts of one move of the search; a switch stays closed for longer
WIDEST = 100  # more counts than a switch of a real arm stays closed
FAR = 1600  # more counts than any joint has from a limit to its switch

# How far to search away from the soft home before trying the other direction. The shoulder must not
# lean far back, or the hand hits the base.
REACH = {"D": FAR, "E": 60, "C": FAR, "B": FAR, "F": FAR, "A": FAR}

robot = xr3.connect()


def read_switch(joint):
    """The bit of the joint's switch. Some controllers report a closed switch as 1, others as 0."""
    inquiry, bit = BITS[joint]
    return 1 if (robot.ask(inquiry) - 32) & bit else 0


def step(joint, counts):
    """Moves the joint and returns the counts that were left, 0 if it has arrived."""
    robot.send(f"{joint}{counts:+d}\r")
    return robot.wait(joint)  # as in example 2; cancels the move of a blocked joint


def changes(joint, counts, farthest):
    """Moves in steps of `counts` until the switch changes. Returns False if it does not within
    `farthest` counts, or before the joint is blocked."""
    before = read_switch(joint)
    for _ in range(farthest // abs(counts)):
        left = step(joint, counts)
        if read_switch(joint) != before:
            return True
        if left > 0:
            return False
    return False


def find_near_edge(joint, away):
    """Moves to the count at which the switch closes. Returns False if it does not change."""
    # Watch the switch change, at whichever edge: first in one direction, then in the other. If it
    # reads like the closed ones before, the near edge lies towards the soft home.
    way, reach = away, REACH[joint]
    if read_switch(joint) == closed:
        way, reach = -away, FAR
    if not (changes(joint, STEP * way, reach) or changes(joint, -STEP * way, 2 * FAR)
            or changes(joint, STEP * way, 2 * FAR)):
        return False

    # Move towards the soft home until the switch has not changed for a long way: now it is open.
    while changes(joint, -STEP * away, WIDEST):
        pass

    # Quickly up to the near edge, back again, and then count by count.
    return (changes(joint, STEP * away, FAR) and changes(joint, -STEP * away, FAR)
            and changes(joint, away, FAR))


closed = None  # what a closed switch reads, 0 or 1: not known until the first one has changed
for joint, place in SWITCHES.items():
    if not find_near_edge(joint, 1 if place > 0 else -1):
        sys.exit(f"the switch of {joint} does not change. Is the joint blocked at a limit, or the "
                 "arm stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 "
                 "with its own workcell)")
    closed = read_switch(joint)
    print(f"{joint} is on its switch, at {place:+d}")

# All switches at once. J also reports four input lines, in its bits 4 to 32.
i, j = robot.ask("I") - 32, (robot.ask("J") - 32) & 3
print(f"a closed switch reads {closed}; the switches of I are {i}, those of J {j}")

# The soft home is at count 0: move each joint back by the count of its switch.
for joint, place in SWITCHES.items():
    if step(joint, -place) > 0:
        sys.exit(f"{joint} stopped short of the soft home. Look at the page or at `xr3 watch`")
print("at the soft home")

robot.close()
