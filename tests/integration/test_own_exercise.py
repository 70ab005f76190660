"""docs/exercises.md: a reader makes an exercise of one of the course, as the page says (reader.py). Its tables name the
keys and the files that the exercises of the course have, and its example is one of them."""
# labels: full

import json
import pathlib
import re
import tempfile
import unittest
import zipfile

from reader import FENCE, Reader, play
from support import ROOT

PAGE = pathlib.Path(ROOT, "docs", "exercises.md")
TEXT = PAGE.read_text(encoding="utf-8")
EXERCISES = sorted(path.parent for path in pathlib.Path(ROOT, "docs", "course").glob("*/exercise.json"))
SETTINGS = {exercise: json.loads((exercise / "exercise.json").read_text(encoding="utf-8")) for exercise in EXERCISES}


def first_cells(heading):
    """The names in the first column of the table with this first cell of its heading."""
    table = TEXT.partition(f"\n| {heading} |")[2].partition("\n\n")[0]
    return [name for row in table.splitlines() for name in re.findall(r"`(\S+)`", row.split(" | ")[0])]


class OwnExercise(unittest.TestCase):
    def test_steps(self):
        with tempfile.TemporaryDirectory() as folder:
            play(Reader(self, pathlib.Path(folder), others=("json",)), TEXT)
            with zipfile.ZipFile(pathlib.Path(folder, "my-exercise.zip")) as archive:
                names = archive.namelist()
        self.assertIn("for-students/exercise.json", names)
        self.assertEqual([], [name for name in names if re.search("solution|wrong", name)])

    def test_the_example_is_that_of_the_course(self):
        shown = [json.loads(text) for kind, text in FENCE.findall(TEXT) if kind == "json"]
        self.assertEqual([SETTINGS[EXERCISES[8]]], shown)

    def test_the_tables_name_all_keys_and_files(self):
        self.assertEqual(set(first_cells("key")), {key for settings in SETTINGS.values() for key in settings})
        files = {path.name for exercise in EXERCISES for path in exercise.iterdir()} - {"figures"}
        self.assertEqual(set(first_cells("file or folder")), files)


if __name__ == "__main__":
    unittest.main()
