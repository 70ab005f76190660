"""GNU Octave with its package instrument-control: an example of clients/octave over TCP, and its two interfaces for
serial ports on the pseudo-terminal of `--pty`."""

import os
import pathlib
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, LOCALHOST, ROOT, Server
from telnet import needs

SERIALPORT = """
pkg load instrument-control
port = serialport('{path}', {speed});
port.Timeout = {seconds};
write(port, uint8("E+{counts}\\rE?"));
printf('%d to go\\n', double(read(port, 1)) - 32);
clear port
"""
SERIAL = """
pkg load instrument-control
port = serial('{path}', {speed});
srl_timeout(port, {seconds} * 10);
srl_write(port, "E+{counts}\\rE?");
printf('%d to go\\n', double(srl_read(port, 1)) - 32);
srl_close(port);
"""


def octave(*arguments, **options):
    """Runs octave-cli, without settings and history of the user, until it exits; returns its result."""
    return subprocess.run(["octave-cli", "--norc", "--no-history", *map(str, arguments)], capture_output=True,
                          text=True, timeout=3 * DEADLINE_S, check=False, **options)


@needs("octave-cli", "octave")
class Octave(unittest.TestCase):
    def setUp(self):
        if octave("--eval", "pkg load instrument-control").returncode:
            self.skipTest("Octave has no package instrument-control (Debian package octave-instrument-control)")
        folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.addCleanup(folder.cleanup)
        self.path = str(pathlib.Path(folder.name, "rhino"))

    def test_an_example_over_tcp(self):
        with Server() as xr3, xr3.line() as line:
            line.send("E+50\r")
            line.ask("E?")
            done = octave("ex1_hello.m", LOCALHOST, xr3.robot_port, cwd=os.path.join(ROOT, "clients", "octave"))
            self.assertEqual(0, done.returncode, done.stderr)
            self.assertIn("E? is answered by 82: 50 counts to go\n", done.stdout)

    def test_serial_ports(self):
        """Each program opens the port after another one has closed it."""
        with Server("--pty", self.path) as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            total = 0
            for program, speed, counts in (SERIALPORT, 9600, 13), (SERIAL, 1200, 29), (SERIALPORT, 19200, 18):
                total += counts
                done = octave("--eval", program.format(path=self.path, speed=speed, counts=counts, seconds=DEADLINE_S))
                self.assertEqual((f"{total} to go\n", "", 0), (done.stdout, done.stderr, done.returncode))
                closed = monitor.read_until(lambda message: message.get("event") == "line_close")[-1]
                self.assertEqual((7, 1), (closed["bytes_in"], closed["bytes_out"]))


if __name__ == "__main__":
    unittest.main()
