"""Exercise 1: connect, ask, move the shoulder twice, and wait each time."""

import sys

import xr3

STANDS_AFTER = 40  # so many equal replies, over 2 seconds: the joint does not move any more


def to_go(robot, label):
    """The counts that the joint has still to go."""
    return robot.ask(label + "?") - 32


def wait(robot, label):
    """Asks until no count is left. Gives up if the joint stands."""
    left, same = to_go(robot, label), 0
    while left > 0:
        print(f"  {left} counts to go")
        robot.pause()
        before, left = left, to_go(robot, label)
        same = same + 1 if left == before else 0
        if same == STANDS_AFTER:
            robot.send(label + "X")
            sys.exit(f"{label} stands, {left} counts short of its target")


robot = xr3.connect()
print("hello, robot: E has", to_go(robot, "E"), "counts to go")
for counts in 50, 90:
    print(f"E{counts:+d}")
    robot.send(f"E{counts:+d}\r")
    wait(robot, "E")
print("E is there")
robot.close()
