"""A homing and a pick through a physical controller with `--mirror`: the simulation and the arm, played by a second
xr3, do the same in real time. It takes a minute or two."""

import pathlib
import tempfile
import unittest

from support import Server, counts
from test_device import disable, home_and_pick


class TheMirror(unittest.TestCase):
    def test_a_homing_and_a_pick(self):
        with tempfile.TemporaryDirectory(prefix="xr3-") as folder:
            path = str(pathlib.Path(folder, "arm"))
            with Server("--compat", "mark3", "--pty", path, clock="real") as arm, \
                    Server("--compat", "mark3", "--serial", path, "--mirror", clock="real") as xr3, \
                    arm.monitor() as there, xr3.monitor() as here:
                disable(xr3, xr3.line())
                home_and_pick(xr3, pause_s=0.05)
                for monitor in there, here:
                    while monitor.get("moving")["moving"]:
                        pass
                    self.assertEqual("red", monitor.get("tool")["tool"]["holding"])
                self.assertEqual(counts(there.get()), counts(here.get()))
                codes = [event["code"] for event in here.recall("event")]
                self.assertEqual([], [code for code in codes if code.startswith("mirror_")])


if __name__ == "__main__":
    unittest.main()
