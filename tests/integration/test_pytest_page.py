"""docs/ci/pytest.md: a reader installs the package into a virtual environment and runs the tests, as the page says
(reader.py). In place of the wheel, pip installs clients/python, and the program is put beside Python; pytest is the
system's."""
# labels: full

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from reader import FENCE, Reader, play
from support import ROOT, XR3

PAGE = pathlib.Path(ROOT, "docs", "ci", "pytest.md")
CLIENT = pathlib.Path(ROOT, "clients", "python")
TEXT = PAGE.read_text(encoding="utf-8")
INSTALL_S = 240.0


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def install(self):
        """Carries out the commands for the installation, in a home of its own."""
        (commands,) = [text for kind, text in FENCE.findall(TEXT) if kind == "sh"]
        shutil.copytree(CLIENT, self.folder / "package", ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
        venv, pip = "python3 -m venv ~/robots\n", "pip install pytest ./xr3-VERSION-py3-none-manylinux_2_36_x86_64.whl\n"
        self.assertEqual(f"{venv}. ~/robots/bin/activate\n{pip}", commands)
        commands = commands.replace(venv, "/usr/bin/python3 -m venv --system-site-packages ~/robots\n")
        commands = commands.replace(pip, f"pip install -q --no-index --no-build-isolation ./package\nln -s {XR3} ~/robots/bin/xr3\n")
        environment = {**os.environ, "HOME": str(self.folder), "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
        done = subprocess.run(["bash", "-euc", commands], cwd=self.folder, env=environment, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=INSTALL_S, check=False)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)

    def test_steps(self):
        self.install()
        reader = Reader(self, self.folder, others=("sh",))
        reader.variables += ["unset XR3", f"export HOME={self.folder} COLUMNS=80", ". ~/robots/bin/activate"]
        play(reader, TEXT)

    def test_the_keywords_are_those_of_the_mark(self):
        options = re.search(r"^OPTIONS = \((.*)\)$", (CLIENT / "xr3" / "pytest_plugin.py").read_text(encoding="utf-8"), re.MULTILINE)[1]
        rows = TEXT.partition("| keyword |")[2].partition("\n\n")[0]
        named = [name for row in rows.splitlines()[2:] for name in re.findall(r"`(\w+)`", row.split(" | ")[0])]
        self.assertEqual(sorted(re.findall(r"\w+", options)), sorted(named))


if __name__ == "__main__":
    unittest.main()
