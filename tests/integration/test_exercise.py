"""The exercise (exercise.py) with each of the three robots, over the robot port alone: the program sees every
block, picks it up, places it elsewhere, and sees it there. The monitor port only serves to check the result."""

import math
import time
import unittest

from exercise import Robot, exercise
from exercise_arms import ARMS, AdeptOne, Intelledex660, RhinoXr3
from support import Server, motors

FASTER = 1000
MOST_DEGREES = 2.5  # tolerance of a principal angle that is computed from pixels of this size

# For each robot: block, its centroid (x, y), its yaw, and the motor counts of the pick.
PICKS = {
    RhinoXr3: [("red", 262, 0, 90, "E449 D-625"), ("green", 330, 96, 25, "F71 E543 D-479 B260"),
               ("blue", 344, -92, 140, "F-66 E559 D-455 B-208"),
               ("yellow", 212, 136, 60, "F144 E460 D-655 B201"),
               ("magenta", 214, -130, 10, "F-138 E445 D-649 B156")],
    AdeptOne: [("red", 560, 0, 90, "E420 D914 C114 B-158"), ("green", 640, 140, 30, "E449 D702 C114 B-465"),
               ("blue", 620, -150, 115, "E209 D744 C124 B-251"),
               ("yellow", 420, 160, 70, "E715 D1120 C124 B-65"),
               ("magenta", 430, -140, 160, "E325 D1115 C104 B-477")],
    Intelledex660: [("red", 400, 0, 0, "E293 D-932 C-261"),
                    ("green", 470, 120, 35, "G143 E196 D-691 C-405 B-66"),
                    ("blue", 460, -130, 110, "G-158 E205 D-713 C-392 B174"),
                    ("yellow", 290, 150, 65, "G273 E325 D-1094 C-132 B-120"),
                    ("magenta", 280, -140, 160, "G-266 E343 D-1127 C-116 B-21")],
}


def read_counts(text):
    return {word[0]: int(word[1:]) for word in text.split()}


def real_clock(line):
    """A wait() for a running clock: it sends inquiries until the time must have passed."""
    def wait(milliseconds):
        until = time.monotonic() + milliseconds / 1000 / FASTER
        while time.monotonic() < until:
            line.ask("A?")
    return wait


def manual_clock(line, monitor):
    return lambda milliseconds: monitor.step(milliseconds, after=line, fields=[])


class InverseKinematics(unittest.TestCase):
    def test_gives_the_counts_of_the_tables(self):
        for arm, picks in PICKS.items():
            for name, x, y, yaw, counts in picks:
                with self.subTest(arm.name, block=name):
                    z = arm.surface + arm.sizes[name][2] / 2
                    solved = {label: count for label, count in arm.solve(x, y, z, yaw).items() if count}
                    self.assertEqual(read_counts(counts), solved)


class Exercise(unittest.TestCase):
    def check_move(self, arm, name, width, patches):
        """Checks that a block is at its new place within a pixel, and that no other block has moved."""
        self.assertEqual(set(arm.sizes), set(patches), f"after {name} was moved")
        x, y, yaw = arm.places[name]
        length, breadth, _ = arm.sizes[name]
        block, pixel = patches[name], arm.camera.pixel
        self.assertLessEqual(abs(block.x - x), pixel, name)
        self.assertLessEqual(abs(block.y - y), pixel, name)
        self.assertLess(abs(math.remainder(block.yaw - yaw, 180)), MOST_DEGREES, name)
        self.assertLess(abs(block.area - length * breadth), pixel * (length + breadth), name)
        self.assertIsNotNone(width, f"{name}: nothing between the jaws")
        self.assertGreaterEqual(width, breadth - 1e-6, name)
        self.assertLess(width, breadth + 1, name)

    def check_end(self, robot, monitor):
        """Compares the counts and positions that the program assumes with the state of the server."""
        arm, state = robot.arm, monitor.get()
        self.assertEqual(robot.at, {label: motor["count"] for label, motor in motors(state).items()})
        self.assertFalse(state["moving"] or state["stalled"])
        for block in state["blocks"]:
            x, y, _ = arm.places[block["name"]]
            self.assertLess(math.dist(block["xyz_mm"], (x, y, arm.surface + arm.sizes[block["name"]][2] / 2)),
                            arm.camera.pixel, block)

    def run_with(self, arm, profile, clock, waiting):
        with Server("--robot", arm.name, "--compat", profile, clock=clock) as xr3, \
                xr3.monitor() as monitor, xr3.line() as line:
            robot = Robot(arm, line, waiting(line, monitor))
            robot.at = dict.fromkeys(arm.hard_home, 0)
            robot.move(arm.displaced)
            robot.at = {}
            moved = []

            def looked(name, *seen):
                self.check_move(arm, name, *seen)
                moved.append(name)

            exercise(robot, looked)
            self.assertEqual(list(arm.sizes), moved)
            self.check_end(robot, monitor)
            self.assertEqual(b"", line.unread())
            self.assertNotRegex(xr3.log(), r"line \d+ @\d+: (?!opened)")

    def test_with_a_real_clock(self):
        for arm, profile in zip(ARMS, ("mark3", "paper", "mark3")):
            with self.subTest(arm.name, profile=profile):
                self.run_with(arm, profile, f"real:{FASTER}", lambda line, _: real_clock(line))

    def test_with_a_manual_clock(self):
        for arm, profile in zip(ARMS, ("paper", "mark3", "paper")):  # the others have the real clock
            with self.subTest(arm.name, profile=profile):
                self.run_with(arm, profile, "manual", manual_clock)


if __name__ == "__main__":
    unittest.main()
