"""Exercise 2: compute the tip from the motor counts by link matrices, and turn the hand outwards with C to a tip height
of 250 mm. theta1 is 30, theta2 -70 and theta5 -60 degrees, and D is at -220 counts."""

import xr3

HEIGHT = 250  # mm

# TODO: the link matrix of one row of the Denavit-Hartenberg table.

# TODO: the product of the five links, and from it the tip for given counts.

goal = {"F": 0, "E": 0, "D": 0, "C": 0, "B": 0}  # TODO: the counts of the task
print("goal:", goal)  # TODO: and the tip that your matrices give for it

# TODO: the count of C for which the tip is nearest to the height.

with xr3.Robot() as robot:
    robot.go(goal)
