"""2. Move and wait: send a joint somewhere, and ask until it has arrived.

    python3 2_move_and_wait.py [HOST [PORT]]
"""

import sys
import time

import xr3

# A joint stands if 40 answers, in 2 seconds, are the same. The slowest speed is one count a second,
# and the simulator's clock may run slowly, so be patient.
STANDS_AFTER = 40
WHY_IT_STANDS = ("Is it blocked at a limit, or stalled? Does time stand, or run slowly? Look at "
                 "the page or at `xr3 watch`")

robot = xr3.connect()  # send() and ask() are all that we use of it here


def wait_for(joint):
    """Asks how far there is still to go until nothing is left. Between two questions it does
    nothing for a while. A joint that is blocked would let us ask forever: we give up after so many
    questions with the same answer."""
    left = robot.ask(joint + "?") - 32
    same = 0  # how many answers in a row have been the same
    while left > 0:
        print(f"  {left} counts to go")
        time.sleep(0.05)
        before = left
        left = robot.ask(joint + "?") - 32
        same = same + 1 if left == before else 0
        if same == STANDS_AFTER:
            robot.send(joint + "X")  # forgets the rest of the move
            sys.exit(f"{joint} stands, {left} counts short of where it was sent. {WHY_IT_STANDS}")
    print(f"{joint} is there")


# The shoulder shall turn by 50 counts of its encoder. The carriage return tells the robot that the
# number ends here. It starts to move, and answers nothing: so we ask.
print("E+50")
robot.send("E+50\r")
wait_for("E")

# And back again.
print("E-50")
robot.send("E-50\r")
wait_for("E")

robot.close()
