"""5. Pick and place at known positions: take the red block from where it lies, and put it somewhere
else.

    python3 5_pick_and_place.py [HOST [PORT]]

The arm has to be at its soft home, as it is when the simulator starts, or after 3_home.py.
"""

import sys

import xr3

# Where the motors have to be, in counts from the soft home, for the tool to be at a place.
# `xr3 kin --pose 262,0,20 --down 90` works out the one of the block: its middle is at x 262, y 0
# and z 20 mm, and it is turned by 90 degrees. "Above" is 100 mm higher up. On a real arm one would
# drive there by hand and write the counts down.
HOME = {"F": 0, "E": 0, "D": 0, "C": 0, "B": 0, "A": 0}
ABOVE_BLOCK = {"F": 0, "E": 242, "D": -440, "C": 0, "B": 0}
AT_BLOCK = {"F": 0, "E": 449, "D": -625, "C": 0, "B": 0}
ABOVE_PLACE = {"F": 0, "E": 483, "D": -238, "C": 0, "B": 288}  # x 400, y 0, not turned
AT_PLACE = {"F": 0, "E": 623, "D": -354, "C": 0, "B": 288}
SHUT = -64  # where the jaws, A, have nothing between them

robot = xr3.connect()

# robot.go() brings all joints to these counts together. A single move is at most 127 counts long,
# so go() sends several, and waits after each.
robot.go({"A": 16})
print("the jaws are open")
robot.go(ABOVE_BLOCK)
print("above the block")
robot.go(AT_BLOCK)

# Close the jaws much further than the block lets them. They stop at the block, and what is left to
# go tells how wide it is: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
robot.send("A-100\r")
left = robot.wait("A")  # also clears what is left (AX), or the jaws would go on pressing
robot.at["A"] -= 100 - left  # robot.at is where go() believes the motors to be
if robot.at["A"] <= SHUT:
    robot.go(ABOVE_BLOCK)  # back to where the examples begin
    robot.go(HOME)
    sys.exit("the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server to "
             "have it there (the examples 3 to 6 are for the Rhino XR-3 with its own workcell, in "
             "the profile paper)")
print(f"the jaws closed on {50.8 + 0.79375 * robot.at['A']:.1f} mm")

robot.go(ABOVE_BLOCK)
print("lifted")
robot.go(ABOVE_PLACE)
robot.go(AT_PLACE)
print("at its new place")
robot.go({"A": 16})
print("let go")
robot.go(ABOVE_PLACE)
robot.go(HOME)
print("back at the start")

robot.close()
