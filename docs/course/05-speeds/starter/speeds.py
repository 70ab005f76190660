"""Exercise 5: move E by 470 and D by 1029 counts so that both arrive together, and the tip stays between two walls.

The motion ends after at most 15 simulated seconds."""

import xr3

TARGET = {"E": 470, "D": 1029}  # counts: the tip is then at x 500, y 0
LONGEST = 127  # counts of one move

robot = xr3.connect(arm=xr3.ADEPT_ONE)
print("connected")

# TODO: set the speeds of E and D in proportion to their ways: robot.set_speed(label, counts a second).

# TODO: move both joints in equal parts of at most LONGEST counts. After each part wait for both.

robot.close()
