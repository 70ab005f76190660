# expects: stacked: it is at
"""Stacks blue on red, and green on blue: the wrong order."""

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
    width = robot.pick(xr3.Pose(patch.x, patch.y, half, patch.yaw))
    if width is None:
        sys.exit(f"the jaws closed on nothing at x {patch.x:.0f}, y {patch.y:.0f} mm")
    print(f"{name}: the jaws hold {width:.1f} mm")
    robot.place(xr3.Pose(x, y, floor + half, yaw))


robot = xr3.connect(arm=xr3.INTELLEDEX_660)
found = look(robot)  # before anything moves: a stack is one patch
for name, patch in found.items():
    print(f"{name}: x {patch.x:.0f}, y {patch.y:.0f} mm, yaw {patch.yaw:.0f} degrees")
red = found["red"]
carry(robot, "blue", found["blue"], red.x, red.y, HEIGHTS["red"], red.yaw)
carry(robot, "green", found["green"], red.x, red.y, HEIGHTS["red"] + HEIGHTS["blue"], red.yaw)
left = robot.look().patches()
print("stacked" if len(left) == 1 else f"there are {len(left)} patches in the picture")
robot.close()
