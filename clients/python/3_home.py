"""3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
switch that closes at a known position. Searching for it tells where the joint is.

    python3 3_home.py [HOST [PORT]]
"""

import sys

import xr3

# Counts at which the switches close, from the soft home: upper arm upright, forearm level, tool
# down. Seen from there each is open before this count, and closed from it on: for a few dozen
# counts on a real arm, for longer in the simulator. The jaws, joint A, come first: they show how a
# closed switch reads. The elbow follows, since it lifts the hand off the table.
SWITCHES = {"A": -16, "D": 40, "E": -40, "C": 40, "B": -25, "F": 30}

# One byte reports several switches: I those of joints C to F, J those of A and B. Each has one bit.
BITS = {"D": ("I", 2), "E": ("I", 4), "C": ("I", 1), "B": ("J", 32), "F": ("I", 8), "A": ("J", 16)}

STEP = 10  # counts of one move of the search; a switch stays closed for longer
FAR = 1600  # more counts than any joint has from a limit to its switch
LEAN = 400  # counts forward that bring the shoulder out of its backmost position

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


def search(joint, away):
    """Moves until the switch closes, usually away from the soft home first. Returns False if it
    does not close."""
    if joint == "E":  # forwards first: a shoulder that leans back folds the arm into its base
        return changes("E", STEP, LEAN) or changes("E", -STEP, 2 * FAR)
    if changes(joint, STEP * away, FAR):
        return True
    if joint == "D":  # the shoulder may lean far back: it must not when the forearm comes down
        changes("E", STEP, LEAN)
    return changes(joint, -STEP * away, 2 * FAR)


def find_near_edge(joint):
    """Moves to the count at which the switch closes. Returns False if it does not change."""
    away = 1 if SWITCHES[joint] > 0 else -1
    if read_switch(joint) != closed and not search(joint, away):
        return False
    # Back until the switch opens, and then count by count until it closes.
    return changes(joint, -STEP * away, FAR) and changes(joint, away, FAR)


# The open jaws are at the end of their travel, and on their switch. It opens when they close.
changes("A", -STEP, FAR)
closed = read_switch("A")  # the reading of a closed switch, 0 or 1

# A shoulder on its switch may lean far back: it comes forward before the forearm moves.
if read_switch("E") == closed:
    find_near_edge("E")

for joint, place in SWITCHES.items():
    if not find_near_edge(joint):
        sys.exit(f"the switch of {joint} does not change. Is the joint blocked at a limit, or the "
                 "arm stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 "
                 "with its own workcell)")
    print(f"{joint} is on its switch, at {place:+d}")

# All switches at once. J also reports four input lines, in its bits 1 to 8.
i, j = robot.ask("I") - 32, (robot.ask("J") - 32) & 48
print(f"a closed switch reads {closed}; the switches of I are {i}, those of J {j}")

# The soft home is at count 0: move each joint back by the count of its switch.
for joint, place in SWITCHES.items():
    if step(joint, -place) > 0:
        sys.exit(f"{joint} stopped short of the soft home. Look at the page or at `xr3 watch`")
print("at the soft home")

robot.close()
