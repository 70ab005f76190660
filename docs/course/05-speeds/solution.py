"""Exercise 5: two joints of the Adept One that arrive together, so that the tip moves along a line."""

import xr3

TARGET = {"E": 470, "D": 1029}  # the tip at x 500, y 0
FASTEST = 220  # counts a second; at most 255
LONGEST = 110  # counts of a move; at most 127

robot = xr3.connect(arm=xr3.ADEPT_ONE)

# Speeds as the distances: then both joints need the same time, and always are at the same part of their way.
far = max(TARGET.values())
for label, counts in TARGET.items():
    speed = round(FASTEST * counts / far)
    print(f"{label}: {counts} counts at {speed} counts a second, {counts / speed:.2f} s")
    robot.set_speed(label, speed)

# The counters have 8 bits, so the way is cut into equal parts. After each part both joints are on the line again.
parts = -(-far // LONGEST)
for part in range(1, parts + 1):
    for label, counts in TARGET.items():
        robot.move(label, counts * part // parts - counts * (part - 1) // parts)
    for label in TARGET:
        robot.wait(label)
robot.close()
