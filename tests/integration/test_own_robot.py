"""docs/own-robot.md: a reader does what it says (reader.py), its parts of the file are in the file, its figures are
those that the program draws, and the calculation by hand agrees with the formulas of the page and with `xr3 kin`."""
# labels: full

import json
import math
import pathlib
import re
import tempfile
import unittest

from reader import FENCE, Reader, check_figures, play
from support import ROOT, run_xr3

PAGE = pathlib.Path(ROOT, "docs", "own-robot.md")
FILES = PAGE.parent / "own-robot"
SCARA = FILES / "scara.json"


def contents(path):
    """The file without its comments."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return json.loads("\n".join(line for line in lines if not line.lstrip().startswith("*")))


class OwnRobot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.text = PAGE.read_text(encoding="utf-8")

    def test_steps(self):
        play(Reader(self, self.folder, others=("json", "")), self.text)

    def test_parts_of_the_file(self):
        parts = [shown for kind, shown in FENCE.findall(self.text) if kind == "json"]
        self.assertGreater(len(parts), 6)
        for part in parts:
            self.assertIn(part, SCARA.read_text(encoding="utf-8"))

    def test_rows_of_the_table(self):
        rows = re.findall(r"^\| (\w) [\w ]+ \| \**(-?\d+)°?\**° \| \**(\d+)\** \| (\d+) \| (\d+)° \|",
                          self.text.replace("°**", "**°"), re.MULTILINE)
        self.assertEqual([(joint["label"], *(str(joint[name]) for name in ("theta_deg", "d", "a", "alpha_deg")))
                          for joint in contents(SCARA)["joints"]], rows)

    def test_calculation_by_hand(self):
        """With the lengths and precisions of the file, but without link matrices."""
        robot = contents(SCARA)
        counts = list(map(int, re.search(r"kin .* --counts (\S+)$", self.text, re.MULTILINE)[1].split(",")))
        shoulder, elbow, quill, hand = (joint[{"theta": "theta_deg", "d": "d"}[joint["variable"]]]
                                        + joint["precision"] * count for joint, count in zip(robot["joints"], counts))
        column, _, _, tip = (joint["d"] for joint in robot["joints"])
        upper, fore = robot["joints"][0]["a"], robot["joints"][1]["a"]
        forearm = math.radians(shoulder - elbow)
        x = upper * math.cos(math.radians(shoulder)) + fore * math.cos(forearm)
        y = upper * math.sin(math.radians(shoulder)) + fore * math.sin(forearm)
        z = column - quill - tip
        for name, value in zip("xyz", (x, y, z)):
            shown = re.search(rf"^{name} = .*= +(-?[\d.]+)$", self.text, re.MULTILINE)[1]
            self.assertAlmostEqual(value, float(shown), 4)
        done = run_xr3("kin", "--robot", SCARA, "--counts", ",".join(map(str, counts)), "--json")
        tool = json.loads(done.stdout)["tool"]
        for value, computed in zip((x, y, z, shoulder - elbow - hand), (*tool["xyz_mm"], tool["net_roll_deg"])):
            self.assertAlmostEqual(value, computed, 6)

    def test_figures(self):
        drawn = check_figures(self, PAGE, self.folder)
        self.assertEqual({*drawn, "scara.json", "bench.json", "page.png"},
                         {path.name for path in FILES.iterdir()})


if __name__ == "__main__":
    unittest.main()
