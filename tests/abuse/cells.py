"""The workcells of the attacks: one that is shipped, and the largest that the rules for files allow."""

import json
import pathlib
import tempfile

from support import ROOT

SHIPPED = "shipped"  # five blocks, 192 x 192 pixels
LARGEST = "largest"  # 255 blocks, so that one can be added, and 1,000 x 1,000 pixels
HEAPED = "heaped"    # as many blocks, each of which covers the camera's whole field

MANY_BLOCKS = 255
MOST_PIXELS = 1000
FIELD_MM = 384


def block(number, size_mm=(40, 20, 20)):
    """A block with the longest name, somewhere in the camera's field."""
    row, column = divmod(number, 16)
    return {"name": f"{number:040d}", "size": list(size_mm), "color": number % 16, "yaw_deg": number % 90,
            "centroid": [100 + 24 * column, -190 + 24 * row, size_mm[2] / 2]}


def workcell(blocks=None, pixels=None):
    """The Rhino's workcell, perhaps with other blocks or another camera."""
    cell = json.loads(pathlib.Path(ROOT, "data/workcells/rhino-xr3.json").read_text(encoding="utf-8"))
    if pixels:
        cell["camera"]["pixels"] = [pixels, pixels]
    return cell | {"notes": ""} | ({} if blocks is None else {"blocks": blocks})


def blocks(size_mm=(40, 20, 20)):
    return [block(number, size_mm) for number in range(MANY_BLOCKS)]


def heap():
    return [each | {"centroid": [290, 0, 10]} for each in blocks((2 * FIELD_MM, 2 * FIELD_MM, 20))]


MADE = {
    LARGEST: lambda: workcell(blocks(), MOST_PIXELS),
    HEAPED: lambda: workcell(heap(), MOST_PIXELS),
}


class Cell:
    """A context manager for the options that select a workcell; writes its file if it is not shipped."""

    def __init__(self, name):
        self.name = name

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        if self.name not in MADE:
            return ["--workcell", "rhino-xr3"]
        path = pathlib.Path(self.folder.name, self.name + ".json")
        path.write_text(json.dumps(MADE[self.name]()), encoding="utf-8")
        return ["--workcell", path]

    def __exit__(self, *_):
        self.folder.cleanup()
