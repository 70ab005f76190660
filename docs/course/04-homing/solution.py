"""Exercise 4: find the arm with its microswitches."""

import sys

import xr3

STEP = 10  # counts of a move in the search; a switch stays closed for longer
FAR = 1600  # more counts than any joint has
# The count of each switch's near edge, seen from the soft home, and its bit in the reply to I or J. The
# jaws are first, because they show how a closed switch reads; the elbow lifts the hand off the table.
EDGES = {"A": -16, "D": 40, "E": -40, "C": 40, "B": -25, "F": 30}
BITS = {"A": ("J", 16), "B": ("J", 32), "C": ("I", 1), "D": ("I", 2), "E": ("I", 4), "F": ("I", 8)}

robot = xr3.connect()


def reads(label):
    """The bit of the joint's switch."""
    inquiry, bit = BITS[label]
    return bool((robot.ask(inquiry) - 32) & bit)


def creep(label, counts, value):
    """Moves in steps of these counts until the switch reads `value`. False if the joint stops before."""
    for _ in range(FAR // abs(counts)):
        if reads(label) == value:
            return True
        robot.move(label, counts)
        if robot.wait(label) > 0:  # at a limit
            return reads(label) == value
    return False


def find_edge(label):
    """Brings the joint to the count at which its switch closes on the way from the soft home."""
    away = 1 if EDGES[label] > 0 else -1
    found = creep(label, STEP * away, closed) or creep(label, -STEP * away, closed)
    if not (found and creep(label, -STEP * away, not closed) and creep(label, away, closed)):
        sys.exit(f"the switch of {label} does not change")
    print(f"{label} is at {EDGES[label]:+d}")


# The belts of a cold arm slip: after this nobody knows where it is.
for joint, first in {"F": 60, "E": 60, "D": -60, "C": 60, "B": 60}.items():
    robot.move(joint, first)
    robot.wait(joint)

# Jaws that are open to their end are on their switch. So that is how a closed switch reads.
robot.move("A", -100)
robot.wait("A")
closed = reads("A")

for joint in EDGES:
    find_edge(joint)
robot.at = dict(EDGES)  # go() counts from here
robot.go(dict.fromkeys("FEDCBA", 0))
print("at the soft home")
robot.go({"F": 100, "E": 150, "D": -100, "C": 50, "B": 96})
robot.close()
