"""4. Two joints at once: base and shoulder start together, and the program waits for both.

    python3 4_two_joints.py [HOST [PORT]]
"""

import sys

import xr3
from xr3.robot import STANDS_AFTER, WHY_IT_STANDS  # as in example 2

robot = xr3.connect()


def check(f, e):
    """Ends the program if a joint has counts left."""
    for joint, left in ("F", f), ("E", e):
        if left > 0:
            sys.exit(f"{joint} stopped {left} counts short of its target. {WHY_IT_STANDS}")


# Each joint has its own motor, and the robot does not wait: both start now.
# The simulator can also set speeds, as in F40S. A Mark III cannot: it reads F40 as a move.
robot.send("F+40 E+80\r")
print("F+40 E+80")

f, e = robot.ask("F?") - 32, robot.ask("E?") - 32
same = 0  # number of equal answers in a row
while f > 0 or e > 0:
    print(f"  F {f}, E {e} counts to go")
    robot.pause()
    before = f, e
    f, e = robot.ask("F?") - 32, robot.ask("E?") - 32
    same = same + 1 if (f, e) == before else 0
    if same == STANDS_AFTER:
        robot.send("FX EX")  # cancels the rest of the moves
        break
check(f, e)
print("both are there")

# Move back. wait() is the loop of example 2, for one joint after the other.
robot.send("F-40 E-80\r")
check(robot.wait("F"), robot.wait("E"))
print("both are back")

robot.close()
