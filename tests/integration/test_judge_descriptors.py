"""A program under test holds no descriptor of the judge: its standard streams are pipes, as root and as an ordinary user, with
and without the sandbox."""

import unittest

from judge_modes import PYTHON, SANDBOX, Root, User
from support import XR3
from terminal import Terminal

STREAMS = """
import os
print(*[os.readlink(f"/proc/self/fd/{stream}").split(":")[0] for stream in sorted(os.listdir("/proc/self/fd"), key=int)[:-1]])
"""
# Looks for a file or a terminal among its descriptors.
REWRITE = """
import os
for stream in 0, 1, 2:
    try:
        os.ftruncate(stream, 0)
        os.pwrite(stream, b"10 of 10", 0)
    except OSError:
        pass
"""
TYPED = """
import os, select
for stream in 0, 1, 2:
    print(stream, os.isatty(stream))
try:
    os.open("/dev/tty", os.O_RDWR)
    print("tty opened")
except OSError:
    print("no tty")
print("red \\x1b[31m title \\x1b]0;mine\\x07 c1 \\x9b2J end")
"""


class Promises:
    options = []

    def test_the_streams_are_pipes_and_there_are_no_others(self):
        for more in [], ["--quiet", "--out", "out"]:
            done = self.judge(STREAMS, *self.options, *more)
            printed = (self.folder / "out/output.txt").read_text(encoding="utf-8") if more else done.stdout
            self.assertEqual("pipe pipe pipe", printed.splitlines()[0])

    def test_a_program_rewrites_nothing_of_a_file_that_the_judge_appends_to(self):
        grades = self.write("grades.txt", "ada 3 of 10\n")
        for stream in "stdout", "stderr":
            with open(grades, "a", encoding="utf-8") as file:
                self.judge(REWRITE, *self.options, capture_output=False, **{stream: file})
            self.assertEqual("ada 3 of 10\n", grades.read_text(encoding="utf-8")[:12])

    def test_standard_error_stays_apart(self):
        done = self.judge("import sys\nprint('good')\nprint('bad', file=sys.stderr)\n", *self.options)
        self.assertEqual(("good", "bad\n"), (done.stdout.splitlines()[0], done.stderr))

    def test_the_judge_hands_its_input_on(self):
        text = "x" * 300_000
        done = self.judge("import sys\nprint(len(sys.stdin.read()))\n", *self.options, "--stdin", input=text)
        self.assertEqual("300000", done.stdout.splitlines()[0])
        file = self.write("input.txt", text)
        with open(file, encoding="utf-8") as its:
            done = self.judge("import sys\nprint(len(sys.stdin.read()))\n", *self.options, "--stdin", stdin=its)
        self.assertEqual("300000", done.stdout.splitlines()[0])
        self.judge("print('reads nothing')\n", *self.options, "--stdin", input=text)

    def test_a_terminal_is_out_of_reach_and_gets_no_control_characters(self):
        program = self.write("program.py", TYPED)
        with Terminal([*self.before, XR3, "exec", *self.options, "--", PYTHON, program], columns=120) as terminal:
            terminal.wait_text("score")
            self.assertEqual(0, terminal.wait_end())
        self.assertIn("0 False\n1 False\n2 False\nno tty\n", terminal.text())
        self.assertRegex(terminal.text(), r"red \\x1b\[31m title \\x1b\]0;mine\\x07 c1 (\\xc2)?\\x9b2J end")
        self.assertNotIn(b"\x1b", terminal.bytes)

    def test_what_was_printed_before_a_limit_is_shown(self):
        done = self.judge("import time\nprint('so far')\ntime.sleep(1000)\n", *self.options, "--max-seconds", "2", code=7)
        self.assertEqual("so far", done.stdout.splitlines()[0])


class AsRoot(Promises, Root, unittest.TestCase):
    pass


class AsUser(Promises, User, unittest.TestCase):
    pass


@SANDBOX
class AsRootInTheSandbox(AsRoot):
    options = ["--sandbox"]


@SANDBOX
class AsUserInTheSandbox(AsUser):
    options = ["--sandbox"]


if __name__ == "__main__":
    unittest.main()
