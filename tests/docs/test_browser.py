"""The built site in headless Chromium, at the width of a phone and of a desktop: nothing is wider than the screen, no
script fails, nothing comes from another server, the search finds, the dark colours can be chosen."""

import os
import pathlib
import re
import unittest

from browser import CHROMIUM, MISSING, Chromium
from session import Folder, Session

SITE = pathlib.Path(os.environ["XR3_ROOT"], "build", "site")
PHONE, DESKTOP = (390, 844), (1440, 900)
OFTEN_READ = ["index.html", "xr3.html", "protocol.html", "options.html", "monitor.html", "monitor-messages.html",
              "viewer.html", "paper-map.html", "python-api.html", "kinematics.html", "tutorial/1-first-line.html",
              "course/08-vision/index.html", "graded/index.html", "own-robot.html", "troubleshooting.html"]
WIDTH = "Math.max(document.documentElement.scrollWidth, document.body.scrollWidth)"
WIDEST = """[...document.querySelectorAll('body *')].filter((e) => e.getBoundingClientRect().right > WIDTH + 1
    && !e.closest('.md-typeset__scrollwrap, pre, .md-sidebar'))
    .slice(0, 3).map((e) => e.outerHTML.slice(0, 120)).join(' | ')"""
SCHEME = "document.body.getAttribute('data-md-color-scheme')"
BRIGHTNESS = """getComputedStyle(document.body).backgroundColor.match(/\\d+/g).slice(0, 3)
    .reduce((sum, each) => sum + Number(each), 0)"""
OF_PICTURES = re.compile("WebGL|GL Driver|GPU stall")  # complaints of a Chromium without a graphics card
ROBOTS = "[...document.querySelectorAll('.robot')]"
FRAME = "document.querySelector('.robot iframe')?.contentDocument"
SWITCH = "document.querySelector('[data-md-component=palette] label:not([hidden])').click()"


@unittest.skipUnless(CHROMIUM, MISSING)
class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.chromium = cls.enterClassContext(Chromium())
        cls.folder = cls.enterClassContext(Folder(SITE))
        cls.pages = sorted(path.relative_to(SITE).as_posix() for path in SITE.rglob("*.html")
                           if not {"report", "play"} & set(path.parts) and path.name != "404.html")

    def session(self, size):
        session = Session(self.chromium, *size)
        self.enterContext(session)
        self.addCleanup(lambda: self.assertEqual([], [each for each in session.complaints if not OF_PICTURES.search(each)]))
        self.addCleanup(lambda: self.assertEqual([], [url for url in session.requests if not url.startswith(
            (self.folder.url, "data:", "blob:", "about:"))]))
        return session

    def check_width(self, size, pages):
        session = self.session(size)
        for page in pages:
            with self.subTest(page):
                session.open(self.folder.url + page)
                if session.run(WIDTH) > size[0]:
                    self.fail(f"{session.run(WIDTH)} px wide: {session.run(WIDEST.replace('WIDTH', str(size[0])))}")

    def test_no_page_is_wider_than_a_phone(self):
        self.assertGreater(len(self.pages), 80)
        self.check_width(PHONE, self.pages)

    def test_no_page_is_wider_than_a_desktop(self):
        self.assertLess(set(OFTEN_READ), set(self.pages))
        self.check_width(DESKTOP, OFTEN_READ)

    def test_the_search_finds_a_word(self):
        for size in PHONE, DESKTOP:
            with self.subTest(size):
                session = self.session(size)
                session.open(self.folder.url + "index.html")
                if size == PHONE:
                    session.run("document.querySelector('label[for=__search]').click()")
                session.run("document.querySelector('[data-md-component=search-query]').focus()")
                session.send("Input.insertText", text="gripper")
                link = session.until("document.querySelector('.md-search-result__item a')?.href")
                self.assertTrue(link.startswith(self.folder.url), link)
                session.open(link)
                self.assertIn("gripper", session.run("document.querySelector('article').innerText.toLowerCase()"))

    def test_the_dark_colours_can_be_chosen_and_stay(self):
        for size in PHONE, DESKTOP:
            with self.subTest(size):
                session = self.session(size)
                light = {"name": "prefers-color-scheme", "value": "light"}
                session.send("Emulation.setEmulatedMedia", features=[light])
                session.open(self.folder.url + "index.html")
                session.run("localStorage.clear()")
                session.open(self.folder.url + "protocol.html")
                self.assertEqual("default", session.run(SCHEME))
                self.assertGreater(session.run(BRIGHTNESS), 700)
                session.run(SWITCH)
                session.until(f"{SCHEME} === 'slate'")
                self.assertLess(session.run(BRIGHTNESS), 200)
                session.open(self.folder.url + "index.html")
                self.assertEqual("slate", session.run(SCHEME))
                session.run("localStorage.clear()")

    @unittest.skipUnless((SITE / "play").is_dir(), "the site has no robots: scripts/playground, then scripts/site")
    def test_a_robot_opens_in_the_page_and_only_one_is_alive(self):
        for size in PHONE, DESKTOP:
            with self.subTest(size):
                session = self.session(size)
                session.open(self.folder.url + "tutorial/7-pick.html")
                self.assertFalse([url for url in session.requests if "/play/" in url])
                session.run("document.querySelector('.robot').after(document.querySelector('.robot').cloneNode(true))")
                for place in "first", "last":
                    session.run(f"{ROBOTS}.{'shift' if place == 'first' else 'pop'}().querySelector('a').click()")
                    session.until(f"{FRAME}?.querySelector('#status-word')?.textContent === 'Ready'")
                    self.assertEqual(1, session.run("document.querySelectorAll('iframe').length"))
                    self.assertEqual(place == "first", session.run(f"Boolean({ROBOTS}[0].querySelector('iframe'))"))
                    session.until(f"{FRAME}.querySelector('#program-editor').shadowRoot?.textContent.includes('between the jaws')")
                    self.assertLessEqual(session.run(WIDTH), size[0])
                session.run("document.querySelector('.robot button').click()")
                self.assertEqual([0, 2], session.run("['iframe', '.robot > a.md-button'].map((e) => document.querySelectorAll(e).length)"))

    def test_a_phone_has_the_navigation_in_a_drawer(self):
        session = self.session(PHONE)
        session.open(self.folder.url + "index.html")
        drawer = "document.querySelector('.md-sidebar--primary').getBoundingClientRect().left"
        self.assertLess(session.run(drawer), 0)
        session.run("document.querySelector('label[for=__drawer]').click()")
        session.until(f"{drawer} >= 0")


if __name__ == "__main__":
    unittest.main()
