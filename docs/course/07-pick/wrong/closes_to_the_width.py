# expects: order: "grasped green" did not happen
"""Closes the jaws exactly to the width of the block, 28 mm, and does not look whether they hold it."""

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


def close_jaws(robot):
    """Closes the jaws until they stand, and clears the rest. Returns their opening in mm."""
    robot.go({"A": int((50.8 - 28) / 0.79375)})
    return 50.8 - 0.79375 * robot.at["A"]


def carry(robot, above, at, above_goal, at_goal):
    """Picks up a block and puts it down."""
    robot.go({"A": OPEN})
    robot.go(above)
    robot.go(at)
    width = close_jaws(robot)
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
