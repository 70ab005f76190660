"""Image processing for exercise.py: the connected patches of pixels, and for each patch its area, centroid,
principal angle, and the length and width of the rectangle with the same second moments."""

import dataclasses
import itertools
import math


@dataclasses.dataclass(frozen=True)
class Camera:
    """A camera that looks straight down at a square of `field` mm around (x, y), with pixels x pixels."""

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
    """Connected pixels. Lengths in mm, the angle in degrees, at least 0 and less than 180."""

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
    """A binary image: the set of the pixels (column, row) that are 1."""

    def __init__(self, ones, camera):
        self.ones = ones
        self.camera = camera

    @classmethod
    def decode(cls, data, camera):
        """Decodes the camera's reply: rows from the top, six pixels per byte, the leftmost pixel in the
        highest bit, plus 32."""
        ones = {(6 * (i % camera.row_bytes) + bit, i // camera.row_bytes)
                for i, byte in enumerate(data) for bit in range(6) if (byte - 32) >> (5 - bit) & 1}
        assert all(column < camera.pixels for column, _ in ones), "padding is not 0"
        return cls(ones, camera)

    def patches(self):
        """The patches of pixels that are connected by their sides (4-connected)."""
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
        """The patch of each block: the assignment in which lengths and widths fit best."""
        patches = list(self.patches())
        assert len(patches) == len(sizes), f"{len(patches)} patches, {len(sizes)} blocks"

        def misfit(order):
            return sum((patch.length - length) ** 2 + (patch.width - width) ** 2
                       for patch, (length, width, _) in zip(order, sizes.values()))

        return dict(zip(sizes, min(itertools.permutations(patches), key=misfit)))

    def follow(self, known, moved):
        """The patch of each block after one block was moved; the other patches have the same pixels as
        before. Blocks without such a patch are omitted."""
        patches = {patch.pixels: patch for patch in self.patches()}
        found = {name: patches.pop(patch.pixels) for name, patch in known.items()
                 if name != moved and patch.pixels in patches}
        if len(patches) == 1:
            found[moved] = patches.popitem()[1]
        return found
