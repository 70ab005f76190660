# expects: no_stall: it stalled
"""Forgets the home values: divides the angles by the precision. The shoulder goes back, and the hand into the base."""

import xr3

ANGLES = {"F": (30, 0.2269), "E": (-70, 0.1135), "B": (-60, 0.3125)}

robot = xr3.connect()
for label, (angle, precision) in ANGLES.items():
    left = round(angle / precision)
    while left:
        step = max(-60, min(60, left))
        robot.move(label, step)
        if robot.wait(label):
            break
        left -= step
robot.close()
