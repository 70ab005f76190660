"""The folder can be installed with pip, and the installed package is complete. Needs pip,
setuptools and wheel, but no network; skipped if they are missing. Its help() is short."""

import importlib.util
import os
import pydoc
import shutil
import subprocess
import sys
import tempfile
import unittest
from importlib import metadata
from pathlib import Path

from context import XR3
import xr3

FOLDER = Path(__file__).resolve().parent.parent
NEEDS = ("pip", "setuptools", "wheel")
ASK = "import xr3, pathlib; print(xr3.__version__, pathlib.Path(xr3.__file__).parent)"


class Installed(unittest.TestCase):
    @unittest.skipUnless(all(map(importlib.util.find_spec, NEEDS)), f"needs {NEEDS}")
    def test_by_pip(self):
        with tempfile.TemporaryDirectory() as there:
            copy, site = Path(there) / "python", Path(there) / "site"
            shutil.copytree(FOLDER, copy, ignore=shutil.ignore_patterns("build", "*.egg-info"))
            subprocess.run([sys.executable, "-m", "pip", "install", "-q", "--no-index", "--no-deps",
                            "--no-build-isolation", "--target", str(site), str(copy)],
                           check=True, timeout=120, stderr=subprocess.PIPE)
            said = subprocess.run([sys.executable, "-c", ASK], cwd=there, check=True, timeout=60,
                                  env={**os.environ, "PYTHONPATH": str(site)}, text=True,
                                  stdout=subprocess.PIPE).stdout
            self.assertEqual(f"{xr3.__version__} {site / 'xr3'}\n", said)
            self.assertTrue((site / "xr3" / "py.typed").exists())
            plugins = [each for found in metadata.distributions(path=[str(site)]) for each in found.entry_points
                       if each.group == "pytest11"]
            self.assertEqual([("xr3", "xr3.pytest_plugin")], [(each.name, each.value) for each in plugins])

    def test_version_is_that_of_xr3(self):
        said = subprocess.run([XR3, "--version"], check=True, timeout=60, text=True,
                              stdout=subprocess.PIPE).stdout
        self.assertIn(xr3.__version__, said.split())


class Help(unittest.TestCase):
    def test_no_argument_is_a_page(self):
        """help() shows an arm in a signature by its name."""
        for name in ("connect", "Robot", "Arm", "Monitor", "Camera", "Picture"):
            with self.subTest(name):
                self.assertNotRegex(pydoc.plain(pydoc.render_doc(getattr(xr3, name))), r"Joint\(|lambda")
        self.assertIn("arm: xr3.kinematics.Arm = <Arm rhino-xr3>,", pydoc.plain(pydoc.render_doc(xr3.connect)))


if __name__ == "__main__":
    unittest.main()
