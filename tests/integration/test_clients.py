"""Common programs: inetutils telnet in a terminal, and netcat. The bytes that they add must not reach the
robot, and they must receive the replies of the robot."""

import subprocess
import unittest

from support import DEADLINE_S, LOCALHOST, Server, counts, motors
from telnet import Telnet, needs


@needs("telnet", "inetutils-telnet")
class TelnetSession(unittest.TestCase):
    def test_typed_lines(self):
        with Server() as xr3, xr3.monitor() as monitor, Telnet(xr3.robot_port) as telnet:
            telnet.type(b"E+50\n")
            monitor.step(200, after=(1, 6))
            self.assertEqual(b"<", telnet.inquire(b"E?"))
            self.assertEqual("E50", counts(monitor.settle()))
            self.assertEqual(b" ", telnet.inquire(b"e?"))
            self.assertEqual(b" ", telnet.inquire(b"I"))

    def test_interrupt_within_a_command(self):
        """After Ctrl-C telnet discards what it reads until the server answers its timing mark."""
        with Server() as xr3, xr3.monitor() as monitor, Telnet(xr3.robot_port) as telnet:
            telnet.type(b"E+50\n")
            monitor.step(100, after=(1, 6))
            telnet.type(b"\x03")
            self.assertEqual(b"G", telnet.inquire(b"E?"), "39 to go")
            telnet.type(b"EX\n")
            self.assertEqual(b" ", telnet.inquire(b"E?"))
            self.assertEqual("E11", counts(monitor.settle()))
        self.assertNotIn("unknown_byte", xr3.log())

    def test_repeated_interrupts(self):
        with Server() as xr3, Telnet(xr3.robot_port) as telnet:
            telnet.inquire(b"E?")
            for _ in range(5):
                telnet.type(b"\x03")
                self.assertEqual(b" ", telnet.inquire(b"E?"))

    def test_a_reply_of_ff_arrives_once(self):
        """After an interrupt the server knows that the line uses telnet and doubles FF on the wire."""
        with Server() as xr3, xr3.monitor() as monitor, Telnet(xr3.robot_port) as telnet:
            telnet.inquire(b"E?")  # telnet is ready: before, Ctrl-C could end it
            telnet.type(b"\x03")
            telnet.type(b"F-1\n")
            monitor.step(0, after=(1, 4 + 5 + 5))
            telnet.type(b"FT\n")
            self.assertEqual(b"\xff", telnet.read_until(rb"FT\r\n(.)").group(1))
            self.assertEqual(b"!", telnet.inquire(b"F?"))

    def test_character_mode(self):
        """`mode character` negotiates SUPPRESS-GO-AHEAD and ECHO: keys then leave without Enter."""
        with Server() as xr3, xr3.monitor() as monitor, Telnet(xr3.robot_port) as telnet:
            self.assertEqual(b" ", telnet.inquire(b"E?"))
            telnet.type(b"\x1d")
            telnet.read_until(rb"telnet> ")
            telnet.type(b"mode character\n")
            telnet.read_until(rb"character\r\n")
            telnet.type(b"E+50 E?")
            telnet.read_until(rb"R")
            monitor.step(200)
            telnet.type(b"?")
            telnet.read_until(rb"<")
            self.assertEqual("telnet", monitor.call("lines")["lines"][0]["kind"])
        self.assertNotIn("unknown_byte", xr3.log())

    def test_two_sessions_at_once(self):
        """Two users share the robot; a reply goes only to the line of the inquiry."""
        with Server() as xr3, xr3.monitor() as monitor, Telnet(xr3.robot_port) as first:
            monitor.step(0)
            with Telnet(xr3.robot_port) as second:
                first.type(b"E+5\n")
                monitor.step(0, after=(1, 5))
                self.assertEqual(b"%", second.inquire(b"E?"))
                second.type(b"D-7\n")
                monitor.step(0, after=(2, 4 + 5))
                self.assertEqual(b"'", first.inquire(b"D?"))
                self.assertEqual(b"'", second.inquire(b"D?"))
                self.assertEqual(b"%", first.inquire(b"E?"))
                state = monitor.settle()
                self.assertEqual("E5 D-7", counts(state))


@needs("nc", "netcat-openbsd")
class Netcat(unittest.TestCase):
    def netcat(self, xr3, data):
        done = subprocess.run(["nc", "-N", "localhost", str(xr3.robot_port)], input=data,
                              capture_output=True, timeout=DEADLINE_S, check=False)
        self.assertEqual((0, b""), (done.returncode, done.stderr))
        return done.stdout

    def test_half_close(self):
        """netcat sends, closes its side for writing, and still receives the reply."""
        with Server() as xr3:
            self.assertEqual(b"%", self.netcat(xr3, b"E+5\rE?"))

    def test_many_replies(self):
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertEqual(b"\x20" * 2000, self.netcat(xr3, b"E?" * 2000))
            self.assertEqual(b"", self.netcat(xr3, b"E+5\r"))
            self.assertEqual(b"", self.netcat(xr3, b"D+7"), "a number that is still open is dropped")
            state = monitor.settle()
            self.assertEqual((5, 0), tuple(motors(state)[label]["count"] for label in "ED"))


if __name__ == "__main__":
    unittest.main()
