"""2. Move and wait: move a joint and ask until it has arrived.

    python3 2_move_and_wait.py [HOST [PORT]]
"""

import sys

import xr3

# A joint counts as stopped if 40 answers, over 2 seconds, are the same. The slowest speed is one
# count per second, and the simulator's clock may run slowly, hence the long wait.
STANDS_AFTER = 40
WHY_IT_STANDS = ("Is it blocked at a limit, or stalled? Is the clock paused or slow? Look at the "
                 "page or at `xr3 watch`")

robot = xr3.connect()  # this example uses only its send(), ask() and pause()


def wait_for(joint):
    """Asks for the remaining counts until none are left, with a pause between two questions. A
    blocked joint would never finish, so the program gives up after STANDS_AFTER equal answers."""
    left = robot.ask(joint + "?") - 32
    same = 0  # number of equal answers in a row
    while left > 0:
        print(f"  {left} counts to go")
        robot.pause()
        before = left
        left = robot.ask(joint + "?") - 32
        same = same + 1 if left == before else 0
        if same == STANDS_AFTER:
            robot.send(joint + "X")  # cancels the rest of the move
            sys.exit(f"{joint} stopped {left} counts short of its target. {WHY_IT_STANDS}")
    print(f"{joint} is there")


# Turn the shoulder by 50 counts of its encoder. The carriage return ends the number. The robot
# starts to move and does not answer, so the program has to ask.
print("E+50")
robot.send("E+50\r")
wait_for("E")

# Move back.
print("E-50")
robot.send("E-50\r")
wait_for("E")

robot.close()
