"""The commands of clients/python/README.md that install the package into a virtual environment, unchanged but for
the home folder. Nothing is downloaded: setuptools and wheel are those of the system."""
# labels: full

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from support import ROOT

CLIENT = pathlib.Path(ROOT, "clients", "python")
INSTALL_S = 240.0
PROGRAM = "import xr3\nprint(xr3.__file__, xr3.RHINO_XR3.tip({}))\n"


class Package(unittest.TestCase):
    def test_the_commands_install_it(self):
        section = (CLIENT / "README.md").read_text(encoding="utf-8").split("\n## The package\n")[1]
        commands = re.search(r"^```sh\n(.*?)^```", section, re.DOTALL | re.MULTILINE)[1]
        self.assertEqual(3, len(commands.splitlines()))
        with tempfile.TemporaryDirectory() as folder:
            checkout = pathlib.Path(folder, "checkout")
            shutil.copytree(CLIENT, checkout / "clients" / "python",  # pip writes into the source folder
                            ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
            (checkout / "my_program.py").write_text(PROGRAM, encoding="ascii")
            environment = {**os.environ, "HOME": folder, "PATH": f"/usr/bin:{os.environ['PATH']}", "PIP_NO_INDEX": "1",
                           "PIP_NO_BUILD_ISOLATION": "0",  # pip's spelling of "no isolation"
                           "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PYTHONPATH": "/usr/lib/python3/dist-packages"}
            done = subprocess.run(["bash", "-euc", commands], cwd=checkout, env=environment, capture_output=True,
                                  text=True, stdin=subprocess.DEVNULL, timeout=INSTALL_S, check=False)
            self.assertEqual(0, done.returncode, done.stdout + done.stderr)
            self.assertIn(f"{folder}/robots/lib/python3", done.stdout.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
