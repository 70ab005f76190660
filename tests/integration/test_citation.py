"""CITATION.cff: it is YAML with the members that CFF 1.2.0 requires, and agrees with the project's version, licence and
authors, and with what the documentation says about the paper."""
# labels: full

import pathlib
import re
import unittest

from support import ROOT

try:
    import yaml
except ImportError:
    yaml = None

FILE = pathlib.Path(ROOT, "CITATION.cff")


def text_of(name):
    return pathlib.Path(ROOT, name).read_text(encoding="utf-8")


class Citation(unittest.TestCase):
    def member(self, name):
        """The value of a member of the file itself: the lines of a reference are indented."""
        found, = re.findall(rf"^{name}: (.*)$", FILE.read_text(encoding="utf-8"), re.MULTILINE)
        return found

    def test_agrees_with_the_project(self):
        self.assertEqual("1.2.0", self.member("cff-version"))
        version = re.search(r"^project\(xr3 VERSION (\S+)", text_of("CMakeLists.txt"), re.MULTILINE)[1]
        self.assertEqual(version, self.member("version"))
        licence = text_of("LICENSE")
        self.assertEqual(licence.split()[0], self.member("license"))
        holder = re.search(r"^Copyright \(c\) \d+ (.*)$", licence, re.MULTILINE)[1]
        self.assertIn(f"- name: {holder}\n", FILE.read_text(encoding="utf-8"))

    @unittest.skipUnless(yaml, "PyYAML is not installed (Debian package python3-yaml)")
    def test_members(self):
        citation = yaml.safe_load(FILE.read_text(encoding="utf-8"))
        self.assertLessEqual({"cff-version", "message", "title", "authors"}, set(citation))
        self.assertEqual(("software", "xr3"), (citation["type"], citation["title"]))
        paper, = citation["references"]
        self.assertLessEqual({"type", "title", "authors"}, set(paper))
        self.assertIn(f"*{paper['title']}*", text_of("docs/glossary.md"))
        self.assertIn(", ".join(author["family-names"] for author in paper["authors"]), text_of("docs/glossary.md"))
        self.assertIn(f"{paper['journal']} {paper['volume']}({paper['issue']}), {paper['year']}", text_of("README.md"))


if __name__ == "__main__":
    unittest.main()
