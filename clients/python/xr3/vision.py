"""Analysis of the camera's picture: decodes the pixels from the reply, finds connected patches of
pixels, and measures the centre, yaw, length and width of each patch.

A patch has no z. The camera looks straight down and a pixel is 0 or 1, so the picture contains no
height. A program knows it from elsewhere: the centre of a block is half its height above the table,
whose z is `Camera.table`.
"""

import math
from dataclasses import dataclass
from typing import FrozenSet, Iterable, Iterator, List, Optional, Set, Tuple

from xr3.monitor import Monitor

Pixel = Tuple[int, int]  # column from the left, row from the top

SPACE = 32  # added to every byte of the picture


@dataclass(frozen=True)
class Camera:
    """A camera that looks straight down on a field of width × height mm, centred at (x, y) on the
    table, with columns × rows pixels. `table` is the z of the table in mm, which no picture shows.
    The defaults are those of the Rhino's workcell."""

    x: float = 290.0
    y: float = 0.0
    width: float = 384.0
    height: float = 384.0
    columns: int = 192
    rows: int = 192
    table: float = 0.0

    @classmethod
    def from_monitor(cls, monitor: Optional[Monitor] = None) -> "Camera":
        """The camera and the table of the simulator's current workcell. Without a monitor, connects
        to Monitor()'s default host and port. A real arm has no monitor port: measure its camera and
        construct a Camera of these numbers. Raises ValueError if the workcell has no camera.

        For a camera with perspective, the numbers apply to the table: it sees the top of a block
        larger and further from its centre than it is."""
        if monitor is None:
            with Monitor() as own:
                return cls.from_monitor(own)
        workcell = monitor.request("get", channel="model", fields=["workcell"])["workcell"]
        if "camera" not in workcell:
            raise ValueError(f"the workcell {workcell['name']!r} has no camera: add the member `camera` "
                             "to its file, or start the server with another --workcell")
        unit = 25.4 if workcell["length_unit"] == "inch" else 1.0
        camera = workcell["camera"]
        x, y, width, height = (unit * length for length in (*camera["location"][:2], *camera["field"]))
        return cls(x, y, width, height, *camera["pixels"], table=unit * workcell.get("work_surface", 0))

    @property
    def mm_per_pixel(self) -> Tuple[float, float]:
        """The size of a pixel on the table along x and y, mm."""
        return self.width / self.columns, self.height / self.rows

    @property
    def row_bytes(self) -> int:
        """Bytes of a row: six pixels per byte, the last one padded with zeros."""
        return -(-self.columns // 6)

    @property
    def picture_bytes(self) -> int:
        """Bytes of the reply to `A**`: those of all rows."""
        return self.rows * self.row_bytes

    @property
    def pixel_area(self) -> float:
        """The area of the table that one pixel covers, in mm²."""
        along_x, along_y = self.mm_per_pixel
        return along_x * along_y

    def place(self, pixel: Pixel) -> Tuple[float, float]:
        """The centre of a pixel on the table, mm. Column 0 is at low x, row 0 at high y."""
        column, row = pixel
        along_x, along_y = self.mm_per_pixel
        return (self.x - self.width / 2 + (column + 0.5) * along_x,
                self.y + self.height / 2 - (row + 0.5) * along_y)


RHINO_CAMERA = Camera(x=290.0)
ADEPT_CAMERA = Camera(x=540.0, width=480.0, height=480.0, table=500.0)
INTELLEDEX_CAMERA = Camera(x=400.0, width=480.0, height=480.0)
CAMERAS = {"rhino-xr3": RHINO_CAMERA, "adept-one": ADEPT_CAMERA,
           "intelledex-660": INTELLEDEX_CAMERA}


@dataclass(frozen=True)
class Patch:
    """Connected pixels: a block seen from above. `x` and `y` are its centre, all lengths are in mm
    and `area` in mm². `yaw` is the direction of the long side in degrees, 0 <= yaw < 180 (a block
    looks the same after half a turn)."""

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
        those of the rectangle with the same second moments. There must be at least one pixel."""
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
