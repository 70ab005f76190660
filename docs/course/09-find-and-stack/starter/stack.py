"""Exercise 9: find three blocks with the camera, and put green on red, and blue on green. Red stays where it is.

The program must work wherever the blocks are."""

import xr3

HEIGHTS = {"red": 40, "green": 30, "blue": 24}  # mm; no picture shows them

robot = xr3.connect(arm=xr3.INTELLEDEX_660)
patches = robot.look().patches()
print(len(patches), "patches in the picture")

# TODO: which patch is which block? Remember all three before anything moves.

# TODO: carry green onto red, and blue onto green: robot.pick(xr3.Pose(x, y, z, yaw)) and robot.place(...).

# TODO: look again, and print whether it has worked.

robot.close()
