"""The checks of built_site.py and of scripts/site find what they are for: broken sites, and a checkout with broken
links."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import yaml

from built_site import MOST_BYTES, Page, Site, shared

ROOT = pathlib.Path(os.environ["XR3_ROOT"])
PAGE = """<!doctype html><link rel="stylesheet" href="style.css"><link rel="canonical" href="https://example.org/">
<nav class="md-nav md-nav--primary">{nav}</nav>
<article class="md-content__inner"><h1 id="top">Title<a class="headerlink" href="#top">¶</a></h1>{body}</article>"""
NAV = ('<a class="md-nav__button md-logo" href="/index.html">xr3</a>'
       '<a href="/index.html">Home</a><a href="/a/b.html">B</a>')
BUILD_S = 300.0


class BrokenSites(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "a").mkdir()
        self.write("index.html", '<a href="a/b.html#top">B</a> <a href="https://example.org/">outside</a>')
        self.write("a/b.html", '<a href="../index.html">Home</a> <a href="#top">here</a> <a href="..">folder</a>')
        self.write("404.html", "", NAV)
        (self.folder / "style.css").write_text("a { background: url(data:image/png;base64,) }", encoding="utf-8")
        shutil.copy(self.folder / "style.css", self.folder / "a")

    def write(self, name, body, nav=""):
        (self.folder / name).write_text(PAGE.format(body=body, nav=nav), encoding="utf-8")

    def problems(self):
        site = Site(self.folder)
        return [*site.dead_links(), *site.outside_assets(), *site.not_once(["index.html", "a/b.html"]),
                *site.naming("/the/machine")]

    def test_a_good_site_has_no_problems(self):
        self.assertEqual([], self.problems())
        self.assertEqual({"https://example.org/": "index.html"}, Site(self.folder).outside_links())

    def test_a_site_below_a_path_of_its_server(self):
        self.write("404.html", "", NAV.replace('"/', '"/xr3/'))
        self.assertEqual([], Site(self.folder, "/xr3/").not_once(["index.html", "a/b.html"]))
        self.assertEqual([], Site(self.folder, "/xr3/").dead_links())

    def test_broken_pages(self):
        for body, problem in (
                ('<a href="c.html">', "a/b.html: the link c.html leads to no file of the site"),
                ('<a href="../../x.html">', "a/b.html: the link ../../x.html leads to no file of the site"),
                ('<a href="../index.html#gone">',
                 "a/b.html: the link ../index.html#gone leads to no heading of index.html"),
                ('<a href="#gone">', "a/b.html: the link #gone leads to no heading of a/b.html"),
                ('<img src="gone.png">', "a/b.html: the link gone.png leads to no file of the site"),
                ('<script src="https://example.org/x.js"></script>', "a/b.html: loads https://example.org/x.js"),
                ('<script src="//example.org/x.js"></script>', "a/b.html: loads //example.org/x.js"),
                ('<img srcset="../style.css 1x, http://example.org/2.png 2x">',
                 "a/b.html: loads http://example.org/2.png"),
                ('<link rel="preconnect" href="https://example.org">', "a/b.html: loads https://example.org"),
                ('<p style="background: url(https://example.org/p.png)">', "a/b.html: loads https://example.org/p.png"),
                ('<style>@import "https://example.org/p.css";</style>', "a/b.html: loads https://example.org/p.css"),
                ("<p>/the/machine/docs</p>", "a/b.html: contains /the/machine")):
            with self.subTest(body):
                self.write("a/b.html", body)
                self.assertEqual([problem], self.problems())

    def test_what_the_server_would_not_show(self):
        self.assertEqual([], Site(self.folder).not_served())
        (self.folder / "large.gif").write_bytes(bytes(MOST_BYTES + 1))
        self.write("a/b.html", '<p style="color: red"><button onclick="run()">')
        self.assertEqual(["a/b.html: has an attribute style", "a/b.html: has an attribute onclick",
                          "large.gif: has more than 16 MiB"], Site(self.folder).not_served())

    def test_a_style_sheet_that_loads_a_font(self):
        text = "@font-face { src: url('https://example.org/f.woff2') }"
        (self.folder / "style.css").write_text(text, encoding="utf-8")
        self.assertEqual(["style.css: loads https://example.org/f.woff2"], self.problems())

    def test_the_navigation(self):
        for nav, problem in ((NAV.replace('<a href="/a/b.html">B</a>', ""), "a/b.html 0 times"),
                             (NAV + '<a href="/a/b.html">B</a>', "a/b.html 2 times")):
            with self.subTest(problem):
                self.write("404.html", "", nav)
                self.assertEqual([f"the navigation has {problem}, not once"], self.problems())

    def test_the_text_of_a_page(self):
        page = Page(PAGE.format(nav="", body="<p>one</p><ul><li><p>two <code>E </code>,</p><pre>x\n</pre></li></ul>"))
        self.assertEqual([(0, "h1", "Title"), (0, "text", "one"), (1, "text", "two E ,"), (1, "pre", "x")], page.blocks)


class Checkout(unittest.TestCase):
    """A small checkout with the real mkdocs.yml but for its pages."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name in "site/hook.py", "site/play.py", "site/robot.js", "site/style.css", "scripts/site", "clients/web/src/icon.svg":
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.folder / name)
        settings = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:")[0]
        settings = re.sub(r"^    \S+\.md: \S+\.md\n", "", settings, flags=re.MULTILINE)
        settings = settings.replace("  outside:\n", "  outside:\n    xr3.md: README.md\n")
        (self.folder / "mkdocs.yml").write_text(settings + "\nnav: [README.md, xr3.md]\n", encoding="utf-8")
        (self.folder / "docs").mkdir()
        (self.folder / "README.md").write_text("# xr3\n\n[index](docs/README.md#all)\n", encoding="utf-8")
        (self.folder / "main.cpp").write_text("int main() {}\n", encoding="utf-8")
        (self.folder / "other.md").write_text("# Other\n", encoding="utf-8")

    def build(self, body, **variables):
        (self.folder / "docs" / "README.md").write_text(f"# All\n\n{body}\n", encoding="utf-8")
        done = subprocess.run([self.folder / "scripts" / "site"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=BUILD_S, check=False, env={**os.environ, "XR3_SITE_URL": "", **variables})
        return done.returncode, done.stdout


class BrokenCheckouts(Checkout):
    def test_links_that_work_in_the_repository(self):
        code, said = self.build("[front page](../README.md#xr3) and [source](../main.cpp)\n"
                                "* a list\n  <https://example.org/>")
        self.assertEqual(0, code, said)
        site = Site(self.folder / "build" / "site")
        self.assertEqual([], site.dead_links())
        self.assertLessEqual({"xr3.html#xr3", "files/main.cpp.txt"}, set(site.pages["index.html"].links))
        self.assertIn((1, "text", "a list https://example.org/"), site.pages["index.html"].blocks)
        self.assertEqual("int main() {}\n", (self.folder / "build/site/files/main.cpp.txt").read_text(encoding="utf-8"))

    def test_links_that_do_not(self):
        problems = {"../gone.cpp": "no file", "../clients": "a folder", "gone.md": "no file",
                    "../other.md": "a page that the site does not have"}
        code, said = self.build(" ".join(f"[x]({link})" for link in problems))
        self.assertNotEqual(0, code)
        for link, problem in problems.items():
            self.assertIn(f"README.md: the link {link} leads to {problem}: link to", said)


class Robots(Checkout):
    """Comments that become links to the robot without a server."""

    PROGRAM = "```python\n# go.py\nprint('go')\n```\n"

    def make_playground(self):
        (self.folder / "build" / "playground").mkdir(parents=True)
        (self.folder / "build" / "playground" / "index.html").write_text("a robot", encoding="utf-8")

    def links(self):
        return [link for link in Site(self.folder / "build" / "site").pages["index.html"].links if link.startswith("play/")]

    def test_each_becomes_a_link(self):
        self.make_playground()
        (self.folder / "docs" / "lab.json").write_text('{"blocks": []}', encoding="utf-8")
        code, said = self.build(self.PROGRAM + "\n<!-- robot: -->\n\n<!-- robot: program=go.py robot=adept-one workcell=lab.json -->")
        self.assertEqual(0, code, said)
        first, second = self.links()
        self.assertEqual("play/", first)
        self.assertEqual({"program": "# go.py\nprint('go')\n", "robot": "adept-one", "workcell": '{"blocks": []}'}, shared(second))
        self.assertEqual("a robot", (self.folder / "build/site/play/index.html").read_text(encoding="utf-8"))

    def test_an_address_of_the_site_is_needed_for_its_text(self):
        self.make_playground()
        text = "<!-- address: Try it -->"
        self.build(text)
        self.assertEqual([], [link for link in Site(self.folder / "build/site").pages["index.html"].links if "play" in link])
        self.build(text, XR3_SITE_URL="https://example.org/xr3/")
        self.assertIn("https://example.org/xr3/play/", Site(self.folder / "build/site").pages["index.html"].links)

    def test_what_it_names_must_exist(self):
        self.make_playground()
        for words, problem in (("program=gone.py", "program=gone.py is neither a name, nor a file beside the page, nor code"),
                               ("recording=a.xr3rec", "recording=a.xr3rec is neither"), ("arm=x", "there is no arm, but robot"),
                               ("exercise", "exercise.json")):
            code, said = self.build(f"<!-- robot: {words} -->")
            self.assertNotEqual(0, code)
            self.assertIn(problem, said)

    def test_without_the_robot_there_are_no_links_and_a_line_says_so(self):
        code, said = self.build("<!-- robot: -->")
        self.assertEqual((0, []), (code, self.links()))
        self.assertEqual(1, said.count("The pages have no robots in them: build/playground is missing (scripts/playground)."))


class Publishing(unittest.TestCase):
    """The files for GitHub Pages and GitLab Pages, which no test can run: what they call and name exists."""

    def setUp(self):
        self.settings = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")

    def check_variables(self, variables):
        self.assertEqual({"XR3_SITE_URL", "XR3_REPOSITORY_URL"}, set(variables))
        for name in variables:
            self.assertIn(f"!ENV [{name}, ", self.settings)

    def test_github(self):
        text = (ROOT / ".github/workflows/site.yml").read_text(encoding="utf-8")
        jobs = yaml.safe_load(text)["jobs"]
        steps = [step for job in jobs.values() for step in job["steps"]]
        for step in steps:
            self.assertRegex(step.get("uses", "actions/x@v1"), r"^actions/[a-z-]+@v\d+$")
        play, build = (step for step in steps if "run" in step)
        self.assertEqual(("scripts/playground", "./test --docs"), (play["run"], build["run"]))
        self.check_variables(build["env"])
        upload = next(step for step in steps if "upload-pages-artifact" in step.get("uses", ""))
        self.assertIn(f"\nsite_dir: {upload['with']['path']}\n", self.settings)
        self.assertEqual({"pages": "write", "id-token": "write"}, jobs["deploy"]["permissions"])

    def test_gitlab(self):
        job = yaml.safe_load((ROOT / "deploy/gitlab/pages.yml").read_text(encoding="utf-8"))["pages"]
        self.check_variables(job["variables"])
        self.assertEqual(["scripts/playground", "./test --docs", "mv build/site public"], job["script"])
        self.assertEqual(["public"], job["artifacts"]["paths"])


if __name__ == "__main__":
    unittest.main()
