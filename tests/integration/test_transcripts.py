"""Plays every transcript of tests/transcripts over TCP; tests/transcripts/README.md describes the format."""

import contextlib
import pathlib
import re
import unittest

from support import ROOT, MonitorError, Server

ESCAPE = re.compile(rb"\\(?:x([0-9a-f]{2})|(.))")
PLAIN = {b"r": b"\r", b"n": b"\n", b"0": b"\0", b"\\": b"\\"}


def unescaped(text):
    def one(match):
        return bytes([int(match[1], 16)]) if match[1] else PLAIN[match[2]]
    return ESCAPE.sub(one, text.encode("ascii"))


class Player:
    """Plays one transcript on one server. Lines have the digits of the transcript and are opened at their
    first use."""

    def __init__(self, xr3, monitor, case):
        self.xr3, self.monitor, self.case = xr3, monitor, case
        self.lines = {}

    def line(self, digit):
        if digit not in self.lines:
            self.lines[digit] = self.xr3.line()
        return self.lines[digit]

    def play(self, digit, sign, rest):
        if sign == "~":
            amount, unit = re.fullmatch(r"(\d+)(ms|s)", rest).groups()
            self.monitor.step(int(amount) * (1000 if unit == "s" else 1), fields=[])
            return
        line = self.line(digit)
        if sign == ">":
            line.send(unescaped(rest))
            self.let_act(line)
        elif sign == "<":
            self.case.assertEqual(unescaped(rest), line.read(len(unescaped(rest))))
            self.case.assertEqual(b"", line.unread())
        elif rest == "closed":
            self.case.assertEqual(b"", line.read_to_end())
        else:
            self.hang_up(digit)

    def let_act(self, line):
        try:
            self.monitor.step(0, after=line, fields=[])
        except MonitorError as error:
            self.case.assertEqual("no_such_line", error.code)  # closed because it sent HTTP or TLS

    def hang_up(self, digit):
        line = self.lines.pop(digit)
        self.case.assertEqual(b"", line.unread())
        line.finish_sending()
        line.read_to_end()
        line.close()

    def finish(self):
        for line in self.lines.values():
            self.case.assertIn(line.unread(), (b"", None))
            line.close()


def steps_of(path):
    """(line number, digit, sign, rest) of each line that is not empty or a comment."""
    for number, text in enumerate(path.read_text(encoding="ascii").splitlines(), 1):
        match = re.fullmatch(r"(\d?)([@><~!])(?: (.*))?", text)
        if match:
            yield number, match[1] or "1", match[2], match[3] or ""


def options_of(path):
    for _, _, sign, rest in steps_of(path):
        if sign == "@":
            name, value = rest.split()
            yield from (f"--{name}", value)


class Transcripts(unittest.TestCase):
    CHANNELS = ("state", "image", "display", "model", "event", "line")

    def play(self, path, viewers=0):
        with Server(*options_of(path)) as xr3, xr3.monitor() as monitor, contextlib.ExitStack() as stack:
            for number in range(viewers):
                viewer = stack.enter_context(xr3.monitor())
                for channel in self.CHANNELS[number % 3::3]:
                    viewer.subscribe(channel, max_hz=60)
            player = Player(xr3, monitor, self)
            for number, digit, sign, rest in steps_of(path):
                if sign == "@":
                    continue
                try:
                    player.play(digit, sign, rest)
                except (AssertionError, EOFError, OSError) as error:
                    raise AssertionError(f"{path.name}:{number}: {error}") from error
            player.finish()

    def test_every_file(self):
        files = sorted(pathlib.Path(ROOT, "tests", "transcripts").glob("*.txt"))
        self.assertGreater(len(files), 20)
        for path in files:
            with self.subTest(path.stem):
                self.play(path)

    def test_every_file_with_viewers(self):
        """Subscribers of all channels do not change the replies."""
        for path in sorted(pathlib.Path(ROOT, "tests", "transcripts").glob("*.txt")):
            with self.subTest(path.stem):
                self.play(path, viewers=12)


if __name__ == "__main__":
    unittest.main()
