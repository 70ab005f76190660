"""The kinematics of the three arms: forward and inverse agree with each other, with worked
examples, and with `xr3 kin`."""

import json
import math
import random
import subprocess
import unittest

from context import XR3
from xr3 import ADEPT_ONE, ARMS, INTELLEDEX_660, RHINO_XR3, Pose, Unreachable

# The working area of each arm: ranges of distance from the base and of height, in mm.
CELLS = {"rhino-xr3": (200, 420, 0, 150), "adept-one": (450, 700, 510, 660),
         "intelledex-660": (280, 560, 0, 150)}
POSES = 8
# Beyond the reach of each arm: maximum distance from the base and range of heights, in mm.
SURROUNDINGS = {"rhino-xr3": (500, -100, 400), "adept-one": (850, 400, 950),
                "intelledex-660": (650, -150, 600)}
ANYWHERE = 100  # poses, some of them in the protected region or near the limits


def kin(arm, *arguments):
    """The report of xr3 kin. Negative arguments must be given as --option=value."""
    ran = subprocess.run([XR3, "kin", "--json", "--robot", arm.name, *arguments],
                         capture_output=True, text=True, check=False, timeout=60)
    return json.loads(ran.stdout)


def poses(arm):
    """Random poses in the working area, the same in every run."""
    near, far, low, high = CELLS[arm.name]
    scatter = random.Random(arm.name)
    for _ in range(POSES):
        angle, distance = math.radians(scatter.uniform(-40, 40)), scatter.uniform(near, far)
        yield Pose(round(distance * math.cos(angle), 2), round(distance * math.sin(angle), 2),
                   round(scatter.uniform(low, high), 2), round(scatter.uniform(-175, 175), 2))


def poses_anywhere(arm):
    """Random poses, reachable or not, the same in every run."""
    far, low, high = SURROUNDINGS[arm.name]
    scatter = random.Random(arm.name)
    for _ in range(ANYWHERE):
        angle, distance = math.radians(scatter.uniform(-180, 180)), scatter.uniform(0, far)
        yield Pose(round(distance * math.cos(angle), 2), round(distance * math.sin(angle), 2),
                   round(scatter.uniform(low, high), 2), round(scatter.uniform(-360, 360), 2))


def allowed_by_kin(arm, pose):
    """The counts of all solutions that xr3 kin allows, as a set."""
    report = kin(arm, f"--pose={pose.x},{pose.y},{pose.z}", f"--down={pose.yaw}")
    return {tuple(solution["counts"].items()) for solution in report["solutions"]
            if solution["allowed"]}


def solutions(arm, pose):
    """The counts of all solutions that the package finds, as a set."""
    try:
        return {tuple(counts.items()) for counts in arm.solutions(pose)}
    except Unreachable:
        return set()


class Forward(unittest.TestCase):
    def test_soft_home_of_the_rhino(self):
        self.assertAlmostEqual(0, math.dist((238.1, 0, 320.7), RHINO_XR3.tip({})), places=6)
        self.assertAlmostEqual(90, RHINO_XR3.yaw({}))

    def test_coupled_joints_of_the_rhino(self):
        counts = {"F": 90, "E": 40, "D": -60, "C": 30, "B": 48}
        self.assertEqual([90, 40, -20, 90, 48], RHINO_XR3.positions(counts))
        self.assertLess(math.dist((247.9346, 92.3095, 293.7373), RHINO_XR3.tip(counts)), 1e-3)

    def test_agrees_with_xr3_kin(self):
        for arm in ARMS.values():
            scatter = random.Random(arm.name)
            for _ in range(POSES):
                counts = {label: scatter.randint(-90, 90) for label in arm.labels[:-1]}
                with self.subTest(arm.name, counts=counts):
                    tool = kin(arm, "--counts=" + ",".join(map(str, counts.values())))["tool"]
                    self.assertLess(math.dist(tool["xyz_mm"], arm.tip(counts)), 1e-6)

    def test_opening_of_the_jaws(self):
        self.assertAlmostEqual(63.5, RHINO_XR3.jaws.opening(-16))
        self.assertAlmostEqual(60, INTELLEDEX_660.jaws.opening(-40))


class Back(unittest.TestCase):
    def test_first_pick_of_the_rhino(self):
        self.assertEqual({"F": 0, "E": 449, "D": -625, "C": 0, "B": 0},
                         RHINO_XR3.solve(Pose(262, 0, 20, 90)))

    def test_agrees_with_xr3_kin(self):
        for arm in ARMS.values():
            for pose in poses(arm):
                with self.subTest(arm.name, pose=pose):
                    report = kin(arm, f"--pose={pose.x},{pose.y},{pose.z}", f"--down={pose.yaw}")
                    allowed = [solution["counts"] for solution in report["solutions"]
                               if solution["allowed"]]
                    self.assertIn(arm.solve(pose), allowed)
                    for counts in arm.solutions(pose):
                        self.assertIn(counts, allowed)

    def test_has_a_way_where_xr3_kin_has_one(self):
        for arm in ARMS.values():
            for pose in poses_anywhere(arm):
                with self.subTest(arm.name, pose=pose):
                    self.assertEqual(allowed_by_kin(arm, pose), solutions(arm, pose))

    def test_leads_back_to_the_pose_from_anywhere(self):
        for arm in ARMS.values():
            for pose in poses_anywhere(arm):
                for counts in solutions(arm, pose):
                    with self.subTest(arm.name, pose=pose, counts=counts):
                        self.assertLess(math.dist((pose.x, pose.y, pose.z),
                                                  arm.tip(dict(counts))), 2)

    def test_protected_region(self):
        with self.assertRaisesRegex(Unreachable, "protected region, nearer than 100 mm"):
            RHINO_XR3.solve(Pose(95, 0, 300))

    def test_leads_back_to_the_pose(self):
        for arm in ARMS.values():
            for pose in poses(arm):
                for counts in arm.solutions(pose):
                    with self.subTest(arm.name, pose=pose, counts=counts):
                        self.assertLess(math.dist((pose.x, pose.y, pose.z), arm.tip(counts)), 2)
                        self.assertLess(abs(math.remainder(arm.yaw(counts) - pose.yaw, 360)), 0.5)
                        self.assertAlmostEqual(-1, arm.frame(counts)[2][2], places=4)

    def test_both_elbows_of_the_adept(self):
        self.assertEqual(2, len(ADEPT_ONE.solutions(Pose(560, 0, 520, 0))))

    def test_too_far_and_too_near(self):
        for arm in ARMS.values():
            with self.subTest(arm.name):
                with self.assertRaisesRegex(Unreachable, "links reach"):
                    arm.solve(Pose(3000, 0, 0))
        with self.assertRaisesRegex(Unreachable, "past its limit"):
            ADEPT_ONE.solve(Pose(600, 0, 100))


if __name__ == "__main__":
    unittest.main()
