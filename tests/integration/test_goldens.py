"""Known poses, reached with commands on a serial line and read from the monitor's state. The state has
lengths with three decimals; the tests of core check the same values to 1e-4 mm."""

import unittest

from support import Server, counts, drive, motors

MM = 0.0006  # half of the last decimal, and the rounding of binary fractions
UNIT = 0.00006  # the expected direction cosines and w4...6 have four or five decimals
DEGREES = 0.00051


class Goldens(unittest.TestCase):
    # (robot, motor counts, tip, other known values)
    POSES = [
        ("rhino-xr3", {}, (238.1, 0, 320.7),
         {"approach": (0, 0, -1), "w": (0, 0, -0.60653), "net_roll": 90, "opening": 50.8}),
        ("rhino-xr3", dict(F=90, E=40, D=-60, C=30, B=48), (247.9346, 92.3095, 293.7373),
         {"approach": (0.0557, 0.0207, -0.9982), "w": (0.03669, 0.01366, -0.65808),
          "values": {"F": 20.421, "E": -85.46, "D": 92.27, "C": -10.215, "B": -75}}),
        ("rhino-xr3", dict(F=90, E=40, D=60, C=-30, B=48), (229.1992, 85.3340, 346.8224),
         {"approach": (-0.0557, -0.0207, -0.9982)}),
        ("rhino-xr3", dict(E=449, D=-625), (261.7195, 0, 20.0178),
         {"approach": (0, 0, -1), "net_roll": 90}),
        ("adept-one", {}, (800, 0, 577), {"approach": (0, 0, -1), "w": (0, 0, -1.64872)}),
        ("adept-one", dict(E=449, D=702, C=114, B=-465), (640.0754, 139.7362, 520),
         {"w": (None, None, -0.73544)}),
        ("intelledex-660", {}, (838.2, 0, 373.4), {"approach": (1, 0, 0), "opening": 41.042}),
        ("intelledex-660", dict(G=143, E=196, D=-691, C=-405, B=-66), (470.0607, 119.8170, 15.2739),
         {"w": (None, None, -0.8917), "net_roll": 34.925}),
    ]

    def assert_near(self, expected, actual, tolerance):
        for want, have in zip(expected, actual, strict=True):
            if want is not None:
                self.assertAlmostEqual(want, have, delta=tolerance)

    def check_pose(self, state, tip, known):
        tool = state["tool"]
        self.assert_near(tip, tool["xyz_mm"], MM)
        if "approach" in known:
            self.assert_near(known["approach"], tool["rotation"][2::3], UNIT)
        if "w" in known:
            self.assert_near(known["w"], tool["configuration"][3:], UNIT)
        if "net_roll" in known:
            self.assertAlmostEqual(known["net_roll"], tool["net_roll_deg"], delta=DEGREES)
        if "opening" in known:
            self.assertAlmostEqual(known["opening"], tool["opening_mm"], delta=MM)
        for label, value in known.get("values", {}).items():
            self.assertAlmostEqual(value, motors(state)[label]["value"], delta=DEGREES)

    def test_poses(self):
        for robot, targets, tip, known in self.POSES:
            with self.subTest(robot, **targets), Server("--robot", robot, "--workcell", robot) as xr3:
                with xr3.line() as line, xr3.monitor() as monitor:
                    state = drive(line, monitor, **targets)
                    self.check_pose(state, tip, known)
                    self.assertEqual(" ".join(f"{label}{count}" for label, count in targets.items()),
                                     counts(state, "GFEDCBA"))

    def test_a_drawing_program_reaches_its_documented_place(self):
        """A drawing program of the 1980s moves the wrist with E-224 D+219 from the soft home to about 4 inches
        out and 12 inches up from the shoulder."""
        with Server() as xr3, xr3.line() as line, xr3.monitor() as monitor:
            x, _, z = drive(line, monitor, E=-224, D=219)["tool"]["xyz_mm"]
            wrist_out, wrist_up = x - 9.5, z + 168.3 - 260.4
            self.assertAlmostEqual(4.30, wrist_out / 25.4, delta=0.005)
            self.assertAlmostEqual(11.91, wrist_up / 25.4, delta=0.005)


if __name__ == "__main__":
    unittest.main()
