"""`xr3 export` as a command: its files, the robots that it takes, and what it refuses. test_export_judges_release.py has the
programs that read the files."""

import os
import pathlib
import re
import shutil
import struct
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from support import ROOT, run_xr3

ROBOTS = pathlib.Path(ROOT, "data/robots")
MESHES = ["base", "finger_1", "finger_2", "link_B", "link_C", "link_D", "link_E", "link_F"]


class Export(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_here(self, *arguments, code=0):
        done = run_xr3("export", *arguments, cwd=self.folder)
        self.assertEqual(code, done.returncode, done.stderr)
        return done.stderr if code else done.stdout

    def files(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if path.is_file())

    def test_writes_a_folder_with_the_name_of_the_robot(self):
        for option, ending in ("--urdf", "urdf"), ("--mjcf", "xml"):
            self.assertEqual(f"rhino-xr3/rhino-xr3.{ending}: with 8 meshes\n", self.run_here(option, "rhino-xr3"))
        self.assertEqual(sorted([f"rhino-xr3/meshes/{mesh}.stl" for mesh in MESHES] +
                                ["rhino-xr3/rhino-xr3.urdf", "rhino-xr3/rhino-xr3.xml"]), self.files())

    def test_takes_a_robot_file_and_a_folder(self):
        shutil.copy(ROBOTS / "adept-one.json", self.folder / "my arm & co.json")
        self.assertEqual("a/b/my arm & co.urdf: with 7 meshes\n", self.run_here("--urdf", "my arm & co.json", "a/b"))
        root = ElementTree.parse(self.folder / "a/b/my arm & co.urdf").getroot()
        self.assertEqual("my arm & co", root.get("name"))
        for mesh in root.iter("mesh"):
            self.assertTrue((self.folder / "a/b" / mesh.get("filename")).is_file())

    def test_replaces_a_file_only_by_force(self):
        self.run_here("--urdf", "rhino-xr3", "out")
        file = self.folder / "out/rhino-xr3.urdf"
        written = file.read_text()
        file.write_text("mine")
        self.assertEqual("xr3: out/rhino-xr3.urdf: already exists; --force replaces it\n",
                         self.run_here("--urdf", "rhino-xr3", "out", code=2))
        self.assertEqual("mine", file.read_text())
        self.run_here("--urdf", "rhino-xr3", "out", "--force")
        self.assertEqual(written, file.read_text())

    def test_refuses_without_writing(self):
        for arguments, why in ((["rhino-xr3"], "needs --urdf or --mjcf"), (["--urdf", "--mjcf", "rhino-xr3"], "--mjcf"),
                               (["--urdf"], "NAME|FILE"), (["--urdf", "rhino-xr4"], "rhino-xr3")):
            self.assertIn(why, self.run_here(*arguments, code=2))
        self.assertEqual([], self.files())

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_says_which_folder_cannot_be_made(self):
        self.folder.chmod(0o500)
        self.assertIn("Permission denied", self.run_here("--urdf", "rhino-xr3", code=2))

    def test_says_that_a_folder_is_a_file(self):
        (self.folder / "out").write_text("")
        self.assertRegex(self.run_here("--urdf", "rhino-xr3", "out", code=2), r"\Axr3: out.*: Not a directory\n\Z")

    def test_joints_are_joint_variables_in_metres_and_radians(self):
        self.run_here("--urdf", "rhino-xr3-accessories")
        root = ElementTree.parse(self.folder / "rhino-xr3-accessories/rhino-xr3-accessories.urdf").getroot()
        joints = {joint.get("name"): joint for joint in root.iter("joint")}
        self.assertEqual({"G": "prismatic", "F": "revolute", "E": "revolute", "D": "revolute", "C": "revolute",
                          "B": "continuous", "tool_fixed": "fixed", "A": "prismatic", "A_2": "prismatic",
                          "H": "continuous"}, {name: joint.get("type") for name, joint in joints.items()})
        limit = {name: {key: float(value) for key, value in joint.find("limit").attrib.items()}
                 for name, joint in joints.items() if name != "tool_fixed"}
        self.assertEqual((-0.25, 0.25, 0.06), tuple(limit["G"][key] for key in ("lower", "upper", "velocity")))
        self.assertAlmostEqual(-2.443460952792, limit["E"]["lower"], 9)  # -140 degrees
        self.assertAlmostEqual(0.1135 * 110 * 3.14159265 / 180, limit["E"]["velocity"], 6)
        self.assertAlmostEqual(0.0635 / 2, limit["A"]["upper"], 9)
        self.assertNotIn("lower", limit["B"])
        self.assertEqual(["A"], [mimic.get("joint") for mimic in root.iter("mimic")])

    def test_a_mesh_is_a_binary_stl_in_metres(self):
        self.run_here("--urdf", "rhino-xr3")
        mesh = (self.folder / "rhino-xr3/meshes/link_E.stl").read_bytes()
        triangles, = struct.unpack_from("<I", mesh, 80)
        self.assertEqual(84 + 50 * triangles, len(mesh))
        self.assertFalse(mesh.startswith(b"solid"), "a reader would take it for text")
        points = [struct.unpack_from("<12f", mesh, 84 + 50 * i)[3:] for i in range(triangles)]
        self.assertTrue(0.2 < max(abs(x) for point in points for x in point) < 0.4)

    def test_a_robot_without_outlines_is_a_stick_figure(self):
        text = (ROBOTS / "intelledex-660.json").read_text()
        start = text.index('"links"')
        robot = self.folder / "plain.json"
        robot.write_text(without_links(text[:start], text[start:]))
        self.assertEqual("plain/plain.xml: with 9 meshes\n", self.run_here("--mjcf", "plain.json"))


def without_links(before, links):
    """The text of a robot file without its member `links`, whose last line has the indentation of its first."""
    indent = re.search(r"[ ]*\Z", before)[0]
    return before + links[re.search(rf"\n{indent}\],?\s*", links).end():]


if __name__ == "__main__":
    unittest.main()
