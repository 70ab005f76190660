"""5. Pick and place at known positions: pick up the red block and put it down elsewhere.

    python3 5_pick_and_place.py [HOST [PORT]]

The arm must be at its soft home, as when the simulator starts or after 3_home.py.
"""

import sys

import xr3

# Motor counts from the soft home for each position of the tool. `xr3 kin --pose 262,0,20 --down 90`
# computes those at the block, whose centre is at x 262, y 0 and z 20 mm, with a yaw of 90 degrees.
# So does xr3.RHINO_XR3.solve(xr3.Pose(262, 0, 20, 90)), and for an arm of your own
# xr3.Arm.load("my-arm.json").solve(...). z is half the height of the block, which is 40 mm, above the
# table, which is at z 0. "Above" is 100 mm higher. On a real arm one would move there manually and
# note the counts.
HOME = {"F": 0, "E": 0, "D": 0, "C": 0, "B": 0, "A": 0}
ABOVE_BLOCK = {"F": 0, "E": 242, "D": -440, "C": 0, "B": 0}
AT_BLOCK = {"F": 0, "E": 449, "D": -625, "C": 0, "B": 0}
ABOVE_PLACE = {"F": 0, "E": 483, "D": -238, "C": 0, "B": 288}  # x 400, y 0, not turned
AT_PLACE = {"F": 0, "E": 623, "D": -354, "C": 0, "B": 288}
SHUT = 64  # count of A at which the jaws are closed

robot = xr3.connect()

# robot.go() moves all joints to these counts together. A single move is limited to 127 counts, so
# go() sends several and waits after each.
robot.go({"A": -16})
print("the jaws are open")
robot.go(ABOVE_BLOCK)
print("above the block")
robot.go(AT_BLOCK)

# Command the jaws to close much further than the block permits. They stop at the block, and the
# remaining counts give its width: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
robot.send("A+90\r")
left = robot.wait("A")  # cancels the rest, too (AX): the jaws would keep pressing
robot.at["A"] += 90 - left  # robot.at holds the motor positions, as tracked by go()
if robot.at["A"] >= SHUT:
    robot.go(ABOVE_BLOCK)  # back to the start position
    robot.go(HOME)
    sys.exit("the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the server to "
             "have it there (the examples 3 to 6 are for the Rhino XR-3 with its own workcell)")
print(f"the jaws closed on {50.8 - 0.79375 * robot.at['A']:.1f} mm")

robot.go(ABOVE_BLOCK)
print("lifted")
robot.go(ABOVE_PLACE)
robot.go(AT_PLACE)
print("at its new place")
robot.go({"A": -16})
print("let go")
robot.go(ABOVE_PLACE)
robot.go(HOME)
print("back at the start")

robot.close()
