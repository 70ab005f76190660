# expects: joint: it is at 140 counts
"""Stops at the first step of 10 that finds the switch closed: the edge is up to 9 counts away."""

import sys

import xr3

EDGES = {"D": 40, "E": -40, "C": 40, "B": -25, "F": 30}
BITS = {"B": ("J", 32), "C": ("I", 1), "D": ("I", 2), "E": ("I", 4), "F": ("I", 8)}
AWAY = {"D": 1, "E": -1, "C": 1, "B": -1, "F": 1}

robot = xr3.connect()


def is_closed(label):
    """Whether the joint's switch is closed."""
    inquiry, bit = BITS[label]
    return (robot.ask(inquiry) - 32) & bit != 0


def creep(label, counts, value):
    """Moves in steps of these counts until the switch is closed, or open."""
    while is_closed(label) != value:
        robot.move(label, counts)
        if robot.wait(label):
            sys.exit(f"{label} stands")


for joint, first in {"F": 60, "E": 60, "D": -60, "C": 60, "B": 60}.items():
    robot.move(joint, first)
    robot.wait(joint)
for joint, away in AWAY.items():
    creep(joint, 10 * away, True)
robot.at.update(EDGES)
robot.go({"F": 100, "E": 150, "D": -100, "C": 50, "B": 96})
robot.close()
