"""The workcells of the attacks: those that are shipped, and the largest that the rules for files allow."""

import json
import pathlib
import tempfile

from support import ROOT

SHIPPED = "shipped"    # five blocks, 192 x 192 pixels
HUNDRED = "hundred"    # a hundred blocks, also shipped
THOUSAND = "thousand"  # a thousand blocks
CAMERA = "camera"      # the shipped blocks, and 2,048 x 2,048 pixels
LARGEST = "largest"    # 10,000 blocks and 2,048 x 2,048 pixels
HEAPED = "heaped"      # 2,048 x 2,048 pixels, and as many blocks as may cover the camera's whole field

BOUND_MS = {SHIPPED: 3, HUNDRED: 3, THOUSAND: 20, CAMERA: 20, LARGEST: 20, HEAPED: 20}
MOST_BLOCKS = 10_000
MOST_PIXELS = 2048
MOST_ROWS = 500_000  # of the camera's image, counted for each block
FIELD_MM = 384


def block(number, size_mm=(40, 20, 20)):
    """A block with the longest name, somewhere in the camera's field."""
    row, column = divmod(number, 100)
    return {"name": f"{number:040d}", "size": list(size_mm), "color": number % 16, "yaw_deg": number % 90,
            "centroid": [round(100 + 3.8 * column, 3), round(-190 + 3.8 * row % 380, 3), size_mm[2] / 2]}


def workcell(blocks=None, pixels=None):
    """The Rhino's workcell, perhaps with other blocks or another camera."""
    cell = json.loads(pathlib.Path(ROOT, "data/workcells/rhino-xr3.json").read_text(encoding="utf-8"))
    if pixels:
        cell["camera"]["pixels"] = [pixels, pixels]
    return cell | {"notes": ""} | ({} if blocks is None else {"blocks": blocks})


def _heap():
    middle = [290, 0, 10]
    size = (2 * FIELD_MM, 2 * FIELD_MM, 20)
    return [block(number, size) | {"centroid": middle} for number in range(MOST_ROWS // MOST_PIXELS)]


MADE = {
    THOUSAND: lambda: workcell([block(number) for number in range(1000)]),
    CAMERA: lambda: workcell(pixels=MOST_PIXELS),
    LARGEST: lambda: workcell([block(number, (6, 4, 20)) for number in range(MOST_BLOCKS)], MOST_PIXELS),
    HEAPED: lambda: workcell(_heap(), MOST_PIXELS),
}


class Cell:
    """A context manager for the options that select a workcell; writes its file if it is not shipped."""

    def __init__(self, name):
        self.name = name

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        if self.name not in MADE:
            return ["--workcell", "rhino-hundred" if self.name == HUNDRED else "rhino-xr3"]
        path = pathlib.Path(self.folder.name, self.name + ".json")
        path.write_text(json.dumps(MADE[self.name]()), encoding="utf-8")
        return ["--workcell", path]

    def __exit__(self, *_):
        self.folder.cleanup()
