"""Exercise 7, by Ada: carries green and yellow to their places."""

import sys

import xr3

SHUT = 64  # count of A at which the jaws are closed
# For each block the counts above it, at it, above its goal, at its goal, from `xr3 kin`.
GREEN = ({"F": 71, "E": 381, "D": -343, "C": 0, "B": 260}, {"F": 71, "E": 543, "D": -479, "C": 0, "B": 260},
         {"F": 0, "E": 489, "D": -245, "C": 0, "B": 0}, {"F": 0, "E": 632, "D": -358, "C": 0, "B": 0})
YELLOW = ({"F": 144, "E": 242, "D": -468, "C": 0, "B": 201}, {"F": 144, "E": 460, "D": -655, "C": 0, "B": 201},
          {"F": -38, "E": 485, "D": -256, "C": 0, "B": -28}, {"F": -38, "E": 630, "D": -369, "C": 0, "B": -28})


def carry(robot, above, at, above_goal, at_goal):
    robot.go({"A": -16})
    robot.go(above)
    robot.go(at)
    robot.send("A+90\r")
    robot.at["A"] += 90 - robot.wait("A")
    if robot.at["A"] >= SHUT:
        sys.exit("the jaws closed on nothing")
    for pose in above, above_goal, at_goal:
        robot.go(pose)
    robot.go({"A": -16})
    robot.go(above_goal)


arm = xr3.connect()
carry(arm, *GREEN)
print("green is there")
carry(arm, *YELLOW)
print("yellow is there")
arm.close()
