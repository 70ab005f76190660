"""PyVISA with PyVISA-py, the free VISA: the program of docs/connect/labview-visa.md over TCP and on the pseudo-terminal
of `--pty`, and what happens to a program that waits for a line."""

import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from support import DEADLINE_S, ROOT, Server

PAGE = pathlib.Path(ROOT, "docs", "connect", "labview-visa.md")
RESOURCE = "TCPIP0::localhost::9600::SOCKET"


def run(program):
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=DEADLINE_S,
                          check=False)
    return done.stdout, done.stderr, done.returncode


@unittest.skipUnless(importlib.util.find_spec("pyvisa") and importlib.util.find_spec("pyvisa_py"),
                     "PyVISA-py is not installed (Debian package python3-pyvisa-py)")
class Visa(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.addCleanup(folder.cleanup)
        self.pty = str(pathlib.Path(folder.name, "rhino"))
        self.program, = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)

    def test_the_program_of_the_page(self):
        for resource in RESOURCE, f"ASRL{self.pty}::INSTR":
            with self.subTest(resource), Server("--pty", self.pty) as xr3:
                resource = resource.replace("9600", str(xr3.robot_port))
                self.assertEqual(("50 counts to go\n", 0), run(self.program.replace(RESOURCE, resource))[::2])
                xr3.wait_log("line 1 closed by its client; 7 bytes in, 1 out")

    def test_a_query_waits_for_a_line(self):
        with Server() as xr3:
            start = self.program.split("robot.read_termination")[0].replace("9600", str(xr3.robot_port))
            _, errors, code = run(start + 'robot.query("E?")')
        self.assertIn("VI_ERROR_TMO", errors)
        self.assertEqual(1, code)


if __name__ == "__main__":
    unittest.main()
