"""Log messages of events that are caused by simulated time, and escapes in the log."""

import unittest

from support import Server, drive


class Log(unittest.TestCase):
    def test_the_tip_under_the_surface_is_told_once_a_crossing(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            drive(line, monitor, E=449, D=-625)
            self.assertNotIn("below_surface", xr3.log())
            for crossing in 1, 2:
                drive(line, monitor, E=150)
                xr3.wait_log("cell @[0-9]+: below_surface: ", crossing)
                drive(line, monitor, E=-150)
            self.assertEqual(2, xr3.log().count("below_surface"))

    def test_a_stall_says_what_sets_the_robot_free(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            for _ in range(3):
                line.send("E-120\r")
                monitor.settle(after=line)
            self.assertIn("A$", xr3.wait_log("protected_region: .*"))

    def test_a_name_forges_no_line_and_moves_no_terminal(self):
        with Server() as xr3, xr3.monitor() as monitor:
            monitor.call("block_add", name="x\n12:00:00.000 \x1b[31m\x9b\x00é", size_mm=[9, 9, 9], xyz_mm=[300, 0, 5], color=1)
            line = xr3.wait_log("block_add x.*")
            self.assertTrue(line.endswith(r"block_add x\x0a12:00:00.000 \x1b[31m\x9b\x00é" "\n"), line)


if __name__ == "__main__":
    unittest.main()
