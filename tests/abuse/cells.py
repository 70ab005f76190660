"""The workcells of the attacks: those that are shipped, and the largest that the rules for files allow."""

import json
import pathlib
import tempfile

from support import ROOT

SHIPPED = "shipped"    # five blocks, 192 x 192 pixels
HUNDRED = "hundred"    # a hundred blocks, also shipped
LARGEST = "largest"    # 256 blocks and 1,000 x 1,000 pixels

BOUND_MS = {SHIPPED: 3, HUNDRED: 3, LARGEST: 20}
MOST_BLOCKS = 256
MOST_PIXELS = 1000


def block(number, size_mm=(40, 20, 20)):
    """A block with the longest name, somewhere in the camera's field."""
    row, column = divmod(number, 100)
    return {"name": f"{number:040d}", "size": list(size_mm), "color": number % 16, "yaw_deg": number % 90,
            "centroid": [round(100 + 3.8 * column, 3), round(-190 + 3.8 * row % 380, 3), size_mm[2] / 2]}


def most_blocks(size_mm=(40, 20, 20)):
    return [block(number, size_mm) for number in range(MOST_BLOCKS)]


def workcell(blocks=None, pixels=None):
    """The Rhino's workcell, perhaps with other blocks or another camera."""
    cell = json.loads(pathlib.Path(ROOT, "data/workcells/rhino-xr3.json").read_text(encoding="utf-8"))
    if pixels:
        cell["camera"]["pixels"] = [pixels, pixels]
    return cell | {"notes": ""} | ({} if blocks is None else {"blocks": blocks})


MADE = {LARGEST: lambda: workcell(most_blocks((200, 200, 20)), MOST_PIXELS)}


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
