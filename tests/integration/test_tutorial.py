"""docs/tutorial: does what its pages say, in their order, and compares what the reader sees with what they show. Each
page has a server of its own: the arm is at its soft home, and the blocks are where the workcell file puts them.

The fences of a page: `console` has commands (`$ `) with their output; `telnet` has what is typed, and the reply in
quotes; `term` is the screen of `xr3 term`; `log` has lines of the server's log; `python` has a program, whose name is
in its first line. A line `...` stands for any number of lines, and `...` within a line for any text."""

import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

from support import ROOT, XR3, Server, run_xr3
from terminal import Terminal

TUTORIAL = pathlib.Path(ROOT, "docs", "tutorial")
PAGES = sorted(TUTORIAL.glob("[0-9]*.md"))
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
FIGURES = re.compile(r"<!-- figures: (.*?)-->", re.DOTALL)
FIGURE = re.compile(r"\(figures/([\w-]+\.svg)\)")
PAUSE_MS = 1000  # the pause of a person before each line that is typed, in simulated time
COMMAND_S = 60.0
CONNECTED = "connected to localhost:9600; ~. quits, ~? is help"


def pattern(shown):
    """A regular expression for the text with its wildcards."""
    lines = [r"(.*\n)*" if line.strip() == "..." else ".*".join(map(re.escape, line.rstrip().split("..."))) + r" *\n"
             for line in shown.splitlines()]
    return "".join(lines)


def acts_at_once(typed):
    """Inquiries need no Enter."""
    return typed.endswith("?") or typed in ("I", "J", "K", "ET")


class Reader:
    """Somebody who works through the pages in a checkout, with a shell whose variables last."""

    def __init__(self, test, folder):
        self.test, self.folder, self.variables = test, folder, ["unset PYTHONPATH XR3_HOST"]
        self.lines_opened = 0  # of the server of this page
        for name in "clients", "docs", "data":
            (folder / name).symlink_to(pathlib.Path(ROOT, name))
        (folder / "build" / "release").mkdir(parents=True)
        (folder / "build" / "release" / "xr3").symlink_to(XR3)

    def compare(self, shown, seen):
        self.test.assertTrue(re.fullmatch(pattern(shown), seen),
                             f"the page shows\n{shown}\nand the program printed\n{seen}")

    def python(self, text):
        name = re.match(r"# (\w+\.py)\n", text)
        self.test.assertTrue(name, "the first line of a program is a comment with its name")
        (self.folder / name[1]).write_text(text, encoding="utf-8")

    def console(self, text, xr3):
        for command, shown in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE):
            if command == "./run":
                greeting = re.sub(r":\d+ monitor=(.*):\d+", r":9600 monitor=\1:9601", xr3.greeting)
                self.compare(shown, greeting)
            elif command.startswith("export "):
                self.variables.append(command)
            else:
                self.compare(shown, self.shell(command, xr3))

    def shell(self, command, xr3):
        command = command.replace("9600", str(xr3.robot_port)).replace("9601", str(xr3.monitor_port))
        environment = {**os.environ, "XR3_PORT": str(xr3.robot_port), "XR3_MONITOR_PORT": str(xr3.monitor_port),
                       "XR3_POLL_MS": "5", "PYTHONDONTWRITEBYTECODE": "1", "LC_ALL": "C.UTF-8"}
        done = subprocess.run(["bash", "-c", "\n".join([*self.variables, command])], cwd=self.folder, env=environment,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=COMMAND_S, check=False)
        return done.stdout

    def telnet(self, text, xr3, monitor):
        first, *lines = text.splitlines()
        self.test.assertEqual("$ telnet localhost 9600", first)
        self.lines_opened += 1
        line = xr3.line()
        for shown in lines:
            typed, _, reply = re.fullmatch(r"(\S+(?: \S+)*)( +'(.+?)')?(?:  .*)?", shown).groups()
            monitor.step(PAUSE_MS, after=line)
            line.send(typed + "\r\n")
            self.test.assertEqual(reply or "", line.read(len(reply or "")).decode(), shown)
            monitor.step(0, after=line)
            self.test.assertEqual(b"", line.unread(), shown)
        line.close()

    def term(self, text, xr3, monitor):
        """A fence without the first line of `xr3 term` goes on in a terminal that is open."""
        self.lines_opened += 1
        shown = text if text.startswith(CONNECTED) else f"{CONNECTED}\n{text}"
        sent = 0
        with Terminal([XR3, "term", f"localhost:{xr3.robot_port}"], columns=120) as terminal:
            terminal.wait_text("~? is help")
            for typed, answer in re.findall(r"^(\S.*)\n((?: .*\n)*)", shown.split("\n", 1)[1], re.MULTILINE):
                monitor.step(PAUSE_MS, after=(self.lines_opened, sent))
                keys = typed + ("" if acts_at_once(typed) else "\r")
                terminal.press(keys)
                sent += len(keys)
                monitor.step(0, after=(self.lines_opened, sent))
                if answer:
                    terminal.wait_text(answer.splitlines()[-1])
            port = str(xr3.robot_port)
            terminal.wait_for(lambda screen: screen.replace(port, "9600").rstrip() == shown.rstrip(), shown)
            terminal.press("~.")
            terminal.wait_end()

    def log(self, text, xr3):
        for line in text.splitlines():
            xr3.wait_log(".*".join(map(re.escape, line.split("..."))))


class Tutorial(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_pages_in_their_order(self):
        self.assertGreater(len(PAGES), 5)
        reader = Reader(self, self.folder)
        for page in PAGES:
            fences = FENCE.findall(page.read_text(encoding="utf-8"))
            is_by_hand = any(kind in ("telnet", "term") for kind, _ in fences)
            clock = "manual" if is_by_hand else "real:50"
            with self.subTest(page=page.name), Server(clock=clock) as xr3, xr3.monitor() as monitor:
                reader.lines_opened = 0
                for kind, text in fences:
                    self.assertIn(kind, ("console", "telnet", "term", "log", "python"))
                    if kind in ("telnet", "term"):
                        getattr(reader, kind)(text, xr3, monitor)
                    elif kind == "python":
                        reader.python(text)
                    else:
                        getattr(reader, kind)(text, xr3)

    def test_figures_are_those_that_the_program_draws(self):
        drawn = set()
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            for command in "".join(FIGURES.findall(text)).strip().splitlines():
                _, what, *options, name = shlex.split(command)
                with self.subTest(page=page.name, figure=name):
                    done = run_xr3(what, *options, self.folder / name)
                    self.assertEqual(0, done.returncode, done.stderr)
                    self.assertEqual((self.folder / name).read_text(encoding="utf-8"),
                                     (TUTORIAL / "figures" / name).read_text(encoding="utf-8"),
                                     f"draw it again: in docs/tutorial/figures, {command.strip()}")
                    self.assertIn(name, FIGURE.findall(text), "no picture of the page")
                drawn.add(name)
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
