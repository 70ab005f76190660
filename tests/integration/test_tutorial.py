"""docs/tutorial: a reader does what its pages say, in their order, and sees what they show (reader.py). Each page has a
server of its own: the arm is at its soft home, and the blocks are where the workcell file puts them."""
# labels: full

import os
import pathlib
import re
import tempfile
import unittest

from reader import Reader, check_figures, clock_for
from support import ROOT, Server, run_xr3

TUTORIAL = pathlib.Path(ROOT, "docs", "tutorial")
PAGES = sorted(TUTORIAL.glob("[0-9]*.md"))


class Tutorial(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_pages_in_their_order(self):
        self.assertGreater(len(PAGES), 5)
        reader = Reader(self, self.folder, others=("text",))  # text of the robot in a page
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            with self.subTest(page=page.name), Server(clock=clock_for(text)) as xr3:
                reader.follow(text, xr3)

    def test_the_program_of_the_first_page_prints_what_it_says_and_meets_its_goals(self):
        """With 380 in place of 392 it misses one."""
        page = PAGES[0].read_text(encoding="utf-8")
        program = re.search(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)[1]
        printed = re.findall(r"^```text\n(.*?)^```", page, re.MULTILINE | re.DOTALL)[-1]
        for place, missed in ("392", 0), ("380", 1):
            (self.folder / "first.py").write_text(program.replace("392", place), encoding="utf-8")
            done = run_xr3("exec", "--goals", "find-and-pick", "--clock", "bytes:200", "--", "python3", self.folder / "first.py",
                           env={**os.environ, "PYTHONPATH": os.path.join(ROOT, "clients", "python")})
            self.assertTrue(done.stdout.startswith(printed), done.stdout)
            self.assertEqual((8 - missed, missed), (done.stdout.count("✓"), done.stdout.count("✗")), done.stdout)

    def test_figures_are_those_that_the_program_draws(self):
        drawn = set().union(*(check_figures(self, page, self.folder) for page in PAGES))
        self.assertEqual(drawn, {path.name for path in (TUTORIAL / "figures").iterdir()})

    def test_every_page_leads_to_the_next_one(self):
        """The front page lists all; each page but the last one links to the next one."""
        front = (TUTORIAL / "README.md").read_text(encoding="utf-8")
        listed = re.findall(r"^\| \d \| \[.*?\]\((\d-[\w-]+\.md)\)", front, re.MULTILINE)
        self.assertEqual([page.name for page in PAGES], listed)
        for page, successor in zip(PAGES, PAGES[1:]):
            self.assertIn(f"]({successor.name})", page.read_text(encoding="utf-8").splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
