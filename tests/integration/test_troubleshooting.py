"""docs/troubleshooting.md: each symptom is caused as its section says, on a server of its own, and looks as it says
(reader.py). The options of the server are in a comment of the section, `<!-- server: OPTIONS -->`."""
# labels: full

import pathlib
import re
import tempfile
import unittest

from reader import Reader, clock_for
from support import ROOT, Server

PAGE = pathlib.Path(ROOT, "docs", "troubleshooting.md")


class Symptoms(unittest.TestCase):
    def test_each_section(self):
        sections = re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
        self.assertGreater(len(sections), 8)
        with tempfile.TemporaryDirectory() as folder:
            reader = Reader(self, pathlib.Path(folder), others=("text",))
            reader.variables.append("PATH=$PWD/build/release:$PATH")
            for section in sections:
                options = re.search(r"^<!-- server: (.*) -->$", section, re.MULTILINE)
                with self.subTest(section.splitlines()[0]), \
                        Server(*(options[1].split() if options else ()), clock=clock_for(section)) as xr3:
                    reader.follow(section, xr3)


if __name__ == "__main__":
    unittest.main()
