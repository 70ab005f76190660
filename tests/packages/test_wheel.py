"""The wheel in a virtual environment of bare Debian 12 and 13, without network: the program serves and finds its data, the
Python package and the plugin of pytest are there, and removal leaves nothing. Needs root. `./test --packages`."""

import re
import tempfile
import unittest

from built import ANSWERS, SERVE_AND_ASK, VERSION, WORK, Built, need_root as setUpModule, run
from roots import ROOT, SUITES, Root

USER = 1000
SYSTEM = "python3-venv python3-pytest python3-setuptools python3-wheel"
INSIDE = "PATH=/tmp/robots/bin:$PATH; cd /tmp;"
LIST = "find /tmp/robots -not -path '*/__pycache__*' | sort"
LOAD_ENTRY_POINTS = """
import importlib.metadata
for entry in importlib.metadata.distribution("xr3").entry_points:
    entry.load()
    print(entry.group, entry.name)
"""


class Wheel(Built):
    def test_life_in_a_bare_system(self):
        for suite in SUITES:
            with self.subTest(suite), tempfile.TemporaryDirectory(dir=WORK) as folder:
                root = Root(suite, folder)
                root.run(f"apt-get install --yes --no-install-recommends {SYSTEM}")
                self.live(root)

    def live(self, root):
        wheel = root.put(next(self.packages.glob("xr3-*_x86_64.whl")))
        empty = root.run(f"python3 -m venv /tmp/robots; {LIST}")
        root.run(f"unshare --net /tmp/robots/bin/pip install {wheel}; chown -R {USER} /tmp/robots")
        self.use(root)
        root.run("/tmp/robots/bin/pip check; /tmp/robots/bin/pip uninstall --yes xr3")
        self.assertEqual(empty, root.run(LIST))

    def use(self, root):
        def inside(script):
            return root.run(INSIDE + script, user=USER, timeout=60)
        self.assertRegex(inside("xr3 --version"), rf"^xr3 {re.escape(VERSION)} \(commit ")
        self.assertEqual(f"{VERSION}\n", inside("python -c 'import xr3; print(xr3.__version__)'"))
        self.assertIn(ANSWERS, inside(SERVE_AND_ASK))
        self.assertIn("adept-one", inside("xr3 draw --robot adept-one arm.png && xr3 completion robots"))
        self.assertIn(": ok", inside("xr3 check robots/share/xr3/workcells/rhino-xr3.json"))
        self.assertIn("passed", inside("cd robots/share/xr3/exercises && xr3 exercise check 01-*"))

    def test_pip_selects_it_among_the_files_of_a_release(self):
        for suite in SUITES:
            with self.subTest(suite), tempfile.TemporaryDirectory(dir=WORK) as folder:
                root = Root(suite, folder)
                root.run(f"apt-get install --yes --no-install-recommends {SYSTEM}; mkdir /tmp/release")
                for path in self.packages.iterdir():
                    root.put(path, "tmp/release")
                root.run(f"cd /tmp/release; touch xr3-{VERSION}-source.tar.gz xr3-{VERSION}-page.tar.gz")
                root.run("python3 -m venv --system-site-packages /tmp/robots;"
                         " unshare --net /tmp/robots/bin/pip install --no-index --find-links /tmp/release xr3")
                self.assertRegex(root.run(INSIDE + "xr3 --version"), rf"^xr3 {re.escape(VERSION)} ")
                (root.path / "tmp/load.py").write_text(LOAD_ENTRY_POINTS, encoding="utf-8")
                self.assertEqual("pytest11 xr3\n", root.run(INSIDE + "python load.py"))
                self.install_the_source(root)

    def install_the_source(self, root):
        root.run(INSIDE + "pip uninstall --yes xr3; unshare --net pip install --no-index --no-build-isolation"
                 f" release/xr3-{VERSION}.tar.gz")
        self.assertEqual(f"{VERSION}\n", root.run(INSIDE + "python -c 'import xr3; print(xr3.__version__)'"))
        self.assertFalse(root.has("/tmp/robots/bin/xr3"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
