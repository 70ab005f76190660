"""2. Move and wait: send a joint somewhere, and ask until it has arrived.

    python3 2_move_and_wait.py [HOST [PORT]]
"""

import sys
import time

import xr3

robot = xr3.Robot(*sys.argv[1:3])  # send() and ask() are all that we use of it here


def wait_for(joint):
    """Asks how far there is still to go until nothing is left. Between two questions it does
    nothing for a while."""
    left = robot.ask(joint + "?") - 32
    while left > 0:
        print(f"  {left} counts to go")
        time.sleep(0.05)
        left = robot.ask(joint + "?") - 32
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
