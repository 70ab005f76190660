"""Exercise 1: ask E?, move the shoulder by +50 counts, wait until it is there, move it by +90, and wait again.

The shoulder ends at 140 counts. Nothing else moves."""

import xr3

robot = xr3.connect()
print("connected")

# TODO: ask E?, and print how many counts the shoulder has to go.

# TODO: move the shoulder by +50 counts.

# TODO: wait until it is there, and print what is left as it moves. Give up if it stands for good.

# TODO: move it by another +90 counts, and wait in the same way.

robot.close()
