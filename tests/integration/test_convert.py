"""`xr3 convert`: a file converts to the paper's plain form and back without loss; broken files are rejected
with all findings; no file is replaced without --force. A recording becomes an MCAP file."""

import json
import os
import pathlib
import resource
import tempfile
import unittest

from support import ROOT, Server, run_xr3

DATA = pathlib.Path(ROOT, "data")
SHIPPED = [DATA / "robots/intelledex-660.json", DATA / "workcells/intelledex-660.json"]

TABLE = """\
* A workcell with only the members that the paper has.
* X Y Z
600 500 700
* blocks
1
64 32 40 262 0 20 90
* camera
290 0 1000
384 384
192 192
"""


def data_of(file):
    """The contents of a JSON file, with the defaults of optional members."""
    data = json.loads(file.read_text())
    for member, default in [("notes", ""), ("work_surface", 0), ("surface_stalls", False)]:
        data.setdefault(member, default)
    if "camera" in data:
        data["camera"].setdefault("projection", "orthographic")
    return data


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, name, text=None):
        file = self.folder / name
        if text is not None:
            file.write_text(text)
        return file

    def assertDone(self, done, words=""):
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        self.assertIn(words, done.stdout)

    def assertRefused(self, done, *words):
        self.assertEqual((2, ""), (done.returncode, done.stdout))
        for word in words:
            self.assertIn(word, done.stderr)


class Convert(Files):
    def test_shipped_files_round_trip(self):
        """(tests/protocol/files has all of them, and random ones.)"""
        for number, file in enumerate(SHIPPED):
            with self.subTest(file.name):
                self.file(str(number)).mkdir()  # blocks are checked against the robot with the name of the file
                plain, back, again = (self.file(f"{number}/{file.stem}{end}") for end in (".txt", ".json", ".dat"))
                self.assertDone(run_xr3("convert", file, plain), "plain form")
                self.assertDone(run_xr3("convert", plain, back), "JSON")
                self.assertDone(run_xr3("convert", back, again))
                self.assertEqual(data_of(file), data_of(back))
                self.assertEqual(plain.read_text(), again.read_text())
                kind = run_xr3("check", file).stdout, run_xr3("check", back).stdout
                self.assertEqual(*kind)
                self.assertEqual([], [p.name for p in self.folder.glob("*/*") if p.name.count(".") > 1],
                                 "no temporary files are left")

    def test_a_hand_written_file(self):
        out = self.file("lab.json")
        self.assertDone(run_xr3("convert", self.file("hand.txt", TABLE), out), 'workcell "hand"')
        block = data_of(out)["blocks"][0]
        self.assertEqual(("block 1", [64, 32, 40], [262, 0, 20], 90),
                         (block["name"], block["size"], block["centroid"], block["yaw_deg"]))
        self.assertDone(run_xr3("check", out), "1 block, a camera")

    def test_replaces_a_file_only_with_force(self):
        plain, out = self.file("w.txt", TABLE), self.file("w.json", "mine")
        self.assertRefused(run_xr3("convert", plain, out), "w.json", "--force")
        self.assertEqual("mine", out.read_text())
        out.chmod(0o640)
        self.assertDone(run_xr3("convert", "--force", plain, out))
        self.assertEqual((600, 0o640), (data_of(out)["workspace"]["x"], out.stat().st_mode & 0o777))

    def test_follows_links_and_refuses_folders(self):
        plain, target, link = self.file("w.txt", TABLE), self.file("t.json", "old"), self.file("l.json")
        link.symlink_to(target)
        self.assertDone(run_xr3("convert", "--force", plain, link))
        self.assertTrue(link.is_symlink())
        self.assertEqual(600, data_of(target)["workspace"]["x"])
        self.file("d.json").mkdir()
        self.assertRefused(run_xr3("convert", "--force", plain, self.folder / "d.json"), "not a file")
        self.assertRefused(run_xr3("convert", plain, self.folder / "no" / "w.json"), "cannot be written")

    def test_reports_every_finding_with_its_line(self):
        plain = self.file("lab.txt", TABLE.replace("64 32 40", "64 -32 wide").replace("384 384", "384"))
        done = run_xr3("convert", plain, self.file("lab.json"))
        self.assertRefused(done)
        self.assertEqual(
            [f"{plain}:6: /blocks/0/size/1: found -32; allowed: a length above 0, up to 100000 mm",
             f'{plain}:6: /blocks/0/size/2: found "wide"; allowed: a length above 0, up to 100000 mm',
             f'{plain}:9: /camera/field: found "384"; allowed: 2 items: camera\'s field of view: '
             "length (x), width (y)"],
            done.stderr.splitlines())
        self.assertFalse(self.file("lab.json").exists())

    def test_broken_json_gets_the_errors_of_check(self):
        file = pathlib.Path(ROOT, "tests/data/broken/robot-ranges.json")
        self.assertRefused(run_xr3("convert", file, self.file("out.txt")), run_xr3("check", file).stderr)
        self.assertFalse(self.file("out.txt").exists())

    def test_invalid_names_are_refused(self):
        plain = self.file("w.txt", TABLE)
        self.assertRefused(run_xr3("convert", plain, self.file("w.xml")), ".json", ".txt", ".dat")
        self.assertRefused(run_xr3("convert", self.file("none.txt"), self.file("w.json")), "none.txt")
        self.assertRefused(run_xr3("convert", self.folder, self.file("w.json")), "folder")
        self.assertRefused(run_xr3("convert", plain))

    @unittest.skipIf(os.getuid() == 0, "root may write everywhere")
    def test_a_read_only_folder(self):
        self.folder.chmod(0o500)
        self.addCleanup(self.folder.chmod, 0o700)
        self.assertRefused(run_xr3("convert", SHIPPED[0], self.file("w.txt")), "cannot be written")


class IntoMcap(Files):
    """The files themselves are read in test_mcap.py."""

    RECORDING = pathlib.Path(ROOT, "docs", "find-and-pick.xr3rec")

    def convert(self, *arguments, recording=RECORDING, **options):
        return run_xr3("convert", recording, self.file("run.mcap"), *arguments, **options)

    def assertNothing(self):
        self.assertEqual([], list(self.folder.glob("run.mcap*")), "no draft is left")

    def test_is_for_the_owner_alone(self):
        done = self.convert()
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertRegex(done.stdout, r"run.mcap: \d+ messages in 30.431 s\n$")
        self.assertIn("everything is as recorded", done.stderr)
        self.assertEqual(0o600, self.file("run.mcap").stat().st_mode & 0o777)
        self.assertRefused(self.convert(), "run.mcap: already exists; --force replaces it")
        self.assertEqual(0, self.convert("--force").returncode)

    def test_other_files_are_refused(self):
        recording = self.RECORDING.read_text(encoding="ascii")
        for text, words in [("", "no whole line of a recording"), (recording.replace("E+", "E-", 1), ":"),
                            (TABLE, ":1"), (recording.replace('"xr3_recording":1', '"xr3_recording":99', 1), ":1")]:
            with self.subTest(words):
                self.assertRefused(self.convert(recording=self.file("x.xr3rec", text)), f"{self.file('x.xr3rec')}", words)
                self.assertNothing()
        self.assertRefused(self.convert(recording=self.file("none.xr3rec")), "none.xr3rec: cannot be read")
        self.assertNothing()

    def test_every(self):
        for every in "0", "3600001", "fast":
            self.assertRefused(self.convert("--every", every), "--every", every)
        done = run_xr3("convert", SHIPPED[0], self.file("robot.txt"), "--every", "20")
        self.assertRefused(done, "robot.txt: --every is for a name that ends in .mcap")

    def test_a_disk_without_room(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
        self.assertRefused(self.convert(preexec_fn=limit), "run.mcap: cannot be written: File too large")
        self.assertNothing()


class PlainFiles(Files):
    """All commands that read robots and workcells also read the plain form."""

    def setUp(self):
        super().setUp()
        for kind in "robots", "workcells":
            self.assertDone(run_xr3("convert", DATA / kind / "rhino-xr3.json", self.file(f"{kind}.txt")))

    def run_here(self, *arguments):
        return run_xr3(*arguments, cwd=self.folder)

    def test_check_summarizes_plain_files(self):
        for kind in "robots", "workcells":
            done = self.run_here("check", "--robot", "robots.txt", f"{kind}.txt")
            self.assertDone(done)
            self.assertEqual(run_xr3("check", DATA / kind / "rhino-xr3.json").stdout, done.stdout)

    def test_check_reports_errors(self):
        plain = self.file("lab.txt", TABLE.replace("64 32 40", "64 -32 wide"))
        done = run_xr3("check", plain)
        self.assertRefused(done, f"{plain}:6: /blocks/0/size/1: found -32; allowed: a length above 0")
        self.assertEqual(run_xr3("convert", plain, self.file("lab.json")).stderr, done.stderr)

    def test_serve_reads_plain_files(self):
        robot, workcell = self.file("robots.txt"), self.file("workcells.txt")
        with Server("--robot", robot, "--workcell", workcell) as xr3, xr3.monitor() as monitor:
            self.assertEqual("Rhino XR-3", monitor.hello["robot"]["name"])
            plain = monitor.look("model")
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertEqual(monitor.look("model"), plain)

    def test_serve_reports_errors(self):
        plain = self.file("lab.dat", TABLE.replace("64 32 40", "64 -32 wide"))
        done = self.run_here("serve", "--workcell", "lab.dat")
        self.assertRefused(done, "lab.dat:6: /blocks/0/size/1: found -32; allowed: a length above 0")
        self.assertRefused(self.run_here("serve", "--robot", "workcells.txt"),
                           "workcells.txt:1: found a workcell; allowed: a robot")
        self.assertRefused(self.run_here("serve", "--workcell", "robots.txt"), "robots.txt:1: found a robot; allowed")

    def test_other_commands_read_plain_files(self):
        self.assertDone(self.run_here("kin", "--robot", "robots.txt", "--joints", "0,0,0,0,0"))
        self.assertDone(self.run_here("draw", "--robot", "robots.txt", "--workcell", "workcells.txt", "a.svg"))

    def test_a_file_of_the_current_folder_needs_no_slash(self):
        self.file("robots.txt").rename(self.file("arm"))
        self.assertDone(self.run_here("kin", "--robot", "arm", "--joints", "0,0,0,0,0"))
        self.file("rhino-xr3", "no robot")
        self.assertDone(self.run_here("kin", "--robot", "rhino-xr3", "--joints", "0,0,0,0,0"), "")
        self.assertRefused(self.run_here("kin", "--robot", "absent.txt"), "absent.txt: cannot be read")
        self.assertRefused(self.run_here("kin", "--robot", "absent"), "there is no robot named absent; use one of: adept-one")

    def test_a_json_name_with_plain_content(self):
        for text, words in [("", "x.json:1:"), ('"joints": [1]', "x.json:1:9: found"), ("]", "x.json:1:1: found")]:
            done = run_xr3("check", self.file("x.json", text))
            self.assertRefused(done, words)
            self.assertNotIn("axes", done.stderr)

    def test_a_byte_order_mark_is_ignored(self):
        plain = self.file("lab.txt", "\ufeff" + TABLE[TABLE.index("600"):])
        self.assertDone(run_xr3("check", plain), "1 block")
        self.assertDone(run_xr3("convert", plain, self.file("lab.json")))
        out = self.file("lab.json")
        out.write_text("\ufeff* a comment\n" + out.read_text())
        self.assertDone(run_xr3("check", out), "1 block")


if __name__ == "__main__":
    unittest.main()
