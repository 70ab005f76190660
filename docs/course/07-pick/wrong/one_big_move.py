# expects: no_warnings: counter_overflow
"""Sends the way of a joint in two halves, and does not wait between them: more than the counter can hold."""

import sys

import xr3

# Motor counts from the soft home, by `xr3 kin --pose X,Y,Z --down YAW`. Above is 100 mm higher.
ABOVE_GREEN = {"F": 71, "E": 381, "D": -343, "C": 0, "B": 260}  # x 330, y 96, z 115, yaw 25
AT_GREEN = {"F": 71, "E": 543, "D": -479, "C": 0, "B": 260}  # z 15, half the height of the block
ABOVE_GREEN_GOAL = {"F": 0, "E": 489, "D": -245, "C": 0, "B": 0}  # x 400, y 0, yaw 90
AT_GREEN_GOAL = {"F": 0, "E": 632, "D": -358, "C": 0, "B": 0}
ABOVE_YELLOW = {"F": 144, "E": 242, "D": -468, "C": 0, "B": 201}  # x 212, y 136, z 112, yaw 60
AT_YELLOW = {"F": 144, "E": 460, "D": -655, "C": 0, "B": 201}  # z 12
ABOVE_YELLOW_GOAL = {"F": -38, "E": 485, "D": -256, "C": 0, "B": -28}  # x 392, y -60, yaw 90
AT_YELLOW_GOAL = {"F": -38, "E": 630, "D": -369, "C": 0, "B": -28}
OPEN = -16  # count of A: the jaws are 63.5 mm open
CLOSING = 90  # counts, more than any block permits
SHUT = 64  # count of A at which the jaws are closed


def close_jaws(robot):
    """Closes the jaws until they stand, and clears the rest. Returns their opening in mm."""
    robot.send(f"A+{CLOSING}\r")
    left = robot.wait("A")  # asks A? until nothing changes, and sends AX
    robot.at["A"] += CLOSING - left
    return 50.8 - 0.79375 * robot.at["A"]


def carry(robot, above, at, above_goal, at_goal):
    """Picks up a block and puts it down."""
    robot.go({"A": OPEN})
    for label, count in above.items():
        for part in (count // 2, count - count // 2):
            robot.send(f"{label}{max(-128, min(127, part)):+d}\r{label}?")
            robot.read(1)
    for label in above:
        robot.wait(label)
    width = close_jaws(robot)
    if robot.at["A"] >= SHUT:
        robot.close()
        sys.exit()
    print(f"the jaws hold {width:.1f} mm")
    robot.go(above)
    robot.go(above_goal)
    robot.go(at_goal)
    robot.go({"A": OPEN})
    robot.go(above_goal)


robot = xr3.connect()
carry(robot, ABOVE_GREEN, AT_GREEN, ABOVE_GREEN_GOAL, AT_GREEN_GOAL)
carry(robot, ABOVE_YELLOW, AT_YELLOW, ABOVE_YELLOW_GOAL, AT_YELLOW_GOAL)
robot.go({"F": 0, "E": 0, "D": 0, "C": 0, "B": 0, "A": 0})
robot.close()
