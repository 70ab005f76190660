"""docs/course/syllabus.md: each plan has every exercise once, in its order, and numbers its weeks. The afternoon
has four hours."""
# labels: full

import pathlib
import re
import unittest

from support import ROOT

COURSE = pathlib.Path(ROOT, "docs", "course")
PAGE = (COURSE / "syllabus.md").read_text(encoding="utf-8")
EXERCISES = sorted(path.parent.name for path in COURSE.glob("[0-9]*/README.md"))
WEEKS = 14, 12, 10


class Syllabus(unittest.TestCase):
    def test_weeks_of_a_term(self):
        rows = re.findall(r"^\| (\d*) ?\| (\d*) ?\| (\d*) ?\| (.*?) \|", PAGE, re.MULTILINE)
        for column, weeks in enumerate(WEEKS):
            numbers = [row[column] for row in rows if row[column]]
            self.assertEqual([str(number) for number in range(1, weeks + 1)], numbers)
            exercises = [re.search(r"\((\S+)/README\.md\)", row[3]) for row in rows if row[column]]
            self.assertEqual(EXERCISES, [found[1] for found in exercises if found])

    def test_minutes_of_the_afternoon(self):
        minutes = re.findall(r"^\| (\d+) \| [A-Z]", PAGE, re.MULTILINE)
        self.assertEqual(4 * 60, sum(map(int, minutes)))


if __name__ == "__main__":
    unittest.main()
