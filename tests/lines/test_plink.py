"""plink -telnet, of PuTTY: it offers its window size, its type and its speed, which the server refuses, and it
sends keys without Enter, because the server accepts SUPPRESS-GO-AHEAD."""

import re
import unittest

from support import LOCALHOST, Server, counts
from telnet import TerminalClient, needs


class Plink(TerminalClient):
    def __init__(self, port):
        super().__init__("plink", "-telnet", "-P", str(port), LOCALHOST)


@needs("plink", "putty-tools")
class PlinkSession(unittest.TestCase):
    def test_keys_leave_without_enter(self):
        with Server() as xr3, xr3.monitor() as monitor, Plink(xr3.robot_port) as plink:
            plink.type(b"E+50 E?")
            plink.read_until(rb"R")
            monitor.step(200)
            plink.type(b"?")
            plink.read_until(rb"<")
            self.assertEqual("E50", counts(monitor.settle()))
            self.assertEqual("telnet", monitor.call("lines")["lines"][0]["kind"])
        self.assertNotIn("unknown_byte", xr3.log())

    def test_its_options_are_answered_once(self):
        with Server() as xr3, xr3.monitor() as monitor, Plink(xr3.robot_port) as plink:
            plink.type(b"E?")
            plink.read_until(rb" ")
            records = monitor.recall("line", since=0)
            sent, answered = (bytes.fromhex("".join(record["hex"] for record in records if record["dir"] == way))
                              for way in ("in", "out"))
            self.assertIn(b"\xff\xfb\x1f", sent, "it offers its window size (NAWS)")
            self.assertIn(b"\xff\xfe\x1f", answered, "which is refused")
            self.assertIn(b"\xff\xfb\x03", answered, "SUPPRESS-GO-AHEAD is accepted")
            self.assertIn(b"\xff\xfc\x01", answered, "ECHO is refused")
            answers = re.findall(rb"\xff[\xfb-\xfe].", answered, re.DOTALL)
            self.assertEqual(sorted(set(answers)), sorted(answers), "nothing is said twice")


if __name__ == "__main__":
    unittest.main()
