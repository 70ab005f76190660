"""The messages of the program that the documentation quotes: each is caused here and compared. Messages that need
a rare failure are compared with the text in the sources; other tests cause them."""
# labels: full

import pathlib
import re
import tempfile
import unittest
import urllib.error
import urllib.request

import pages
from support import LOCALHOST, ROOT, Server, run_xr3

QUOTED = re.compile(r"(?:lab|my-arm)\.\w+:\d+:.+|XR3_\w+: .+|xr3: .+|.*: found .+; allowed: .+")
BLOCK = '    {"name": "red", "size": [64, 32, 40], "centroid": [262, 0, 20], "yaw_deg": 90, "color": 12}\n'
WORKCELL = ('{\n  "name": "one block", "notes": "", "length_unit": "mm",\n'
            '  "workspace": {"x": 600, "y": 500, "z": 700},\n'
            f'  "blocks": [\n{BLOCK}  ],\n'
            '  "camera": {"location": [290, 0, 1000], "field": [384, 384], "pixels": [64, 192]} }\n')
PLAIN = ("* workcell\n600 500 700\n* blocks\n1\n* block\n64 -32 40 262 0 20 90\n* camera: location, field, pixels\n"
         "290 0 1000\n384\n192 192\n")
CONFIG = '# lab.toml\nrobot = "adept-one"\nworkcell = "adept-one"\nrobot-port = 99999\n'
# Fragments of the log and of replies in tables, and the pages that quote them. The sources have {} for a number.
IN_THE_SOURCES = {
    "docs/operations.md": ["lines are refused", "the limit of ... open files allows only",
                           "suppressed N messages", "the server needs more memory than --max-memory",
                           "the recording has ended, and the robot goes on"],
    "docs/monitor.md": ["the server is starting or stopping", "the serial lines are not watched"],
}


def many_unknown_members():
    """A workcell with 412 unknown members, one per line from line 21 on."""
    head = WORKCELL.rstrip(" }\n") + "}"
    lines = head.splitlines()
    return "\n".join([*lines, *[""] * (20 - len(lines)), *(f', "more {i}": 1' for i in range(412)), "}"])


def quotes():
    """(place, text) of every quoted message."""
    lines = [(path, number, line.strip()) for path, number, line in pages.fenced_lines()
             if not pages.has_a_reader(path)]
    lines += [(path, number, code) for path, number, _, code in pages.spans()]
    for path, number, text in lines:
        if QUOTED.fullmatch(text):
            yield pages.place(path, number), text


def words_of_sources():
    """The C++ sources of the server and of the texts of events, with adjacent literals joined, and {} for a number between them."""
    files = [path for folder in ("server", "cli", "protocol/explain") for path in sorted(pathlib.Path(ROOT, folder).rglob("*.cpp"))]
    text = "\n".join(re.sub(r'"\s*\n\s*"', "", path.read_text(encoding="utf-8")) for path in files)
    return re.sub(r'" \+\s*std::to_string\([^"]*\) \+\s*"', "{}", text)


class QuotedMessages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refused(self, name, text, *arguments, **environment):
        """The lines that xr3 prints about an invalid file or option; the exit code is 2."""
        (self.folder / name).write_text(text, encoding="utf-8")
        done = run_xr3(*arguments, cwd=self.folder, **({"env": environment} if environment else {}))
        self.assertEqual(2, done.returncode, done.stdout)
        return [re.sub(r"^xr3: |; xr3 serve --help lists the arguments$", "", line)
                for line in (done.stdout + done.stderr).splitlines()]

    def test_findings_and_options(self):
        wrong = WORKCELL.replace('"size": [64', '"size": [-5').replace('"color"', '"colour"').replace("[64,", '["64",')
        printed = [
            *self.refused("lab.json", wrong, "check", "lab.json"),
            *self.refused("lab.json", WORKCELL.replace("700}", "700]"), "check", "lab.json"),
            *self.refused("lab.json", many_unknown_members(), "check", "lab.json"),
            *self.refused("lab.txt", PLAIN, "check", "lab.txt"),
            *self.refused("lab.toml", CONFIG, "serve", "--config", "lab.toml"),
            *self.refused("lab.toml", "", "serve", XR3_CLOCK="fast"),
        ]
        quoted = list(quotes())
        self.assertGreater(len(quoted), 8)
        for place, text in quoted:
            with self.subTest(place):
                self.assertIn(text, printed, "compare it with the program; if nothing here causes it, cause it")

    def test_a_dialogue_of_the_workcell_editor(self):
        """The lines come in this order; `...` is for lines that are left out, each answered by Enter."""
        page = pathlib.Path(ROOT, "docs", "workcell-editor.md").read_text(encoding="utf-8")
        shown = re.search(r"^```\n(Name \[.*?)^```", page, re.DOTALL | re.MULTILINE)[1].splitlines()
        before, after = (lines.split("\n") for lines in "\n".join(shown).split("\n...\n"))
        answers = {at: line.rsplit(":", 1)[1].strip() for at, line in enumerate([*before, *after]) if ": " in line}
        typed = [answers.get(at, "") for at, line in enumerate([*before, *after]) if not line.startswith("  !")]
        typed[len(before):len(before)] = [""] * 4
        done = run_xr3("workcell", "new.json", cwd=self.folder, input="\n".join(typed) + "\n")
        printed = [line.rstrip() for line in done.stdout.splitlines()]
        for part in before, after:
            at = printed.index(part[0])
            self.assertEqual(part, printed[at:at + len(part)])

    def test_reason_for_not_ready(self):
        quoted = re.search(r"^\| `(every line is in use: (\d+) .*?)` \|", self.page("docs/monitor.md"), re.MULTILINE)
        with Server("--max-lines", quoted[2]) as xr3, xr3.monitor() as monitor:
            lines = [xr3.line() for _ in range(int(quoted[2]))]
            monitor.step(0, after=lines[-1])
            with self.assertRaises(urllib.error.HTTPError) as raised:
                urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}/readyz")
            with raised.exception as answer:
                self.assertIn(f'"{quoted[1]}"', answer.read().decode())
            xr3.line()
            self.assertTrue(xr3.wait_log("lines are refused"))

    def test_events_of_the_screen(self):
        """Times and ports of clients differ."""
        page = self.page("docs/watch.md")
        events = re.findall(r"^ +\d+\.\d+ s  (.*)$", page, re.MULTILINE)
        self.assertEqual(3, len(events))
        with Server() as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.send(re.search(r"([A-F]\+\d+): ", events[1])[1] + "\r")
            monitor.step(0, after=line)
            line.close()
            xr3.wait_log("closed by its client")
            screen = run_xr3("watch", "--once", f"localhost:{xr3.monitor_port}").stdout
        for event in events:
            self.assertRegex(screen, re.sub(r":\d{4,5}$", r":\\d+", re.escape(event)))

    @staticmethod
    def page(name):
        return pathlib.Path(ROOT, name).read_text(encoding="utf-8")

    def test_fragments_are_in_the_sources(self):
        sources = words_of_sources()
        for name, fragments in IN_THE_SOURCES.items():
            for fragment in fragments:
                with self.subTest(fragment):
                    self.assertIn(f"`{fragment}`", self.page(name))
                    literal = re.sub(r"\.\.\.|\bN\b|\b500\b", "{}", fragment.removesuffix(" ..."))
                    self.assertTrue(literal in sources, f"no source has {literal}")

    def test_fragments_of_the_log_are_listed(self):
        """Every quotation after "the log says" or "says" in the table of symptoms is one of those above."""
        said = re.findall(r"(?:log says|before it says) `([^`]+)`", self.page("docs/operations.md"))
        self.assertEqual(set(), set(said) - set(IN_THE_SOURCES["docs/operations.md"]))


if __name__ == "__main__":
    unittest.main()
