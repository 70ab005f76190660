"""socat, on both sides: it makes a serial port of the robot port, and it passes the server's pseudo-terminal on."""

import contextlib
import os
import pathlib
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, LOCALHOST, Line, Server, connect
from telnet import needs
from test_pty import Port

INQUIRY, REPLY = b"E+90\rE?", b"z"


@contextlib.contextmanager
def socat(*arguments, **options):
    """A running socat that reports on standard error what it has opened; the end of the block ends it."""
    with subprocess.Popen(["socat", "-d", "-d", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, **options) as process:
        try:
            yield process
        finally:
            process.kill()


def wait_for(process, text):
    """Reads what socat reports up to a line with the text; returns that line."""
    for line in process.stderr:
        if text in line:
            return line
    raise AssertionError(f"socat has ended without {text!r}")


@needs("socat", "socat")
class Socat(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = str(self.folder / "rhino")

    def test_a_serial_port_for_a_program_of_another_machine(self):
        """The two addresses of docs/serial-lines.md."""
        with Server() as xr3, xr3.monitor() as monitor, \
                socat("PTY,link=robot,raw,echo=0", f"TCP:{LOCALHOST}:{xr3.robot_port}", cwd=self.folder) as process:
            wait_for(process, b"starting data transfer loop")
            with Port(self.folder / "robot") as port:
                port.write(INQUIRY)
                self.assertEqual(REPLY, port.read(1))
            line, = monitor.call("lines")["lines"]
            self.assertEqual("tcp", line["kind"])

    def test_the_link_ends_with_the_server(self):
        with Server() as xr3, socat("PTY,link=robot,raw,echo=0", f"TCP:{LOCALHOST}:{xr3.robot_port}",
                                    cwd=self.folder) as process:
            wait_for(process, b"starting data transfer loop")
            xr3.stop()
            self.assertEqual(0, process.wait(DEADLINE_S))
            self.assertFalse(os.path.lexists(self.folder / "robot"))

    def test_without_raw_the_replies_come_back(self):
        """A fresh pseudo-terminal echoes: the reply comes back as a byte for the robot."""
        with Server() as xr3, socat("PTY,link=robot", f"TCP:{LOCALHOST}:{xr3.robot_port}", cwd=self.folder) as process:
            wait_for(process, b"starting data transfer loop")
            with Port(self.folder / "robot") as port:
                port.write(INQUIRY)
                xr3.wait_log("unknown_byte: z:")

    def test_a_pipe_to_the_pseudo_terminal(self):
        with Server("--pty", self.path):
            for _ in range(2):
                with socat("STDIO", f"{self.path},b9600,raw,echo=0") as process:
                    process.stdin.write(b"F+1\rF-1\rE?")
                    process.stdin.flush()
                    self.assertEqual(b" ", process.stdout.read(1))

    def test_the_pseudo_terminal_over_tcp(self):
        """Each connection opens the port, and closes it at its end."""
        with Server("--pty", self.path) as xr3, \
                socat(f"TCP-LISTEN:0,bind={LOCALHOST},fork", f"{self.path},raw,echo=0") as process:
            port = int(wait_for(process, b"listening on").rpartition(b":")[2])
            for number in 1, 2:
                with Line(connect(port)) as line:
                    line.send(b"A$" + INQUIRY)
                    self.assertEqual(REPLY, line.read(1))
                xr3.wait_log(rf"line {number} closed by its client")


if __name__ == "__main__":
    unittest.main()
