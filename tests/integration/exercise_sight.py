"""What the exercise's program makes of a picture: which pixels belong together, and of each such patch
its area, centroid, principal angle, and length and width of the rectangle with the same moments."""

import dataclasses
import itertools
import math


@dataclasses.dataclass(frozen=True)
class Camera:
    """Looks straight down on a field of field x field mm about (x, y), in pixels x pixels."""

    x: float
    y: float
    field: float
    pixels: int

    @property
    def pixel(self):
        return self.field / self.pixels

    @property
    def row_bytes(self):
        return -(-self.pixels // 6)

    @property
    def bytes(self):
        return self.pixels * self.row_bytes

    def at(self, column, row):
        """The centre of a pixel on the table; column 0 is at low x, row 0 at high y."""
        return (self.x - self.field / 2 + (column + 0.5) * self.pixel,
                self.y + self.field / 2 - (row + 0.5) * self.pixel)


@dataclasses.dataclass(frozen=True)
class Patch:
    """Pixels that hang together; lengths in mm, the angle in degrees, 0 up to 180."""

    pixels: frozenset
    area: float
    x: float
    y: float
    yaw: float
    length: float
    width: float

    @classmethod
    def of(cls, pixels, camera):
        points = [camera.at(column, row) for column, row in pixels]
        n = len(points)
        x, y = sum(p[0] for p in points) / n, sum(p[1] for p in points) / n
        xx = sum((p[0] - x) ** 2 for p in points) / n
        yy = sum((p[1] - y) ** 2 for p in points) / n
        xy = sum((p[0] - x) * (p[1] - y) for p in points) / n
        yaw = math.degrees(math.atan2(2 * xy, xx - yy) / 2) % 180
        spread = math.hypot((xx - yy) / 2, xy)
        length, width = (math.sqrt(12 * ((xx + yy) / 2 + sign * spread)) for sign in (1, -1))
        return cls(frozenset(pixels), n * camera.pixel ** 2, x, y, yaw, length, width)


class Picture:
    """A binary image: the set of (column, row) that are 1."""

    def __init__(self, ones, camera):
        self.ones = ones
        self.camera = camera

    @classmethod
    def decode(cls, data, camera):
        """Rows from the top, six pixels a byte from the left, the leftmost in the high bit, plus 32."""
        ones = {(6 * (i % camera.row_bytes) + bit, i // camera.row_bytes)
                for i, byte in enumerate(data) for bit in range(6) if (byte - 32) >> (5 - bit) & 1}
        assert all(column < camera.pixels for column, _ in ones), "padding is not 0"
        return cls(ones, camera)

    def patches(self):
        """Connected through the four sides of a pixel."""
        unseen = set(self.ones)
        while unseen:
            patch = set()
            front = [unseen.pop()]
            while front:
                column, row = front.pop()
                patch.add((column, row))
                around = {(column + 1, row), (column - 1, row), (column, row + 1), (column, row - 1)} & unseen
                unseen -= around
                front.extend(around)
            yield Patch.of(patch, self.camera)

    def find(self, sizes):
        """Which patch is which block: the assignment in which lengths and widths fit best."""
        patches = list(self.patches())
        assert len(patches) == len(sizes), f"{len(patches)} patches, {len(sizes)} blocks"

        def misfit(order):
            return sum((patch.length - length) ** 2 + (patch.width - width) ** 2
                       for patch, (length, width, _) in zip(order, sizes.values()))

        return dict(zip(sizes, min(itertools.permutations(patches), key=misfit)))

    def follow(self, known, moved):
        """Which patch is which block after one was moved: the others have kept every pixel. A block that
        is not where it should be is left out."""
        patches = {patch.pixels: patch for patch in self.patches()}
        found = {name: patches.pop(patch.pixels) for name, patch in known.items()
                 if name != moved and patch.pixels in patches}
        if len(patches) == 1:
            found[moved] = patches.popitem()[1]
        return found
