"""`xr3 kin` as a command: standard output, standard error and exit codes. The figures are tested in tests/tools."""

import json
import unittest

from support import run_xr3

BEYOND_LIMITS = ["--pose=-262,0,20", "--down", "90"]  # behind the robot
FORBIDDEN = "xr3: no solution is within the limits and outside the protected region\n"


class Kin(unittest.TestCase):
    def test_a_pose_that_the_robot_can_take(self):
        done = run_xr3("kin", "--pose", "262,0,20", "--down", "90")
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        self.assertRegex(done.stdout, r"(?s)4 solutions, 1 allowed by limits and protected region\n\nMotor counts.*Joint variables")

    def test_the_tip_comes_before_the_matrices(self):
        self.assertRegex(run_xr3("kin", "--counts", "0,0,0,0,0").stdout,
                         r"(?s)\ARhino XR-3: direct kinematics\n\nTool\n  tip .*Motors.*Link matrices.*T\(0,5\)")

    def test_a_pose_that_the_limits_forbid(self):
        done = run_xr3("kin", *BEYOND_LIMITS)
        self.assertEqual((2, FORBIDDEN), (done.returncode, done.stderr))
        self.assertIn("4 solutions, 0 allowed by limits and protected region", done.stdout)

    def test_the_same_as_json(self):
        done = run_xr3("kin", *BEYOND_LIMITS, "--json")
        self.assertEqual((2, FORBIDDEN), (done.returncode, done.stderr))
        self.assertEqual({False}, {solution["allowed"] for solution in json.loads(done.stdout)["solutions"]})

    def test_a_pose_out_of_reach(self):
        done = run_xr3("kin", "--pose", "900,0,20", "--down", "90")
        self.assertEqual((2, ""), (done.returncode, done.stdout))
        self.assertRegex(done.stderr, r"\Axr3: out of reach: the wrist would be [0-9.]+ mm beyond the stretched arm\n\Z")

    def test_an_arm_on_a_slide(self):
        for options, place in ((), 0), (("--slide", "-120"), -240):
            done = run_xr3("kin", "--robot", "rhino-xr3-accessories", f"--pose=262,{place / 2},45", "--down", "90",
                           "--json", *options)
            self.assertEqual((0, ""), (done.returncode, done.stderr))
            report = json.loads(done.stdout)
            self.assertEqual(["slide"], [freedom["code"] for freedom in report["free"]])
            self.assertEqual({"G": place, "F": 0, "E": 449, "D": -625, "C": 0, "B": 0},
                             report["solutions"][0]["counts"])
        done = run_xr3("kin", "--robot", "rhino-xr3-accessories", "--joints=0,0,-90,90,0,-90")
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        self.assertIn("T(0,k) is in the base frame, the mount included", done.stdout)
        self.assertIn("(238.1, 0, 345.7) mm", done.stdout)

    def test_a_slide_that_is_not_there(self):
        for options, why in (
                (("--pose=262,0,20", "--down=90"),
                 "--slide goes with a robot whose arm stands on a slide; that of the Rhino XR-3 does not"),
                (("--counts=0,0,0,0,0",), "--slide goes with --pose or --configuration")):
            done = run_xr3("kin", *options, "--slide", "5")
            self.assertEqual((2, "", f"xr3: {why}\n"), (done.returncode, done.stdout, done.stderr))


if __name__ == "__main__":
    unittest.main()
