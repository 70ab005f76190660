# expects: order: "grasped green" did not happen
"""Uses places that were noted on another day, without the camera, and does not look whether the jaws hold anything."""

import sys

import xr3

HEIGHTS = {"red": 40, "green": 30, "blue": 24}  # mm; no picture shows them


def look(robot):
    """The patches of the blocks by name: the areas tell them apart, red has the largest."""
    patches = robot.look().patches()
    if len(patches) != 3:
        sys.exit(f"the picture has {len(patches)} patches, not 3")
    return dict(zip(("red", "green", "blue"), patches))


def carry(robot, name, patch, x, y, floor, yaw):
    """Picks up a block from the table, and puts it down with its underside at `floor` mm."""
    half = HEIGHTS[name] / 2
    robot.pick(xr3.Pose(patch.x, patch.y, half, patch.yaw))
    robot.place(xr3.Pose(x, y, floor + half, yaw))


robot = xr3.connect(arm=xr3.INTELLEDEX_660)
found = {"red": xr3.Pose(330, 110, 0, 20), "green": xr3.Pose(450, 0, 0, 35), "blue": xr3.Pose(400, -130, 0, 110)}
for name, patch in found.items():
    print(f"{name}: x {patch.x:.0f}, y {patch.y:.0f} mm, yaw {patch.yaw:.0f} degrees")
red = found["red"]
carry(robot, "green", found["green"], red.x, red.y, HEIGHTS["red"], red.yaw)
carry(robot, "blue", found["blue"], red.x, red.y, HEIGHTS["red"] + HEIGHTS["green"], red.yaw)
left = robot.look().patches()
print("stacked" if len(left) == 1 else f"there are {len(left)} patches in the picture")
robot.close()
