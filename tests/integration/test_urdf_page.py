"""docs/interop/urdf.md: a reader runs its commands, with check_urdf and MuJoCo, and sees what it shows (reader.py)."""
# labels: full

import os
import pathlib
import shutil
import tempfile
import unittest

from reader import Reader, play
from support import ROOT, XR3

TEXT = pathlib.Path(ROOT, "docs", "interop", "urdf.md").read_text(encoding="utf-8")


@unittest.skipUnless(shutil.which("check_urdf") and os.path.exists("/usr/include/mujoco/mujoco.h"),
                     "check_urdf or MuJoCo is not installed (scripts/setup full)")
class Page(unittest.TestCase):
    def test_commands(self):
        reader = Reader(self, pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())), others=("js",))
        reader.variables.append(f"export PATH={pathlib.Path(XR3).parent}:$PATH")
        play(reader, TEXT)
        robot = (reader.folder / "rhino-xr3" / "rhino-xr3.urdf").read_text(encoding="utf-8")
        self.assertIn(f'filename="file://{reader.folder}/rhino-xr3/meshes/base.stl"', robot)


if __name__ == "__main__":
    unittest.main()
