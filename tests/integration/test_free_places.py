"""The free places that the notes of the shipped workcells name: any block of the file can be moved there, its
length along y. It then touches no other block, the arm reaches it, and the camera sees it."""

import json
import pathlib
import re
import tempfile
import unittest

from support import ROOT, run_xr3

WORKCELLS = pathlib.Path(ROOT, "data", "workcells")
LIST = re.compile("Free places for a block, length along y: (.+)")
PLACE = re.compile(r"\((-?\d+), (-?\d+)\)")


def free_places(workcell):
    """(x, y) of each place that the notes name."""
    if "Free places" not in workcell["notes"]:
        return []
    return [tuple(map(int, pair)) for pair in PLACE.findall(LIST.search(workcell["notes"])[1])]


def every_place():
    """(name, workcell, place) of each place of each workcell."""
    for path in sorted(WORKCELLS.glob("*.json")):
        workcell = json.loads(path.read_text(encoding="utf-8"))
        for place in free_places(workcell):
            yield path.stem, workcell, place


def with_block_at(workcell, block, place):
    """The workcell after this block was put down at the place."""
    moved = block | {"centroid": [*place, block["centroid"][2]], "yaw_deg": 90}
    return workcell | {"blocks": [moved if each is block else each for each in workcell["blocks"]]}


class FreePlaces(unittest.TestCase):
    def test_every_robot_has_some(self):
        self.assertEqual({"adept-one", "intelledex-660", "rhino-xr3"}, {name for name, *_ in every_place()})

    def test_are_free(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "moved.json")
            for name, workcell, place in every_place():
                for block in workcell["blocks"]:
                    file.write_text(json.dumps(with_block_at(workcell, block, place)), encoding="utf-8")
                    done = run_xr3("check", file)
                    found = (done.returncode, done.stderr)  # no error, and no warning of blocks that overlap
                    self.assertEqual((0, ""), found, f"{name}: {block['name']} at {place}")

    def test_are_in_reach(self):
        for name, workcell, place in every_place():
            z = workcell["blocks"][0]["centroid"][2]
            done = run_xr3("kin", "--robot", name, "--pose", ",".join(map(str, (*place, z))), "--down", 90)
            self.assertEqual((0, ""), (done.returncode, done.stderr), name)

    def test_are_seen_by_the_camera(self):
        for _, workcell, place in every_place():
            camera = workcell["camera"]
            longest = max(block["size"][0] for block in workcell["blocks"])
            for at, centre, field in zip(place, camera["location"], camera["field"]):
                self.assertLess(abs(at - centre) + longest / 2, field / 2)


if __name__ == "__main__":
    unittest.main()
