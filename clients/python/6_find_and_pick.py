"""6. Find with the camera and pick: look at the table, find the largest block, pick it up,
put it down elsewhere, and look again.

    python3 6_find_and_pick.py [HOST [PORT]]

The arm must be at its soft home, as when the simulator starts or after 3_home.py.
"""

import sys

import xr3

# The camera's view: the centre and the size of its field on the table, in mm, and its pixels.
# These are the numbers of the Rhino's workcell. For a real camera, measure them; for any workcell of
# the simulator, xr3.Camera.from_monitor() reads them at its monitor port.
CAMERA = xr3.Camera(x=290, y=0, width=384, height=384, columns=192, rows=192, table=0)

# The picture has no height: the camera looks straight down, and its pixels are 0 or 1. z must be
# known from elsewhere. The largest block is 40 mm high, so its centre is 20 mm above the table.
Z = CAMERA.table + 40 / 2
HOME = {"F": 0, "E": 0, "D": 0, "C": 0, "B": 0, "A": 0}
PLACE = xr3.Pose(392, 60, Z, yaw=90)  # a free place, the block's long side along y

robot = xr3.connect(camera=CAMERA)


def largest():
    """Takes a picture and returns the largest patch. The camera's picture has a patch of ones for
    each block; xr3/vision.py computes its centre in mm, its angle in degrees, and its area."""
    patches = robot.look().patches()
    print(f"blocks in the picture: {len(patches)}")
    if not patches:
        sys.exit("the camera sees no block: is one on the table?")
    return patches[0]


block = largest()
print(f"the largest is at x {block.x:.0f}, y {block.y:.0f} mm, turned {block.yaw:.0f} degrees")

# Inverse kinematics (xr3/arms.py) converts a place on the table to motor counts. pick() and place()
# work as in example 5: move above the place, down, close or open the jaws, up again.
width = robot.pick(xr3.Pose(block.x, block.y, Z, block.yaw))
if width is None:
    robot.go(HOME)
    sys.exit(f"the jaws closed on nothing: is the block at x {block.x:.0f}, y {block.y:.0f} mm? "
             "(The examples 3 to 6 are for the Rhino XR-3 with its own workcell)")
print(f"the jaws closed on {width:.1f} mm")
robot.place(PLACE)
print(f"put down at x {PLACE.x}, y {PLACE.y} mm")

block = largest()
print(f"the largest is at x {block.x:.0f}, y {block.y:.0f} mm, turned {block.yaw:.0f} degrees")

robot.go(HOME)
print("back at the start")

robot.close()
