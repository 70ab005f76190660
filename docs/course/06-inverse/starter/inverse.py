"""Exercise 6: with the Adept One grip the pin at point 1, put it down at point 2, and end at point 3.

Compute the counts of each point yourself: without solve() of the package, and without numbers from xr3 kin."""

import xr3

POINT_1 = (500, 300, 520)  # mm; yaw 0
POINT_2 = (300, -450, 520)  # mm; yaw 0
POINT_3 = (-420, -300, 650)  # mm; any yaw


def counts(x, y, z, yaw):
    """The motor counts from the soft home for a place of the tip, in mm and degrees."""
    raise NotImplementedError  # TODO: the formulas of the sheet; which elbow is within the limits?


robot = xr3.connect(arm=xr3.ADEPT_ONE)
print("connected")

# TODO: open the jaws, robot.go({"A": -40}), go above point 1 and down to it, and close them, robot.close_jaws().

# TODO: carry the pin to point 2, at z 620 in between, and open the jaws. Then go to point 3.

robot.close()
