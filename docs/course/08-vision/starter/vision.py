"""Exercise 8: read the picture, print area, centre and yaw of each patch, and bring the tip 100 mm above the centre of
the largest one, with the jaws along the block. Do not use look() and patches() of the package, and do not grip."""

import xr3

COLUMNS, ROWS, MM = 192, 192, 2  # pixels of the picture, and mm of a pixel

robot = xr3.connect()
robot.send("A**")
reply = robot.read(COLUMNS // 6 * ROWS)
print(len(reply), "bytes of the picture")

# TODO: decode the bytes to pixels, six to a byte.

# TODO: find the patches, sets of pixels that touch each other.

# TODO: for each patch compute the area in mm², the centre in mm and the yaw in degrees, and print them.

# TODO: compute the counts above the largest patch, and go there.

robot.close()
