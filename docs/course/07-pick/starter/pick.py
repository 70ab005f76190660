"""Exercise 7: bring green to x 400, y 0, yaw 90, and then yellow to x 392, y -60, yaw 90. Touch no other block.

The counts of a pose are those of `xr3 kin --pose X,Y,Z --down YAW`."""

import xr3

# TODO: the counts at green and at its goal, and 100 mm above both. The same for yellow.


def carry(robot, above, at, above_goal, at_goal):
    """Picks up a block and puts it down."""
    # TODO: open the jaws, go above the block and down, close them, lift, go above the goal and down, let go, lift.


robot = xr3.connect()
print("connected")

# TODO: carry green, then yellow.

robot.close()
