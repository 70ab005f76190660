"""Analysis of the camera's picture: decodes the pixels from the reply, finds connected patches of
pixels, and measures the centre, yaw, length and width of each patch.
"""

import math
from dataclasses import dataclass
from typing import FrozenSet, Iterable, Iterator, List, Set, Tuple

Pixel = Tuple[int, int]  # column from the left, row from the top

SPACE = 32  # added to every byte of the picture


@dataclass(frozen=True)
class Camera:
    """A camera that looks straight down on a field of width × height mm, centred at (x, y) on the
    table, with columns × rows pixels. The defaults are those of the Rhino's workcell."""

    x: float = 290.0
    y: float = 0.0
    width: float = 384.0
    height: float = 384.0
    columns: int = 192
    rows: int = 192

    @property
    def row_bytes(self) -> int:
        """Bytes of a row: six pixels per byte, the last one padded with zeros."""
        return -(-self.columns // 6)

    @property
    def picture_bytes(self) -> int:
        return self.rows * self.row_bytes

    @property
    def pixel_area(self) -> float:
        """The area of the table that one pixel covers, in mm²."""
        return self.width / self.columns * self.height / self.rows

    def place(self, pixel: Pixel) -> Tuple[float, float]:
        """The centre of a pixel on the table, mm. Column 0 is at low x, row 0 at high y."""
        column, row = pixel
        return (self.x - self.width / 2 + (column + 0.5) * self.width / self.columns,
                self.y + self.height / 2 - (row + 0.5) * self.height / self.rows)


RHINO_CAMERA = Camera(x=290.0)
ADEPT_CAMERA = Camera(x=540.0, width=480.0, height=480.0)
INTELLEDEX_CAMERA = Camera(x=400.0, width=480.0, height=480.0)
CAMERAS = {"rhino-xr3": RHINO_CAMERA, "adept-one": ADEPT_CAMERA,
           "intelledex-660": INTELLEDEX_CAMERA}


@dataclass(frozen=True)
class Patch:
    """Connected pixels: a block seen from above. Lengths are in mm. `yaw` is the direction of the
    long side in degrees, 0 <= yaw < 180 (a block looks the same after half a turn)."""

    pixels: FrozenSet[Pixel]
    area: float
    x: float
    y: float
    yaw: float
    length: float
    width: float

    @classmethod
    def of(cls, pixels: Iterable[Pixel], camera: Camera) -> "Patch":
        """Measures a patch. The centre is the average of the pixels; yaw, length and width are
        those of the rectangle with the same second moments."""
        pixels = frozenset(pixels)
        places = [camera.place(pixel) for pixel in pixels]
        n = len(places)
        x, y = sum(px for px, _ in places) / n, sum(py for _, py in places) / n
        xx = sum((px - x) ** 2 for px, _ in places) / n
        yy = sum((py - y) ** 2 for _, py in places) / n
        xy = sum((px - x) * (py - y) for px, py in places) / n
        yaw = math.degrees(math.atan2(2 * xy, xx - yy) / 2) % 180
        middle, spread = (xx + yy) / 2, math.hypot((xx - yy) / 2, xy)
        length = math.sqrt(12 * (middle + spread))
        width = math.sqrt(12 * max(0.0, middle - spread))
        return cls(pixels, n * camera.pixel_area, x, y, yaw, length, width)


class Picture:
    """A binary picture: `ones` are the pixels in which the camera sees a block."""

    def __init__(self, ones: Iterable[Pixel], camera: Camera) -> None:
        self.ones = frozenset(ones)
        self.camera = camera

    @classmethod
    def decode(cls, reply: bytes, camera: Camera) -> "Picture":
        """Decodes the reply to `A**`: rows from the top, six pixels per byte, the leftmost in the
        highest bit, plus 32. Raises ValueError if the reply is not a picture of this camera."""
        if len(reply) != camera.picture_bytes:
            raise ValueError(f"a picture has {camera.picture_bytes} bytes, not {len(reply)}")
        ones: Set[Pixel] = set()
        for index, byte in enumerate(reply):
            if not SPACE <= byte < SPACE + 64:
                raise ValueError(f"byte {index} of the picture is {byte}: out of 32...95")
            row, group = divmod(index, camera.row_bytes)
            ones.update((6 * group + bit, row) for bit in range(6)
                        if (byte - SPACE) >> (5 - bit) & 1)
        return cls(ones, camera)

    def patches(self) -> List[Patch]:
        """The patches of pixels connected by their sides, the largest first."""
        patches = [Patch.of(pixels, self.camera) for pixels in self._groups()]
        return sorted(patches, key=lambda patch: patch.area, reverse=True)

    def _groups(self) -> Iterator[Set[Pixel]]:
        unseen = set(self.ones)
        while unseen:
            group: Set[Pixel] = set()
            front = [unseen.pop()]
            while front:
                column, row = front.pop()
                group.add((column, row))
                touching = unseen & {(column + 1, row), (column - 1, row),
                                     (column, row + 1), (column, row - 1)}
                unseen -= touching
                front.extend(touching)
            yield group

    def __str__(self) -> str:
        """The picture as text for a terminal, one character per pixel."""
        camera = self.camera
        return "\n".join("".join("#" if (column, row) in self.ones else "."
                                 for column in range(camera.columns)) for row in range(camera.rows))
