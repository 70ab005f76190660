"""The Rhino's accessories over the robot port: a program homes slide and carousel by their switches, puts a block
of the table on the carousel, turns it by a quarter, and picks the block at its new place. The counts come from
`xr3 kin`; the monitor port only serves to check the result."""

import json
import math
import unittest

from exercise import Robot
from support import Server, motors, run_xr3
from test_exercise import manual_clock

QUARTER = 288  # counts of H
CAROUSEL = (330, 330)
MOST_MM = 1.0  # the arm stops at whole counts


class Arm:
    """The data sheet; `slide` is where the program wants the slide."""
    name = "rhino-xr3-accessories"
    homing = "DECBFGH"
    masks = {"H": 32, "G": 16, "F": 8, "E": 4, "D": 2, "C": 1, "B": 32, "A": 16}
    hard_home = {"H": 30, "G": -40, "F": 30, "E": -40, "D": 40, "C": 40, "B": -25, "A": -16}
    displaced = {"H": -70, "G": 90, "F": 80, "E": 100, "D": -120, "B": 60, "A": 20}
    slide = 0

    @staticmethod
    def opening(jaws):
        return 50.8 - 0.79375 * jaws

    def solve(self, x, y, z, yaw):
        done = run_xr3("kin", "--robot", self.name, f"--pose={x},{y},{z}", f"--down={yaw}", f"--slide={self.slide}",
                       "--json")
        report = json.loads(done.stdout)
        assert [each["code"] for each in report["free"]] == ["slide"], report["free"]
        return next(solution["counts"] for solution in report["solutions"] if solution["allowed"])


class Accessories(unittest.TestCase):
    def block(self, monitor, name):
        return next(block for block in monitor.get()["blocks"] if block["name"] == name)

    def assert_at(self, block, x, y, z, yaw):
        self.assertLess(math.dist(block["xyz_mm"], (x, y, z)), MOST_MM, block)
        self.assertLess(abs(math.remainder(block["yaw_deg"] - yaw, 180)), 0.3, block)
        self.assertFalse(block["held"])

    def run_with(self, profile):
        with Server("--robot", Arm.name, "--compat", profile) as xr3, xr3.monitor() as monitor, xr3.line() as line:
            arm = Arm()
            robot = Robot(arm, line, manual_clock(line, monitor))
            robot.at = dict.fromkeys(arm.hard_home, 0)
            robot.move(arm.displaced)
            robot.home()
            self.assertEqual(robot.at, {label: motor["count"] for label, motor in motors(monitor.get()).items()})
            robot.move({"H": 0})

            robot.pick(262, 0, 20, 90)
            arm.slide = 250
            robot.place(400, 330, 60, 90)
            self.assert_at(self.block(monitor, "red"), 400, 330, 60, 90)
            red, yellow = self.block(monitor, "red"), self.block(monitor, "yellow")

            robot.move({"H": QUARTER})
            for before in red, yellow:
                x, y, z = before["xyz_mm"]
                dx, dy = x - CAROUSEL[0], y - CAROUSEL[1]
                turned = self.block(monitor, before["name"])
                self.assertLess(math.dist(turned["xyz_mm"], (CAROUSEL[0] - dy, CAROUSEL[1] + dx, z)), 0.0015)
                self.assertAlmostEqual(0, math.remainder(turned["yaw_deg"] - before["yaw_deg"] - 90, 360), 4)

            self.assertIsNotNone(robot.pick(330, 400, 60, 180))
            robot.move({"H": 0})
            self.assertTrue(self.block(monitor, "red")["held"])
            self.assertEqual(yellow, self.block(monitor, "yellow"))
            arm.slide = 0
            robot.place(262, 0, 20, 90)
            self.assert_at(self.block(monitor, "red"), 262, 0, 20, 90)
            self.assertEqual(b"", line.unread())
            self.assertNotRegex(xr3.log(), r"line \d+ @\d+: (?!opened)")

    def test_in_both_profiles(self):
        for profile in "paper", "mark3":
            with self.subTest(profile):
                self.run_with(profile)

    def test_a_snapshot_keeps_where_the_blocks_were_put(self):
        with Server("--robot", Arm.name) as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("H+100\r")
            monitor.step(3000, after=line)
            saved = monitor.call("snapshot_save", inline=True)["snapshot"]
            self.assertEqual([3, 4], [rider["block"] for rider in saved["state"]["riders"]])
            there = monitor.get()["blocks"]
            line.send("H+100\r")
            monitor.step(3000, after=line)
            self.assertNotEqual(there, monitor.get()["blocks"])
            monitor.call("snapshot_load", snapshot=saved)
            self.assertEqual(there, monitor.get()["blocks"])
            line.send("H-100\r")
            monitor.step(3000, after=line)
            places = [block["xyz_mm"] for block in monitor.get()["blocks"]]
            self.assertEqual([[330, 260, 52], [270, 350, 58]], places[3:])

    def test_blocks_that_calls_put_on_the_carousel_turn(self):
        with Server("--robot", Arm.name) as xr3, xr3.monitor() as monitor, xr3.line() as line:
            monitor.call("block_move", name="red", xyz_mm=[430, 330, 60])
            monitor.call("block_add", name="new", size_mm=[20, 20, 20], xyz_mm=[430, 330, 90], yaw_deg=0, color=3)
            monitor.call("block_add", name="deep", size_mm=[20, 20, 20], xyz_mm=[330, 400, 10], yaw_deg=0, color=3)
            xr3.wait_log("deep overlaps the carousel: put it on its top or beside it")
            monitor.call("block_remove", name="yellow")
            for part in 96, 96, 96:
                line.send(f"H+{part}\r")
                monitor.step(3000, after=line)
            self.assertEqual([330, 430, 60], self.block(monitor, "red")["xyz_mm"])
            self.assertEqual([330, 430, 90], self.block(monitor, "new")["xyz_mm"])
            self.assertEqual([330, 400, 10], self.block(monitor, "deep")["xyz_mm"])
            self.assertEqual([310, 270, 58], self.block(monitor, "magenta")["xyz_mm"])

    def test_the_camera_sees_the_turned_block(self):
        with Server("--robot", Arm.name) as xr3, xr3.monitor() as monitor, xr3.line() as line:
            def sees(x, y):
                line.send(f"A*{(x - 60) // 2},{(480 - y) // 2}*")
                return line.read(1) == b"!"

            self.assertEqual((True, False), (sees(270, 350), sees(400, 330)))
            for part in 127, 127, 34:
                line.send(f"H+{part}\r")
                monitor.step(3000, after=line)
            self.assertEqual((False, True), (sees(270, 350), sees(400, 330)))


if __name__ == "__main__":
    unittest.main()
