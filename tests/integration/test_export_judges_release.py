"""The files of `xr3 export` in the programs of others: check_urdf accepts them, MuJoCo's forward kinematics is that of
`xr3 kin`, a simulation in MuJoCo stays finite, and urdf-loader draws them in Chromium."""

import concurrent.futures
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest

from page_tests import needs_chromium, run_page_tests
from support import ROOT, XR3

ROBOTS = sorted(path.stem for path in pathlib.Path(ROOT, "data/robots").glob("*.json"))
POSES = 1000
WITHIN_M = 1e-6
TURNS_OF_ENDLESS = 720  # degrees; poses of joints without stops are within two turns
MISSING = "is not installed (scripts/setup full)"
needs_mujoco = unittest.skipUnless(os.path.exists("/usr/include/mujoco/mujoco.h"), f"MuJoCo {MISSING}")


def numbers(values):
    return ",".join(repr(value) for value in values)


def robot_named(name):
    lines = pathlib.Path(ROOT, f"data/robots/{name}.json").read_text().splitlines()
    return json.loads("\n".join(line for line in lines if not line.startswith("*")))


def some_pose(robot):
    """Variables within the limits, degrees and mm: of the joints, the tool, and of the carousel if there is one."""
    moved = [*robot["joints"], robot["tool"], *([robot["carousel"]] if "carousel" in robot else [])]
    return {each["label"]: random.uniform(max(each["limits"][0], -TURNS_OF_ENDLESS), min(each["limits"][1], TURNS_OF_ENDLESS))
            for each in moved}


def kinematics(name, robot, pose):
    """`xr3 kin` at a pose: the tool's place and rotation."""
    joints = numbers(pose[joint["label"]] for joint in robot["joints"])
    report = subprocess.run([XR3, "kin", "--robot", name, f"--joints={joints}", f"--tool={pose['A']!r}", "--json"],
                            capture_output=True, text=True, check=True).stdout
    return json.loads(report)["tool"]


def si(robot, pose):
    """The pose as joints of the exported files: metres and radians, and half the opening for each finger."""
    lengths = {joint["label"] for joint in robot["joints"] if joint["variable"] == "d"}
    lengths |= {"A"} if robot["tool"]["kind"] == "parallel" else set()
    values = {label: value / 1000 if label in lengths else math.radians(value) for label, value in pose.items()}
    values["A"] /= 2
    return values | {"A_2": values["A"]}


def bodies_of(line):
    """Bodies by name: place and rows of the rotation."""
    return {name: ([float(x) for x in rest[:3]], [[float(x) for x in rest[i:i + 3]] for i in (3, 6, 9)])
            for name, *rest in (body.split() for body in line.split(";"))}


def fingertip(body, length_m):
    place, rotation = body
    return [p + length_m * row[2] for p, row in zip(place, rotation)]


class Judges(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.program = pathlib.Path(folder.name, "mujoco")
        cls.folder = pathlib.Path(folder.name, "robots")
        for robot in ROBOTS:
            for form in "--urdf", "--mjcf":
                subprocess.run([XR3, "export", form, robot, cls.folder / robot], check=True, stdout=subprocess.DEVNULL)

    def file(self, robot, ending):
        return self.folder / robot / f"{robot}.{ending}"

    def mujoco(self, *arguments, given=None):
        if not self.program.exists():
            source = pathlib.Path(ROOT, "tests/integration/interop/mujoco.c")
            subprocess.run(["gcc", "-o", self.program, source, "-lmujoco", "-lm"], check=True)
        done = subprocess.run([self.program, *arguments], input=given, capture_output=True, text=True, check=False)
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        return done.stdout

    @unittest.skipUnless(shutil.which("check_urdf"), f"check_urdf {MISSING}")
    def test_check_urdf_accepts_every_robot(self):
        for robot in ROBOTS:
            done = subprocess.run(["check_urdf", self.file(robot, "urdf")], capture_output=True, text=True, check=False)
            self.assertEqual((0, ""), (done.returncode, done.stderr))
            self.assertIn("root Link: base has", done.stdout)

    @needs_mujoco
    def test_mujoco_has_the_kinematics_of_xr3(self):
        random.seed(60)
        for name in ROBOTS:
            robot = robot_named(name)
            poses = [some_pose(robot) for _ in range(POSES)]
            with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
                wanted = list(pool.map(lambda pose: kinematics(name, robot, pose), poses))
            given = "".join(" ".join(f"{label}={value!r}" for label, value in si(robot, pose).items()) + "\n" for pose in poses)
            for ending in "urdf", "xml":
                lines = self.mujoco(self.file(name, ending), given=given).splitlines()
                self.assertEqual(POSES, len(lines))
                for pose, tool, line in zip(poses, wanted, lines):
                    with self.subTest(robot=name, form=ending, pose=pose):
                        self.check_bodies(robot, pose, tool, bodies_of(line))

    def check_bodies(self, robot, pose, tool, bodies):
        place, rotation = bodies["tool"]
        self.assertLess(math.dist(place, [x / 1000 for x in tool["xyz_mm"]]), WITHIN_M)
        for row, wanted in zip(rotation, tool["rotation"]):
            self.assertLess(math.dist(row, wanted), 1e-6)
        self.check_opening(robot, pose, bodies)
        if "carousel" in robot:
            place, rotation = bodies["carousel"]
            self.assertLess(math.dist(place, [*(x / 1000 for x in robot["carousel"]["center"]), 0]), WITHIN_M)
            turn = math.radians(pose[robot["carousel"]["label"]])
            self.assertLess(math.dist(rotation[0], [math.cos(turn), -math.sin(turn), 0]), 1e-6)

    def check_opening(self, robot, pose, bodies):
        """The fingertips are as far apart as the variable of the tool says."""
        length = robot["tool"].get("finger_length", 0) / 1000
        apart = math.dist(fingertip(bodies["finger_1"], length), fingertip(bodies["finger_2"], length))
        opening = pose["A"] / 1000 if length == 0 else 2 * length * math.sin(math.radians(pose["A"] / 2))
        self.assertLess(abs(apart - opening), WITHIN_M)

    @needs_mujoco
    def test_a_simulation_stays_finite_with_equal_fingers(self):
        for robot in ROBOTS:
            warnings, apart, off = (float(x) for x in self.mujoco(self.file(robot, "xml"), "2").split())
            with self.subTest(robot=robot):
                self.assertEqual(0, warnings)  # MuJoCo counts values that are not finite or very large
                self.assertLess(apart, 1e-3)  # m or rad
                self.assertLess(off, 0.02)  # the actuators hold the arm against gravity

    @needs_chromium
    def test_urdf_loader_draws_every_robot(self):
        os.environ["XR3_EXPORTED"] = str(self.folder)
        run_page_tests(self, "../integration/interop/urdf_loader_test.mjs", passed=len(ROBOTS))


if __name__ == "__main__":
    unittest.main()
