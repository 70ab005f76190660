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
        self.assertIn("4 solutions, 1 allowed by limits and protected region", done.stdout)

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


if __name__ == "__main__":
    unittest.main()
