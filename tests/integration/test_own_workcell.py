"""docs/own-workcell.md: a reader writes its files, does what it says and sees what it shows (reader.py). The pictures
of the page are those that its commands draw."""
# labels: full

import pathlib
import tempfile
import unittest

from reader import PICTURE, Reader, play
from support import ROOT

PAGE = pathlib.Path(ROOT, "docs", "own-workcell.md")


class OwnWorkcell(unittest.TestCase):
    def test_steps_and_pictures(self):
        text = PAGE.read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as folder:
            play(Reader(self, pathlib.Path(folder)), text)
            shown = [name for _, name in PICTURE.findall(text)]
            self.assertEqual(sorted(shown), sorted(path.name for path in (PAGE.parent / "own-workcell").iterdir()))
            for name in shown:
                with self.subTest(name):
                    drawn = pathlib.Path(folder, name).read_text(encoding="utf-8")
                    self.assertEqual(drawn, (PAGE.parent / "own-workcell" / name).read_text(encoding="utf-8"),
                                     "draw it again, as the page says")


if __name__ == "__main__":
    unittest.main()
