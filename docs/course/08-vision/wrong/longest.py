# expects: tip: it is at x 349.8
"""Takes the longest patch for the largest: the corners of its frame decide, not its pixels."""

import math

import xr3

COLUMNS, ROWS, MM = 192, 192, 2  # pixels of the picture, and mm of a pixel
LEFT, TOP = 98, 192  # x of the left and y of the top edge of the picture, mm
HEIGHT = 100  # of the tip above the table, mm


def decode(reply):
    """The pixels that are 1, as (column, row)."""
    row_bytes = COLUMNS // 6
    ones = set()
    for index, byte in enumerate(reply):
        row, first = index // row_bytes, index % row_bytes * 6
        for bit in range(6):
            if (byte - 32) >> (5 - bit) & 1:
                ones.add((first + bit, row))
    return ones


def patches(ones):
    """Sets of pixels that touch each other by their sides."""
    ones = set(ones)
    while ones:
        patch, front = set(), [ones.pop()]
        while front:
            column, row = front.pop()
            patch.add((column, row))
            for side in (column + 1, row), (column - 1, row), (column, row + 1), (column, row - 1):
                if side in ones:
                    ones.remove(side)
                    front.append(side)
        yield patch


def measure(patch):
    """Diagonal of its frame in mm, centre in mm, and yaw in degrees, by the moments of the patch."""
    places = [(LEFT + MM * (column + 0.5), TOP - MM * (row + 0.5)) for column, row in patch]
    n = len(places)
    x, y = sum(px for px, _ in places) / n, sum(py for _, py in places) / n
    m20 = sum((px - x) ** 2 for px, _ in places)
    m02 = sum((py - y) ** 2 for _, py in places)
    m11 = sum((px - x) * (py - y) for px, py in places)
    wide = max(px for px, _ in places) - min(px for px, _ in places)
    high = max(py for _, py in places) - min(py for _, py in places)
    return math.hypot(wide, high), x, y, math.degrees(math.atan2(2 * m11, m20 - m02) / 2)


def half_turn_nearest_home(x, y, yaw):
    """A block looks the same after half a turn. Takes the one with the smaller roll of B."""
    base = math.degrees(math.atan2(y, x))
    return min((yaw, yaw + 180, yaw - 180), key=lambda each: abs(base - each + 90))


robot = xr3.connect()
robot.send("A**")
picture = decode(robot.read(COLUMNS // 6 * ROWS))
blocks = sorted((measure(patch) for patch in patches(picture)), reverse=True)
for area, x, y, yaw in blocks:
    print(f"size {area:.0f}, x {x:.1f}, y {y:.1f} mm, yaw {yaw:.1f} degrees")
_, x, y, yaw = blocks[0]
robot.go(xr3.RHINO_XR3.solve(xr3.Pose(x, y, HEIGHT, half_turn_nearest_home(x, y, yaw))))
print("the tip is above it")
robot.close()
