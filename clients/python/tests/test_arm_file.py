"""Arms from robot files: those of the three robots give the arms of the package, and any other agrees
with `xr3 kin`."""

import copy
import dataclasses
import functools
import itertools
import json
import math
import os
import re
import tempfile
import unittest
from pathlib import Path

from context import Server
from test_kinematics import kin, poses
from xr3 import ARMS, Arm, Monitor, Pose, Robot, Unreachable
from xr3.inverse import numerical

ROBOTS = Path(os.environ.get("XR3_ROOT", Path(__file__).resolve().parents[3])) / "data" / "robots"
RHINO = json.loads((ROBOTS / "rhino-xr3.json").read_text(encoding="utf-8"))
# theta, d, a and alpha of six axes of which no two meet.
SKEW = ((0, 600, 30, -90), (-90, 50, 430, 0), (90, 160, 20, 90), (0, 430, 40, -90), (90, 20, 25, 90),
        (0, 60, 10, 0))


def widened(robot):
    """A copy of the robot without a protected region, and with joints that turn by more than a turn: from
    -165 to 195 degrees of each angle at the soft home, so that half a turn has one sign."""
    robot = copy.deepcopy(robot)
    del robot["protected_region"]
    for joint in robot["joints"]:
        if joint["variable"] == "theta":
            joint["limits"] = [joint["theta_deg"] - 165, joint["theta_deg"] + 195]
    return robot


def in_inches(robot):
    """A copy of the robot with lengths in inches."""
    robot = copy.deepcopy(robot)
    robot["length_unit"] = "inch"
    for joint in robot["joints"]:
        for member in ("d", "a"):
            joint[member] /= 25.4
    for member in ("precision", "home"):
        robot["tool"][member] /= 25.4
    robot["tool"]["limits"] = [limit / 25.4 for limit in robot["tool"]["limits"]]
    robot["protected_region"] = {name: mm / 25.4 for name, mm in robot["protected_region"].items()}
    robot["links"], robot["tool"]["parts"] = [], []
    return robot


class WithFiles(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, robot, name="mine.json"):
        path = self.folder / name
        path.write_text(robot if isinstance(robot, str) else json.dumps(robot), encoding="utf-8")
        return path


class Files(WithFiles):
    def test_of_the_three_robots(self):
        for name, arm in ARMS.items():
            with self.subTest(name):
                self.assertEqual(arm, Arm.load(ROBOTS / f"{name}.json"))
                self.assertEqual(arm, Arm.load(str(ROBOTS / f"{name}.json")))

    def test_without_optional_members(self):
        """No coupling and no protected region, as in docs/data-files.md."""
        robot = {name: value for name, value in RHINO.items() if name not in ("coupling", "protected_region")}
        arm = Arm.load(self.write(robot))
        self.assertEqual(((), (0, 0)), (arm.coupling, arm.protected))

    def test_comments_and_inches(self):
        path = self.write("* My arm\n  * in inches\n" + json.dumps(in_inches(RHINO)))
        arm = Arm.load(path)
        self.assertEqual(("mine", "FEDCBA"), (arm.name, arm.labels))
        pose = Pose(262, 0, 20, 90)
        self.assertEqual(ARMS["rhino-xr3"].solve(pose), arm.solve(pose))
        self.assertAlmostEqual(63.5, arm.jaws.opening(arm.jaws.fully_open))
        self.assertAlmostEqual(100, arm.protected[0])

    def test_errors_say_what_is_wrong(self):
        for text, why in (("", "Expecting value"), ("[]", "list indices"), ("{}", "'length_unit' is missing"),
                          (json.dumps({**RHINO, "length_unit": "cm"}), "length_unit is 'cm', not 'mm' or 'inch'"),
                          (json.dumps({**RHINO, "tool": {**RHINO["tool"], "precision": 0}}), "precision of A is 0"),
                          (json.dumps({**RHINO, "coupling": [[2, 6]]}), "not between joints 1 to 5"),
                          (json.dumps({**RHINO, "joints": []}), "the list of joints is empty"),
                          (json.dumps({**RHINO, "joints": RHINO["joints"][:1] * 2}), "the joints are F, F, not"),
                          (json.dumps({**RHINO, "joints": [{**RHINO["joints"][0], "label": "A"}]}), "the joints are A, not"),
                          (json.dumps({**RHINO, "tool": {}}), "'kind' is missing")):
            with self.subTest(why), self.assertRaisesRegex(
                    ValueError, f"mine.json is no .*{re.escape(why)}.*xr3 check"):
                Arm.load(self.write(text))
        with self.assertRaises(FileNotFoundError):
            Arm.load(self.folder / "none.json")


class Accessories(unittest.TestCase):
    """The Rhino on a slide, with a carousel."""

    def setUp(self):
        self.arm = Arm.load(ROBOTS / "rhino-xr3-accessories.json")

    def test_labels_and_homing(self):
        self.assertEqual(("GFEDCBAH", "DECBFGH"), (self.arm.labels, self.arm.homing))
        self.assertEqual((-40, 30, 32), (self.arm.switches["G"], self.arm.switches["H"], self.arm.switch("H").mask))

    def test_solutions_are_those_of_xr3_kin(self):
        for slide in (None, 250, -120):
            for x, y, yaw in ((300, 40, 30), (262, 0, 90), (100, 10, 0), (60, 0, 0), (500, 0, 0)):
                pose = Pose(x, y + (slide or 0), 60, yaw)
                report = kin(self.arm, f"--pose={pose.x},{pose.y},{pose.z}", f"--down={yaw}",
                             *([] if slide is None else [f"--slide={slide}"]))
                allowed = {tuple(each["counts"].items()) for each in report["solutions"] if each["allowed"]}
                with self.subTest(slide=slide, pose=pose):
                    try:
                        found = {tuple(counts.items()) for counts in self.arm.solutions(pose, slide)}
                    except Unreachable:
                        found = set()
                    self.assertEqual(allowed, found)
                    for counts in found:
                        self.assertAlmostEqual(slide or 0, self.arm.slide_at(dict(counts)))

    def test_a_tilted_mount_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "tilted.json"
            robot = json.loads((ROBOTS / "rhino-xr3-accessories.json").read_text(encoding="utf-8"))
            robot["mount"]["alpha_deg"] = -80
            path.write_text(json.dumps(robot), encoding="utf-8")
            with self.assertRaisesRegex(ValueError, "base axis of the arm does not point up"):
                Arm.load(path)

    def test_home_and_pick_with_the_slide_where_it_is(self):
        with Server("--robot", "rhino-xr3-accessories", "--clock", "real:500") as server, \
                Robot(port=server.robot_port, arm=self.arm, pause=lambda: None) as robot, \
                Monitor(port=server.monitor_port) as monitor:
            robot.home()
            self.assertEqual(self.arm.switches, monitor.counts())
            robot.go({"H": 0, "G": -500})
            robot.pick(Pose(320, -420, 15, 140))
            self.assertTrue(monitor.block("blue")["held"])
            self.assertEqual(-500, robot.at["G"])


def farthest(counts):
    """The largest distance of a motor from the soft home."""
    return max(map(abs, counts.values()))


class AnyArm(WithFiles):
    """Arms without a closed form."""

    def check(self, arm, robot, wanted):
        """Compares the arm with `xr3 kin` at these poses. Each is solved once."""
        arm = dataclasses.replace(arm, name=str(robot), inverse=functools.lru_cache(arm.inverse))
        for pose in wanted:
            report = kin(arm, f"--pose={pose.x},{pose.y},{pose.z}", f"--down={pose.yaw}")
            allowed = [solution["counts"] for solution in report["solutions"] if solution["allowed"]]
            with self.subTest(arm.name, pose=pose):
                try:
                    self.assertCountEqual(allowed, arm.solutions(pose))
                    self.assertEqual(min(map(farthest, allowed)), farthest(arm.solve(pose)))
                except Unreachable:
                    self.assertEqual([], allowed)

    def test_numerical_solutions_are_those_of_the_closed_form(self):
        for name, arm in ARMS.items():
            self.check(dataclasses.replace(arm, inverse=numerical), name, itertools.islice(poses(arm), 4))

    def test_an_arm_with_a_shoulder_beside_its_base(self):
        robot = copy.deepcopy(RHINO)
        robot["joints"][1]["d"] = 30
        robot["coupling"] = [[4, -3], [3, 2]]  # from the tool to the base
        path = self.write(robot)
        arm = Arm.load(path)
        self.assertIs(numerical, arm.inverse)
        counts = {"F": 30, "E": 40, "D": -60, "C": 20, "B": 10}
        tool = kin(dataclasses.replace(arm, name=str(path)), "--counts=30,40,-60,20,10")["tool"]
        self.assertLess(math.dist(tool["xyz_mm"], arm.tip(counts)), 1e-6)
        self.check(arm, path, itertools.islice(poses(ARMS["rhino-xr3"]), 4))

    def test_an_arm_with_a_closed_form_and_wide_limits(self):
        for name in ARMS:
            path = self.write(widened(json.loads((ROBOTS / f"{name}.json").read_text(encoding="utf-8"))))
            self.check(Arm.load(path), path, poses(ARMS[name]))

    def test_an_arm_with_eight_solutions(self):
        robot = json.loads((ROBOTS / "intelledex-660.json").read_text(encoding="utf-8"))
        for joint, (theta, d, a, alpha) in zip(robot["joints"], SKEW):
            joint.update(theta_deg=theta, d=d, a=a, alpha_deg=alpha)
        path = self.write(widened({**robot, "links": []}))
        arm = Arm.load(path)
        self.assertIs(numerical, arm.inverse)
        self.assertEqual(8, len(arm.solutions(Pose(310, -40, 60, 20))))
        self.check(arm, path, itertools.islice(poses(ARMS["intelledex-660"]), 4))

    def test_out_of_reach(self):
        arm = dataclasses.replace(ARMS["rhino-xr3"], inverse=numerical)
        with self.assertRaisesRegex(Unreachable, "nearest miss it by [0-9.]+ mm and [0-9.]+ degrees"):
            arm.solve(Pose(900, 0, 20))

    def test_jaws_that_close_downwards_with_a_switch_on_the_closed_side(self):
        robot = copy.deepcopy(RHINO)
        robot["tool"].update(direction=1, switch={"position": -20, "mask": 16, "width": 9})
        path = self.write(robot)
        arm = Arm.load(path)
        self.assertEqual((16, -16), (arm.jaws.fully_open, arm.jaws.switch.edge))
        self.assertAlmostEqual(63.5, arm.jaws.opening(16))
        with Server("--robot", str(path), "--workcell", "rhino-xr3", "--clock", "real:500") as server, \
                Robot(port=server.robot_port, arm=arm, pause=lambda: None) as robot, \
                Monitor(port=server.monitor_port) as monitor:
            robot.home()
            self.assertEqual(robot.at, monitor.counts())
            robot.go(dict.fromkeys(arm.labels, 0))
            self.assertGreater(robot.pick(Pose(262, 0, 20, 90)), 30)
            self.assertTrue(monitor.block("red")["held"])

    def test_a_switch_that_is_closed_at_the_soft_home(self):
        """home() finds the edge of a switch that the direction away from the soft home gives."""
        robot = copy.deepcopy(RHINO)
        for joint, switch in zip(robot["joints"], ({"position": 0, "width": 9}, {"position": -30, "width": 301},
                                                   {"position": 10, "width": 30})):
            joint["switch"].update(switch)
        path = self.write(robot)
        arm = Arm.load(path)
        self.assertEqual({"F": -4, "E": 120, "D": -5}, {label: arm.switches[label] for label in "FED"})
        self.assertEqual([1, -1, 1], [arm.switch(label).away for label in "FED"])
        for profile in "paper", "mark3":
            with self.subTest(profile), \
                    Server("--robot", str(path), "--workcell", "rhino-xr3", "--compat", profile, "--clock", "real:500") as server, \
                    Robot(port=server.robot_port, arm=arm, pause=lambda: None) as robot, \
                    Monitor(port=server.monitor_port) as monitor:
                robot.home()
                self.assertEqual(arm.switches, monitor.counts())


if __name__ == "__main__":
    unittest.main()
