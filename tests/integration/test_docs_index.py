"""The pages of docs/ as a reader of a git host or an editor sees them: docs/README.md lists each page once, every link
leads to a file and to a heading, and the navigation of the site (mkdocs.yml) has each page once."""
# labels: full

import os
import pathlib
import posixpath
import re
import unittest

from support import ROOT

DOCS = pathlib.Path(ROOT, "docs")
CODE = re.compile(r"^ *```.*?^ *```$|(`+)(?!`).+?(?<!`)\1(?!`)", re.DOTALL | re.MULTILINE)
LINK = re.compile(r"\]\((?!\w+:)([^)\s]+)\)")
HEADING = re.compile(r"^#{1,6} +(.+?)(?: *#+)?$", re.MULTILINE)


def places():
    """The pages of the documentation: those of docs/, and those that mkdocs.yml adds."""
    return [*(path.relative_to(ROOT).as_posix() for path in sorted(DOCS.rglob("*.md"))), *outside().values()]


def outside():
    """{path in the site: path in the repository} of the pages outside of docs/."""
    return dict(re.findall(r"^    (\S+\.md): (\S+\.md)$", pathlib.Path(ROOT, "mkdocs.yml").read_text(encoding="utf-8"),
                           re.MULTILINE))


def text_of(place):
    return pathlib.Path(ROOT, place).read_text(encoding="utf-8")


def links(place):
    """(file, anchor) of every link of a page that stays in the repository."""
    for link in LINK.findall(CODE.sub("", text_of(place))):
        path, _, anchor = link.partition("#")
        yield posixpath.normpath(posixpath.join(posixpath.dirname(place), path)) if path else place, anchor


def anchors(place):
    """The anchors that a git host makes of the headings of a page."""
    found = set()
    for heading in HEADING.findall(re.sub(r"^ *```.*?^ *```$", "", text_of(place), flags=re.DOTALL | re.MULTILINE)):
        text = re.sub(r"\[([^]]*)\]\([^)]*\)|`", r"\1", heading)
        found.add(re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-"))
    return found


def listed(place):
    """The pages to which the list items of a page link."""
    items = re.findall(r"^\s*(?:[*-]|\d\.) \[[^]]*\]\(([^)#]+)\)", text_of(place), re.MULTILINE)
    return [posixpath.normpath(posixpath.join(posixpath.dirname(place), item)) for item in items]


class Index(unittest.TestCase):
    def test_links_lead_to_files_and_headings(self):
        checked = 0
        for place in places():
            for path, anchor in links(place):
                with self.subTest(f"{place}: {path}#{anchor}"):
                    self.assertTrue(os.path.isfile(os.path.join(ROOT, path)), "no such file (a folder is none, either)")
                    if anchor and path.endswith(".md"):
                        self.assertIn(anchor, anchors(path))
                    checked += 1
        self.assertGreater(checked, 300)

    def test_every_linked_page_is_a_page_of_the_site(self):
        pages = set(places())
        for place in places():
            for path, _ in links(place):
                with self.subTest(f"{place}: {path}"):
                    self.assertTrue(not path.endswith(".md") or path in pages, "mkdocs.yml does not add it (outside)")

    def test_the_index_lists_every_page_once(self):
        """A page that docs/README.md does not list has a link in the README.md of its folder, which is listed there."""
        items = listed("docs/README.md")
        for path in sorted(DOCS.rglob("*.md")):
            place = path.relative_to(ROOT).as_posix()
            with self.subTest(place):
                if place == "docs/README.md" or items.count(place) == 1:
                    continue
                self.assertEqual(0, items.count(place))
                folder = path.parent.parent if path.name == "README.md" else path.parent
                index = (folder / "README.md").relative_to(ROOT).as_posix()
                self.assertEqual(1, items.count(index), f"docs/README.md does not list {place}")
                self.assertIn(place, [target for target, _ in links(index)])

    def test_the_navigation_has_every_page_once(self):
        text = pathlib.Path(ROOT, "mkdocs.yml").read_text(encoding="utf-8")
        shown = re.findall(r"^ *- (?:[^:\n]+: )?(\S+\.md)$", text.partition("\nnav:")[2], re.MULTILINE)
        expected = [*(path.relative_to(DOCS).as_posix() for path in DOCS.rglob("*.md")), *outside()]
        self.assertEqual(sorted(expected), sorted(shown))


if __name__ == "__main__":
    unittest.main()
