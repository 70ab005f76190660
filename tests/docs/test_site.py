"""The site that scripts/site has built in build/site: links, anchors, assets, navigation, search index and text."""

import json
import os
import pathlib
import re
import sys
import unittest
import urllib.parse

from markdown_it import MarkdownIt

from built_site import Page, Site, shared

ROOT = pathlib.Path(os.environ["XR3_ROOT"])
SITE = ROOT / "build" / "site"
sys.path.insert(0, str(ROOT / "site"))

import hook  # noqa: E402  pylint: disable=wrong-import-position


def outside_pages():
    """{path in the site: path in the repository} of the pages outside of docs/, from mkdocs.yml."""
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    return dict(re.findall(r"^    (\S+\.md): (\S+\.md)$", text, re.MULTILINE))


def sources():
    """{path of the page in the site: its Markdown file}."""
    pages = {path.relative_to(ROOT / "docs").as_posix(): path for path in sorted((ROOT / "docs").rglob("*.md"))}
    pages.update({src: ROOT / place for src, place in outside_pages().items()})
    return {re.sub(r"(^|/)README\.md$", r"\1index.md", src).removesuffix("md") + "html": path
            for src, path in pages.items()}


class BuiltSite(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.site = Site(SITE, urllib.parse.urlsplit(os.environ.get("XR3_SITE_URL", "")).path or "/")

    def none(self, problems):
        if problems:
            self.fail("\n" + "\n".join(problems))

    def test_links_lead_somewhere(self):
        self.assertGreater(sum(len(page.links) for page in self.site.pages.values()), 5000)
        self.none(self.site.dead_links())
        print("\nLinks that leave the site (not followed):")
        for link, page in sorted(self.site.outside_links().items()):
            print(f"  {link}  ({page})")

    def test_nothing_comes_from_another_server(self):
        self.none(self.site.outside_assets())

    def test_the_server_shows_all_of_it(self):
        self.none(self.site.not_served())

    def test_each_page_is_in_the_navigation_once(self):
        self.assertGreater(len(sources()), 80)
        self.none(self.site.not_once(sources()))

    def test_every_page_can_be_found(self):
        index = json.loads((SITE / "search" / "search_index.json").read_text(encoding="utf-8"))
        found = {entry["location"].split("#")[0] or "index.html" for entry in index["docs"]}
        self.assertEqual(set(), set(sources()) - found)

    def test_no_path_of_this_machine(self):
        for name in "build", "clients", "docs", "site":
            self.none(self.site.naming(f"{ROOT}/{name}"))

    def test_the_site_shows_what_a_git_host_shows(self):
        """Headings, paragraphs, lists, cells and code are those that an implementation of CommonMark makes of the file."""
        for name, path in sources().items():
            with self.subTest(name):
                markdown = MarkdownIt("commonmark").enable("table").render(path.read_text(encoding="utf-8"))
                self.assertEqual(Page(markdown, whole=True).blocks, self.site.pages[name].blocks)

    @unittest.skipUnless((SITE / "play").is_dir(), "the site has no robots: scripts/playground, then scripts/site")
    def test_each_step_and_each_exercise_has_a_robot(self):
        """Program and goals are in its link, where the page has them."""
        for name in (name for name in sources() if re.fullmatch(r"(tutorial/\d-|course/\d\d-).*", name)):
            with self.subTest(name):
                [link] = [link for link in self.site.pages[name].links if "/play/" in link]
                members = shared(link)
                self.assertLess(len(link), 8192)
                compile(members.get("program", ""), name, "exec")
                if name.startswith("course/"):
                    json.loads(members["goals"])
                    self.assertIn("TODO", members["program"])
        self.assertIn("find-and-pick", shared(self.link("tutorial/9-judge.html"))["goals"])
        self.assertEqual({"recording"}, set(shared(self.link("recording.html"))))
        self.assertTrue((SITE / "play" / shared(self.link("recording.html"))["recording"]).is_file())

    def link(self, name):
        return next(link for link in self.site.pages[name].links if "play/" in link and "index" not in link)

    def test_anchors_are_those_of_a_git_host(self):
        for heading, anchor in (("A class: many robots", "a-class-many-robots"),
                                ("`xr3 exec` & more", "xr3-exec--more"), ("The snake_case", "the-snake_case"),
                                ("Connect from …", "connect-from-")):
            self.assertEqual(anchor, hook.slug(heading))


if __name__ == "__main__":
    unittest.main()
