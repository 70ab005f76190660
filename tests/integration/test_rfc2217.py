"""RFC 2217 over real sockets: pyserial's rfc2217:// sets up a serial port and drives the robot, and a client by
hand suspends its replies."""

import contextlib
import pathlib
import re
import subprocess
import sys
import unittest

from support import DEADLINE_S, LOCALHOST, ROOT, Server, counts, motors

try:
    import serial
except ImportError:
    serial = None

COM_PORT = b"\xff\xfb\x2c"
ACCEPTED = b"\xff\xfd\x2c\xff\xfa\x2c\x6b\xb0\xff\xf0"
SUSPEND, RESUME = b"\xff\xfa\x2c\x08\xff\xf0", b"\xff\xfa\x2c\x09\xff\xf0"
MODEM_STATE, STATE = b"\xff\xfa\x2c\x07\xff\xf0", b"\xff\xfa\x2c\x6b\xb0\xff\xf0"
HELD = 64 * 1024


def settings_of(monitor):
    """The kind and the settings of the only line."""
    line, = monitor.call("lines")["lines"]
    return line["kind"], line.get("serial")


@contextlib.contextmanager
def pyserial(xr3, **settings):
    port = serial.serial_for_url(f"rfc2217://{LOCALHOST}:{xr3.robot_port}?timeout={DEADLINE_S}", do_not_open=True,
                                 timeout=DEADLINE_S, **settings)
    port.open()
    try:
        yield port
    finally:
        port.close()


@unittest.skipUnless(serial, "pyserial is not installed (Debian package python3-serial)")
class Pyserial(unittest.TestCase):
    SETTINGS = {
        "9600-7e2": {"baudrate": 9600, "bytesize": 7, "parity": "E", "stopbits": 2},
        "300-5n1.5-xonxoff": {"baudrate": 300, "bytesize": 5, "stopbits": 1.5, "xonxoff": True},
        "250000-8m1": {"baudrate": 250000, "parity": "M"},
    }

    def test_ports_with_different_settings(self):
        for text, settings in self.SETTINGS.items():
            with self.subTest(text), Server() as xr3, xr3.monitor() as monitor, pyserial(xr3, **settings) as port:
                port.write(b"E+50\rE?")
                self.assertEqual(b"R", port.read(1))
                self.assertEqual(("rfc2217", text), settings_of(monitor))

    def test_settings_change_while_the_port_is_open(self):
        with Server() as xr3, xr3.monitor() as monitor, pyserial(xr3) as port:
            self.assertEqual(("rfc2217", "9600-8n1"), settings_of(monitor))
            port.baudrate, port.bytesize, port.parity, port.stopbits = 19200, 7, serial.PARITY_EVEN, 2
            self.assertEqual(("rfc2217", "19200-7e2"), settings_of(monitor))
            port.rtscts = True
            self.assertEqual(("rfc2217", "19200-7e2-rtscts"), settings_of(monitor))

    def test_signals_of_the_port(self):
        for options in {}, {"poll_modem": None}:
            with self.subTest(options), Server() as xr3:
                query = "".join(f"&{name}" for name in options)
                with serial.serial_for_url(f"rfc2217://{LOCALHOST}:{xr3.robot_port}?timeout={DEADLINE_S}{query}",
                                           timeout=DEADLINE_S) as port:
                    self.assertEqual((True, True, False, True), (port.cts, port.dsr, port.ri, port.cd))
                    for value in False, True:
                        port.rts = port.dtr = value
                        port.break_condition = not value
                    port.send_break(0)
                    port.write(b"E?")
                    self.assertEqual(b" ", port.read(1))

    def test_purges(self):
        with Server() as xr3, pyserial(xr3) as port:
            port.write(b"E+5\rE?E?E?")
            port.baudrate = 19200  # waits for the answer, which comes after the replies
            self.assertEqual(3, port.in_waiting)
            port.reset_input_buffer()
            port.reset_output_buffer()
            self.assertEqual(0, port.in_waiting)
            port.write(b"E?")
            self.assertEqual(b"%", port.read(1), "the command before the purge has acted")

    def test_every_byte_value_arrives(self):
        with Server() as xr3, pyserial(xr3) as port:
            port.write(b"F-1\rFT")
            self.assertEqual(b"\xff", port.read(1))
            port.write(b"\xff\xff\xffF?")
            self.assertEqual(b"!", port.read(1))
        self.assertIn("unknown_byte", xr3.log())

    def test_a_program_drives_the_robot(self):
        with Server() as xr3, xr3.monitor() as monitor, pyserial(xr3, bytesize=7, parity="E", stopbits=2) as port:
            for counts_to_go in 100, -30:
                port.write(b"E%+d\rD%+d\r" % (counts_to_go, -counts_to_go))
                port.write(b"E?")
                self.assertEqual(32 + abs(counts_to_go), port.read(1)[0])
                monitor.call("run_until", idle=True, max_ticks=60000)
                port.write(b"E?D?")
                self.assertEqual(b"  ", port.read(2))
            self.assertEqual("E70 D-70", counts(monitor.get()))

    def test_the_example_of_the_documentation(self):
        page = pathlib.Path(ROOT, "docs", "serial-lines.md").read_text(encoding="utf-8")
        example, = re.findall(r"^```python\n([^`]*rfc2217:[^`]*)^```", page, re.MULTILINE)
        with Server() as xr3:
            example = example.replace("localhost:9600", f"{LOCALHOST}:{xr3.robot_port}")
            done = subprocess.run([sys.executable, "-c", example], capture_output=True, text=True,
                                  timeout=DEADLINE_S, check=False)
        self.assertEqual((0, "50 counts to go\n", ""), (done.returncode, done.stdout, done.stderr))

    def test_a_plain_line_beside_it(self):
        with Server() as xr3, xr3.line() as line, pyserial(xr3) as port:
            port.write(b"F-1\rFT")
            self.assertEqual(b"\xff", port.read(1))
            line.send("FT")
            self.assertEqual(b"\xff", line.read(1))
            self.assertEqual(33, line.ask("F?"))
            self.assertEqual(b"", line.unread(), "a plain line receives no byte of telnet")


class Opened(unittest.TestCase):
    """A line whose client has negotiated COM-PORT by hand."""

    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())
        self.line = self.enterContext(self.xr3.line(buffer_bytes=16384))
        self.line.send(b"\r" + COM_PORT)
        self.assertEqual(ACCEPTED, self.line.read(len(ACCEPTED)))

    def enterContext(self, manager):  # pylint: disable=invalid-name  # unittest has it since Python 3.11
        entered = manager.__enter__()
        self.addCleanup(manager.__exit__, None, None, None)
        return entered

    def ask_state(self):
        self.line.send(MODEM_STATE)
        self.assertEqual(STATE, self.line.read(len(STATE)))


class Suspended(Opened):
    def setUp(self):
        super().setUp()
        self.line.send(SUSPEND)

    def test_replies_wait_for_the_resume(self):
        self.line.send(b"E+5\rE?F-1\rFT")
        self.ask_state()
        self.assertEqual(b"", self.line.unread())
        self.line.send(RESUME)
        self.assertEqual(b"%\xff\xff", self.line.read(3))
        records = [record for record in self.monitor.recall("line", since=0) if record["dir"] == "out"]
        self.assertEqual("25ffff", records[-1]["hex"])
        self.assertEqual(["reply_error", "reply_signed_error"], [item["code"] for item in records[-1]["parsed"]])

    def test_they_leave_at_shutdown(self):
        self.line.send(b"E+5\rE?")
        self.ask_state()
        replies = []
        self.assertEqual(0, self.xr3.stop(meanwhile=lambda: replies.append(self.line.read_to_end())))
        self.assertEqual([b"%"], replies)


class TooManySuspended(Opened):
    """64 KiB of replies are held: commands of telnet are read, but no byte for the robot."""

    def setUp(self):
        super().setUp()
        self.line.send(SUSPEND + b"I" * HELD)
        self.monitor.step(0, after=self.line)

    def test_commands_of_telnet_are_read(self):
        self.ask_state()
        self.line.send(RESUME + b"E?")
        self.assertEqual(b" " * (HELD + 1), self.line.read(HELD + 1))

    def test_a_byte_for_the_robot_waits(self):
        self.line.send(b"E+5\r" + MODEM_STATE)
        self.assertEqual(32, self.xr3.line().ask("E?"), "the server serves others")
        self.assertEqual(b"", self.line.unread())
        self.assertEqual(0, motors(self.monitor.get())["E"]["error"])

    def test_the_end_of_the_client_resumes_them(self):
        self.line.send(b"E+5\rE?" + SUSPEND + b"E?")
        self.line.finish_sending()
        self.assertEqual(b" " * HELD + b"%%", self.line.read_to_end())
        self.xr3.wait_log(r"line 1 .*closed by its client")

    def test_a_client_that_is_gone_leaves_no_line(self):
        self.line.send(b"E?")
        self.line.close()
        self.xr3.wait_log(r"line 1 .*(closed|lost)")
        self.assertEqual([], self.monitor.call("lines")["lines"])

    def test_the_monitor_disconnects_it(self):
        self.line.send(b"E?")
        self.monitor.call("line_disconnect", line=1)
        self.xr3.wait_log(r"line 1 closed by the monitor")


if __name__ == "__main__":
    unittest.main()
