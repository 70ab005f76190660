"""picocom and minicom, as a person starts them on the pseudo-terminal of `--pty`: two sessions one after the other."""

import os
import pathlib
import tempfile
import unittest

from support import DEADLINE_S, Server
from telnet import TerminalClient, needs

SHOWN = "line", "kind", "peer", "serial"


class SerialTerminal(TerminalClient):
    """A terminal program with its own home, so that no settings of the user take part."""

    def __init__(self, folder, *command):
        super().__init__(*command, environment={"HOME": str(folder), "TERM": "linux", "LC_ALL": "C"})

    def leave(self, keys):
        """Types these keys, which end the program; returns its exit code."""
        self.type(keys)
        try:
            while os.read(self.terminal, 4096):
                pass
        except OSError:  # no program has the terminal open
            pass
        return self.process.wait(DEADLINE_S)


class Session(unittest.TestCase):
    """The tests of every terminal program."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = str(self.folder / "rhino")

    def check_two_sessions(self, command, is_ready, leave):
        with Server("--pty", self.path) as xr3, xr3.monitor() as monitor:
            for number, speed, reply in (1, "1200", b"R"), (2, "9600", rb"\x84"):  # 50 and 100 counts to go
                with SerialTerminal(self.folder, *command, "-b", speed) as program:
                    program.read_until(is_ready)
                    program.type(b"E+50\rE?")
                    program.read_until(reply)
                    line, = monitor.call("lines")["lines"]
                    self.assertEqual((number, "pty", self.path, speed), tuple(line[name] for name in SHOWN))
                    self.assertEqual((7, 1), (line["bytes_in"], line["bytes_out"]))
                    self.assertEqual(0, program.leave(leave))
                xr3.wait_log(rf"line {number} closed by its client")
            self.assertNotIn("unknown_byte", xr3.log())
            self.assertNotIn("pty_cooked", xr3.log())


@needs("picocom", "picocom")
class Picocom(Session):
    def test_two_sessions(self):
        self.check_two_sessions(["picocom", self.path], rb"Terminal ready\r\n", b"\x01\x18")

    def test_seven_bits_even_parity_and_two_stop_bits(self):
        with Server("--pty", self.path), \
                SerialTerminal(self.folder, "picocom", self.path, "-d", "7", "-y", "e", "-p", "2") as program:
            program.read_until(rb"Terminal ready\r\n")
            program.type(b"E+50\rE?")
            program.read_until(b"R")
            self.assertEqual(0, program.leave(b"\x01\x18"))


@needs("minicom", "minicom")
class Minicom(Session):
    def test_two_sessions(self):
        self.check_two_sessions(["minicom", "-D", self.path], rb"special keys\r\n\n?", b"\x01x\r")


if __name__ == "__main__":
    unittest.main()
