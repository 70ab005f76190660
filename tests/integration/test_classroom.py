"""docs/classroom.md: a teacher does what it says (reader.py), with thirty robots. Its figures are those of
the page that says how they were measured."""
# labels: full

import pathlib
import re
import tempfile
import unittest

from reader import Reader, play
from support import ROOT
from test_cells import OTHER_ADDRESS, line_to

PAGE = pathlib.Path(ROOT, "docs", "classroom.md")
MEASURED = pathlib.Path(ROOT, "deploy", "kubernetes", "README.md")


class Teacher(Reader):
    """Leaves every robot port to the students, whose machines have other addresses."""

    def follow(self, text, xr3):
        super().follow(text, xr3)
        for port, shown in self.ports(xr3).items():
            if shown != "9601":
                with line_to(int(port), OTHER_ADDRESS) as student:
                    self.test.assertEqual(32, student.ask("E?"), f"port {shown}")


class Classroom(unittest.TestCase):
    def test_a_lesson(self):
        with tempfile.TemporaryDirectory() as folder:
            text = re.sub(r"^   ", "", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)  # including fences of list items
            play(Teacher(self, pathlib.Path(folder), ["text"]), text)  # a slip is no command
            self.assertIn("<svg", pathlib.Path(folder, "end.svg").read_text(encoding="utf-8"))
            grades = pathlib.Path(folder, "report", "grades.csv").read_text(encoding="utf-8-sig").splitlines()
            self.assertEqual(len(list(pathlib.Path(folder, "submissions").iterdir())), len(grades) - 1)

    def test_figures_are_those_that_were_measured(self):
        rows = re.findall(r"^\| [\d,]+ \| [\d.]+ ms \| \d+ %.*", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(3, len(rows))
        measured = MEASURED.read_text(encoding="utf-8").splitlines()
        for row in rows:
            self.assertIn(row, measured)


if __name__ == "__main__":
    unittest.main()
