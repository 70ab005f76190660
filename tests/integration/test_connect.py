"""docs/connect: the first inquiry of its pages, with pyserial on each kind of port, netcat, plink and Octave, as the
pages show it. The tests of the other programs are in tests/lines."""
# labels: full

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import DEADLINE_S, ROOT, Server

try:
    import serial
except ImportError:
    serial = None

CONNECT = pathlib.Path(ROOT, "docs", "connect")
PRINTED = "50 counts to go\n"


def program(page, language):
    """The only program in this language on a page."""
    text = (CONNECT / page).read_text(encoding="utf-8")
    found, = re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    return found


class FirstInquiry(unittest.TestCase):
    def check(self, command, **options):
        done = subprocess.run(command, capture_output=True, text=True, timeout=3 * DEADLINE_S, check=False, **options)
        self.assertEqual((PRINTED, 0), (done.stdout, done.returncode), done.stderr)

    @unittest.skipUnless(serial, "pyserial is not installed (Debian package python3-serial)")
    def test_pyserial(self):
        text = (CONNECT / "serial-ports.md").read_text(encoding="utf-8")
        names = re.findall(r"^\| `(\S+)` \|", text, re.MULTILINE)
        self.assertEqual(["rfc2217://localhost:9600", "socket://localhost:9600", "rhino"], names)
        for name in names:
            with self.subTest(name), tempfile.TemporaryDirectory(prefix="xr3-") as folder, \
                    Server("--pty", pathlib.Path(folder, "rhino")) as xr3:
                name = name.replace("9600", str(xr3.robot_port))
                self.check([sys.executable, "-c", program("serial-ports.md", "python"), name], cwd=folder)

    @unittest.skipUnless(shutil.which("octave-cli"), "octave-cli is not installed (Debian package octave)")
    def test_octave(self):
        octave = ["octave-cli", "--norc", "--no-history", "--eval"]
        if subprocess.run([*octave, "pkg load instrument-control"], capture_output=True, check=False).returncode:
            self.skipTest("Octave has no package instrument-control (Debian package octave-instrument-control)")
        with Server() as xr3:
            self.check([*octave, program("matlab-octave.md", "octave").replace("9600", str(xr3.robot_port))])

    def test_netcat_and_plink(self):
        text = (CONNECT / "by-hand.md").read_text(encoding="utf-8")
        commands = re.findall(r"^(?:\()?printf .*\| (\w+) .*$", text, re.MULTILINE)
        self.assertEqual(["nc", "plink"], commands)
        for command in re.findall(r"^(?:\()?printf .*$", text, re.MULTILINE):
            if not shutil.which(re.search(r"\| (\w+)", command)[1]):
                continue
            with self.subTest(command), Server() as xr3:
                done = subprocess.run(["bash", "-c", command.replace("9600", str(xr3.robot_port))], capture_output=True,
                                      timeout=DEADLINE_S, check=False)
                self.assertEqual(b"R", done.stdout, done.stderr)


class Pages(unittest.TestCase):
    def test_the_table_names_every_page(self):
        front = (CONNECT / "README.md").read_text(encoding="utf-8")
        for page in CONNECT.glob("*.md"):
            if page.name != "README.md":
                self.assertIn(f"]({page.name}", front)


if __name__ == "__main__":
    unittest.main()
