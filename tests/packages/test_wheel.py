"""The wheel in a virtual environment of bare Debian 12 and 13, without network: the program serves and finds its data, the
Python package and the plugin of pytest are there, and removal leaves nothing. Needs root. `./test --packages`."""

import re
import tempfile
import unittest

from built import ANSWERS, SERVE_AND_ASK, VERSION, WORK, Built, need_root as setUpModule
from roots import ROOT, SUITES, Root

USER = 1000
SYSTEM = ("python3-venv", "python3-pytest", "python3-setuptools", "python3-wheel")
INSIDE = "export PATH=~/robots/bin:$PATH; cd;"
FILES = "find ~/robots ! -type d ! -path '*/__pycache__/*' | sort"
LOAD_ENTRY_POINTS = """
import importlib.metadata
for entry in importlib.metadata.distribution("xr3").entry_points:
    entry.load()
    print(entry.group, entry.name)
"""

# Tests of a project that has nothing of the checkout: its own code, and a program that it starts.
PROJECT = """
import subprocess, sys

def test_the_arm_moves(robot, monitor):
    robot.move("E", 20)
    robot.wait("E")
    assert monitor.counts()["E"] == 20

def test_a_program(xr3_server):
    program = "import xr3; robot = xr3.connect(); robot.move('E', 20); robot.wait('E'); print(robot.to_go('E'))"
    assert subprocess.check_output([sys.executable, "-c", program]) == b"0\\n"
"""


def shown_commands():
    """The commands of docs/packages.md that install the wheel, and the one that starts the program."""
    section = (ROOT / "docs/packages.md").read_text(encoding="utf-8").split("\n## The wheel\n")[1]
    return section.split("```\n")[1].replace("VERSION", VERSION).splitlines()


class Wheel(Built):
    def system(self, suite):
        return Root(suite, self.enterContext(tempfile.TemporaryDirectory(dir=WORK)), SYSTEM)

    def test_life_in_a_bare_system(self):
        for suite in SUITES:
            with self.subTest(suite):
                root = self.system(suite)
                root.put(next(self.packages.glob("xr3-*_x86_64.whl")))
                make, install, serve = shown_commands()
                empty = root.run(f"{make}; {FILES}")
                root.run(f"cd; unshare --net sh -euc '{install}'; chown -R {USER} ~/robots")
                self.assertEqual("~/robots/bin/xr3 serve", serve)
                self.use(root)
                self.assertIn("No broken requirements", root.run(INSIDE + "pip check; pip uninstall --yes xr3"))
                self.assertEqual(empty, root.run(FILES))

    def use(self, root):
        def inside(script):
            return root.run(INSIDE + script, user=USER, timeout=60)
        self.assertRegex(inside("xr3 --version"), rf"^xr3 {re.escape(VERSION)} \(commit ")
        self.assertEqual(f"{VERSION}\n", inside("python -c 'import xr3; print(xr3.__version__)'"))
        self.assertIn(ANSWERS, inside(SERVE_AND_ASK))
        self.assertIn("adept-one", inside("xr3 draw --robot adept-one arm.png; xr3 completion robots"))
        self.assertIn("a camera", inside("xr3 check robots/share/xr3/workcells/rhino-xr3.json"))

    def test_pip_selects_it_among_the_files_of_a_release(self):
        for suite in SUITES:
            with self.subTest(suite):
                root = self.system(suite)
                root.run(f"mkdir ~/FOLDER; cd ~/FOLDER; touch xr3-{VERSION}-source.tar.gz xr3-{VERSION}-page.tar.gz")
                for path in self.packages.iterdir():
                    root.put(path, "tmp/FOLDER")
                root.run("cd; python3 -m venv --system-site-packages ~/robots;"
                         " unshare --net ~/robots/bin/pip install --no-index --find-links FOLDER xr3")
                self.assertRegex(root.run(INSIDE + "xr3 --version"), rf"^xr3 {re.escape(VERSION)} ")
                self.load_entry_points(root)
                self.run_a_project(root)
                self.install_the_source(root)

    def load_entry_points(self, root):
        (root.path / "tmp/load.py").write_text(LOAD_ENTRY_POINTS, encoding="utf-8")
        self.assertEqual("pytest11 xr3\n", root.run(INSIDE + "python load.py"))

    def run_a_project(self, root):
        root.run(f"mkdir ~/project; chown {USER} ~/project")
        (root.path / "tmp/project/test_robot.py").write_text(PROJECT, encoding="utf-8")
        self.assertIn("2 passed", root.run(INSIDE + "cd project; python -m pytest -W error", user=USER))

    def install_the_source(self, root):
        root.run(INSIDE + "pip uninstall --yes xr3; unshare --net pip install --no-index --no-build-isolation"
                 f" FOLDER/xr3-{VERSION}.tar.gz")
        self.assertEqual(f"{VERSION}\n", root.run(INSIDE + "python -c 'import xr3; print(xr3.__version__)'"))
        self.assertFalse(root.has("/tmp/robots/bin/xr3"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
