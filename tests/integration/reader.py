"""A reader of the documentation, who does what a page shows and compares what is seen with it.

The fences of a page: `console` has commands (`$ `) with their output; `telnet` has what is typed, and the reply in
quotes; `screen` is what telnet then shows; `term` is the screen of `xr3 term`, perhaps below its command; `log` has
lines of the server's log, with other times, ports and numbers of lines and bytes;
`python` has a program and `json` a file, whose name is in its first line, a comment. A line `...` stands for any number
of lines, and `...` within a line for any text. `<!-- figures: ... -->` has commands that draw pictures."""

import os
import pathlib
import re
import shlex
import subprocess

from support import ROOT, XR3, Server, run_xr3
from terminal import Terminal

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
KINDS = "console", "telnet", "screen", "term", "log", "python", "json"
FIGURES = re.compile(r"<!-- figures: (.*?)-->", re.DOTALL)
PICTURE = re.compile(r"\]\((?:\./)?([\w-]+)/([\w-]+\.svg)\)")
RUN = re.compile(r"^\$ \./run(?: (.*))?$", re.MULTILINE)
PAUSE_MS = 1000  # the pause of a person before each line that is typed, in simulated time
COMMAND_S = 60.0
CONNECTED = "connected to localhost:9600; ~. quits, ~? is help"
TELNET_CONNECTED = "Trying 127.0.0.1...\nConnected to localhost.\nEscape character is '^]'.\n"
# Text that differs from log to log: time of day, tick, number of the line, port of the client, number of the byte.
DIFFERS = re.compile(r"^\d\d:\d\d:\d\d\.\d{3}|(?<=\bline )\d+|(?<=@)\d+|(?<=127\.0\.0\.1:)\d+|(?<=localhost:)\d+|(?<=; byte )\d+")


def pattern(shown):
    """A regular expression for the text with its wildcards."""
    lines = [r"(.*\n)*" if line.strip() == "..." else ".*".join(map(re.escape, line.rstrip().split("..."))) + r" *\n"
             for line in shown.splitlines()]
    return "".join(lines)


def acts_at_once(typed):
    """Inquiries need no Enter."""
    return typed.endswith("?") or typed in ("I", "J", "K", "ET")


class Reader:
    """A reader who works through the pages in a checkout, with a shell whose variables last."""

    def __init__(self, test, folder, others=()):
        self.others = others  # kinds of fences that the test of the page reads
        self.test, self.folder, self.variables = test, folder, ["unset PYTHONPATH XR3_HOST"]
        self.lines_opened = 0  # lines of this page's server
        self.shown_by_telnet = ""
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

    def json(self, text):
        """A robot, workcell, goals or fault file."""
        name = re.match(r"\* ([\w-]+\.json)\n", text)
        self.test.assertTrue(name, "the first line of a file is a comment with its name")
        (self.folder / name[1]).write_text(text, encoding="utf-8")

    def console(self, text, xr3):
        for command, shown in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE):
            if command.split()[0] == "./run":
                self.compare(shown, self.as_shown(xr3.greeting + xr3.page(), xr3))
            elif command.startswith("export "):
                self.variables.append(command)
            else:
                self.compare(shown, self.shell(command, xr3))

    def shell(self, command, xr3):
        for real, shown in self.ports(xr3).items():
            command = command.replace(shown, real)
        environment = {**os.environ, "XR3_PORT": str(xr3.robot_port), "XR3_MONITOR_PORT": str(xr3.monitor_port),
                       "XR3_POLL_MS": "5", "PYTHONDONTWRITEBYTECODE": "1", "LC_ALL": "C.UTF-8"}
        done = subprocess.run(["bash", "-c", "\n".join([*self.variables, command])], cwd=self.folder, env=environment,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=COMMAND_S, check=False)
        return self.as_shown(done.stdout, xr3)

    def ports(self, xr3):
        """The ports of the server, and what the page shows for them. Those of a roster are in its order."""
        ports = {str(xr3.robot_port): "9600", str(xr3.monitor_port): "9601"}
        if "--roster" in xr3.options:
            with xr3.monitor() as monitor:
                monitor.request("auth", token=(self.folder / "token").read_text(encoding="utf-8").strip())
                monitor.read()  # hello
                cells = monitor.call("cells")["cells"]
            ports.update({str(cell["robot_port"]): str(9701 + k) for k, cell in enumerate(cells)})
        return ports

    def as_shown(self, text, xr3):
        for real, shown in self.ports(xr3).items():
            text = text.replace(real, shown)
        return text

    def telnet(self, text, xr3, monitor):
        first, *lines = text.splitlines()
        self.test.assertEqual("$ telnet localhost 9600", first)
        self.lines_opened += 1
        self.shown_by_telnet = TELNET_CONNECTED
        line = xr3.line()
        for shown in lines:
            typed, _, reply = re.fullmatch(r"(\S+(?: \S+)*)( +'(.+?)')?(?:  .*)?", shown).groups()
            monitor.step(PAUSE_MS, after=line)
            line.send(typed + "\r\n")
            self.shown_by_telnet += f"{typed}\n{reply or ''}"
            self.test.assertEqual(reply or "", line.read(len(reply or "")).decode(), shown)
            monitor.step(0, after=line)
            self.test.assertEqual(b"", line.unread(), shown)
        line.close()

    def screen(self, text):
        """The output of telnet: its own lines, then it echoes each line that is typed, and a reply is at the beginning of
        the next line."""
        self.test.assertEqual(self.shown_by_telnet.rstrip(), text.rstrip())

    def term(self, text, xr3, monitor):
        """A fence without the first line of `xr3 term` goes on in a terminal that is open."""
        self.lines_opened += 1
        text = text.removeprefix("$ xr3 term\n")
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
            xr3.wait_log(".*".join(map(re.escape, DIFFERS.sub("...", line).split("..."))))

    def follow(self, text, xr3):
        """Does what the fences of a page say, with this server. The test of the page compares parts of files, and
        knows what fences without a language are."""
        self.lines_opened = 0
        for kind, shown in FENCE.findall(text):
            if kind in self.others:
                continue
            self.test.assertIn(kind, KINDS)
            if kind in ("telnet", "term"):
                with xr3.monitor() as monitor:
                    getattr(self, kind)(shown, xr3, monitor)
            elif kind in ("python", "json", "screen"):
                getattr(self, kind)(shown)
            else:
                getattr(self, kind)(shown, xr3)


def clock_for(text):
    """The manual clock for a page on which a user types, else a fast one."""
    return "manual" if re.search(r"^```(telnet|term)$", text, re.MULTILINE) else "real:50"


def play(reader, text):
    """Follows a page that starts servers: each section has a new one, with the options of the last `./run`."""
    options = ""
    for section in re.split(r"^(?=## )", text, flags=re.MULTILINE):
        options = next((found[1] or "" for found in RUN.finditer(section)), options)
        with reader.test.subTest(section=section.splitlines()[0]), \
                Server(*shlex.split(options), clock=clock_for(section),
                       command=["env", "-C", reader.folder, XR3, "serve"]) as xr3:
            reader.follow(section, xr3)


def check_figures(test, page, folder):
    """Draws the figures of a page again, as its comments say, and returns their names. `folder` is for the pictures."""
    text = page.read_text(encoding="utf-8")
    shown, drawn = dict(map(reversed, PICTURE.findall(text))), set()
    for command in "\n".join(map(str.strip, FIGURES.findall(text))).splitlines():
        _, what, *options, name = shlex.split(command)
        with test.subTest(page=page.name, figure=name):
            test.assertIn(name, shown, "no picture of the page")
            done = run_xr3(what, *options, folder / name, cwd=ROOT)
            test.assertEqual(0, done.returncode, done.stderr)
            test.assertEqual((folder / name).read_text(encoding="utf-8"),
                             (page.parent / shown[name] / name).read_text(encoding="utf-8"),
                             f"draw it again, to {page.parent.name}/{shown[name]}: {command.strip()}")
        drawn.add(name)
    return drawn
