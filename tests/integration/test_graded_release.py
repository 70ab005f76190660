"""The graded class of docs/graded: its report is what `xr3 grade` writes now, names nothing of the machine that has
written it, and works as a page in a browser. `test_graded_release.py --write` writes the report again."""

import csv
import functools
import http.server
import json
import os
import pathlib
import re
import shlex
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import unittest
import urllib.parse

import junit
from browser import CHROMIUM, MISSING, Chromium
from support import DEADLINE_S, GRADE, LOCALHOST, ROOT, XR3

GRADED = pathlib.Path(ROOT, "docs", "graded")
REPORT = GRADED / "report"
PAGE = (GRADED / "README.md").read_text(encoding="utf-8")
OUTCOMES = {"ada.py": "finished", "ben.py": "finished", "cleo.py": "finished", "dan.py": "finished", "eva.py": "finished",
            "finn.py": "time_up", "gita.py": "failed"}
MAX_RECORDINGS_BYTES = 300 * 1024
TASK_S = 120
# Texts that depend on the machine: the time of a run, how the bytes of a client came in pieces, and in recordings its port
# and the checksums of lines.
WALL = re.compile(r'"wall_seconds":[\d.]+')
CHECKSUM = re.compile(r',"c":"[^"]+"')


def grade(report):
    """Runs the command of the page, with this folder for the report."""
    words = [*GRADE, *shlex.split(re.search(r"^\$ xr3 grade (.*)$", PAGE, re.MULTILINE)[1])]
    words[words.index("--report") + 1] = str(report)
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(ROOT, "clients", "python"))}
    return subprocess.run([XR3, *words], cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=TASK_S, check=True)


def contents(path):
    """The content of a file without the texts that depend on the machine."""
    text = path.read_text(encoding="utf-8")
    if path.name == "result.json":
        return WALL.sub("", text)
    if path.name == "transcript.txt":
        rows = [row.split(" ", 3) for row in text.splitlines()]
        return "".join(row[3] for row in rows if row[2] == ">"), [row for row in rows if row[2] == "<"]
    if path.suffix != ".xr3rec":
        return text
    head, *lines = map(json.loads, text.splitlines())
    head.pop("c")
    sent = "".join(line["in"][:line.get("taken")] for line in lines if "in" in line)
    replies = [(line["tick"], line["out"]) for line in lines if "out" in line]
    return head, sent, replies, lines[-1]["end"], lines[-1]["hash"]


def files(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}


class Graded(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.fresh = pathlib.Path(temporary.name, "report")
        grade(cls.fresh)

    def test_the_report_is_the_one_that_grade_writes(self):
        self.assertEqual(files(self.fresh), files(REPORT))
        for name in sorted(files(REPORT)):
            with self.subTest(name):
                self.assertTrue(contents(self.fresh / name) == contents(REPORT / name),
                                "not so any more: write it again with test_graded_release.py --write, and read the changes")

    def test_every_verdict_is_right(self):
        with open(REPORT / "grades.csv", encoding="utf-8-sig") as file:
            rows = {row["submission"]: row for row in csv.DictReader(file)}
        self.assertEqual(OUTCOMES, {name: row["outcome"] for name, row in rows.items()})
        table = dict(re.findall(r"^\| \[(\w+\.py)\].*\| (\d+) \|", PAGE, re.MULTILINE))
        self.assertEqual(table, {name: row["points"] for name, row in rows.items()})
        for name, reason in (("cleo.py", '"grasped green" did not happen'), ("eva.py", "released_in_air"),
                             ("dan.py", "it stalled"), ("finn.py", "still ran after 30 seconds"),
                             ("gita.py", "exit code 1")):
            self.assertIn(reason, rows[name]["missed"])

    def test_the_junit_file_is_valid(self):
        suites, errors = junit.read(REPORT / "junit.xml")
        self.assertEqual((7, []), (len(suites), errors))

    def test_the_report_names_nothing_of_the_machine(self):
        names = [str(pathlib.Path(ROOT).resolve()), tempfile.gettempdir(), str(pathlib.Path.home()), socket.gethostname()]
        for name in sorted(files(REPORT)):
            text = CHECKSUM.sub("", (REPORT / name).read_text(encoding="utf-8"))
            found = re.findall(rf"(?<!\w)(?:{'|'.join(map(re.escape, names))}|/home/)(?!\w)", text)
            self.assertEqual([], found, name)

    def test_the_recordings_are_whole_and_small(self):
        recordings = sorted(REPORT.rglob("*.xr3rec"))
        self.assertEqual(7, len(recordings))
        self.assertLess(sum(path.stat().st_size for path in recordings), MAX_RECORDINGS_BYTES)
        for path in recordings:
            done = subprocess.run([XR3, "replay", path], capture_output=True, text=True, timeout=DEADLINE_S, check=False)
            self.assertEqual(0, done.returncode, done.stderr)


class Folder(http.server.SimpleHTTPRequestHandler):
    """Serves the report, and forbids the page all that does not come from its own folder."""

    seen = []  # (path, status) of each request

    def end_headers(self):
        self.send_header("content-security-policy", "default-src 'none'; img-src 'self' data:; style-src 'unsafe-inline'")
        super().end_headers()

    def log_request(self, code="-", size="-"):
        self.seen.append((self.path, int(code)))

    def log_message(self, *_):
        pass


@unittest.skipUnless(CHROMIUM, MISSING)
class InABrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = http.server.ThreadingHTTPServer((LOCALHOST, 0), functools.partial(Folder, directory=str(REPORT)))
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.addClassCleanup(cls.server.server_close)
        cls.addClassCleanup(cls.server.shutdown)
        cls.chromium = Chromium()
        cls.chromium.__enter__()
        cls.addClassCleanup(cls.chromium.__exit__)
        cls.page = cls.chromium.open(f"http://{LOCALHOST}:{cls.server.server_port}/index.html")

    def test_all_pictures_load_and_say_what_they_show(self):
        pictures = self.page.run("""Promise.all([...document.images].map(async (image) => {
            image.loading = "eager";
            await image.decode();
            return [image.naturalWidth > 0, image.alt];
        }))""")
        self.assertEqual(7, len(pictures))
        self.assertTrue(all(is_there for is_there, _ in pictures), pictures)
        self.assertTrue(all(alt for _, alt in pictures), pictures)

    def test_the_page_asks_for_nothing_but_its_own_files(self):
        addresses = self.page.run("[...document.querySelectorAll('[src], [href]')].map((each) => each.src || each.href)")
        self.assertGreater(len(addresses), 7 * 4)
        origin = f"http://{LOCALHOST}:{self.server.server_port}/"
        self.assertEqual(["data:,"], [each for each in addresses if not each.startswith(origin)], "an empty icon")
        self.assertEqual(0, self.page.run("document.scripts.length"))
        self.assertEqual([], [request for request in Folder.seen if request[1] != 200])

    def test_every_link_leads_somewhere(self):
        links = self.page.run("[...document.links].map((link) => link.getAttribute('href'))")
        ids = set(self.page.run("[...document.querySelectorAll('[id]')].map((each) => each.id)"))
        for link in links:
            is_there = link[1:] in ids if link.startswith("#") else (REPORT / urllib.parse.unquote(link)).is_file()
            self.assertTrue(is_there, link)

    def test_the_page_fits_a_narrow_window(self):
        width = self.page.run("""new Promise((resolve) => {
            const frame = document.createElement("iframe");
            frame.style.cssText = "width: 360px; height: 640px";
            frame.srcdoc = "<!doctype html>" + document.documentElement.outerHTML;
            frame.onload = () => {
                resolve(frame.contentDocument.scrollingElement.scrollWidth);
                frame.remove();
            };
            document.body.append(frame);
        })""")
        self.assertLessEqual(width, 360)


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        shutil.rmtree(REPORT, ignore_errors=True)
        print(grade(REPORT).stdout, end="")
        sys.exit()
    unittest.main()
