"""`xr3 check`: for every shipped file it prints a summary and exits with 0; for every broken file it prints
all findings, one per line, with file, line, JSON pointer, the found and the allowed value, and exits with 2."""

import pathlib
import tempfile
import unittest

from support import ROOT, run_xr3

DATA = pathlib.Path(ROOT, "data")
BROKEN_FOLDER = pathlib.Path(ROOT, "tests/data/broken")
BROKEN = sorted(BROKEN_FOLDER.glob("*.json"))
FINDING = r"\A[^:]+:\d+:(\d+:)?( warning:)?( /[^ :]*:)? (found .+|is missing); allowed: .+\Z"


def shipped(kind):
    return sorted((DATA / kind).glob("*.json"))


class Check(unittest.TestCase):
    def test_summaries_of_shipped_robots(self):
        for file, words in [
            ("rhino-xr3", ["Rhino XR-3", "260.4", "228.6", "168.3", "0.1135", "110", "160", "Hard home: F+30 E-40 D+40"]),
            ("adept-one", ["Adept One", "877", "425", "375", "200"]),
            ("intelledex-660", ["Intelledex 660", "373.4", "304.8", "228.6"]),
        ]:
            with self.subTest(file):
                done = run_xr3("check", DATA / "robots" / f"{file}.json")
                self.assertEqual((0, ""), (done.returncode, done.stderr))
                for word in words:
                    self.assertIn(word, done.stdout)
                self.assertLessEqual(max(map(len, done.stdout.splitlines())), 120)

    def test_all_shipped_files_at_once(self):
        files = shipped("robots") + shipped("workcells")
        self.assertGreaterEqual(len(files), 7)
        done = run_xr3("check", *files)
        self.assertEqual((0, ""), (done.returncode, done.stderr))

    def test_broken_files(self):
        """(tests/protocol/files has the findings.)"""
        self.assertGreaterEqual(len(BROKEN), 20)
        done = run_xr3("check", *BROKEN)
        self.assertEqual((2, ""), (done.returncode, done.stdout))
        named = set()
        for line in done.stderr.splitlines():
            named.add(pathlib.Path(line.partition(":")[0]))
            self.assertRegex(line, FINDING)
        self.assertEqual(set(BROKEN), named)

    def test_a_broken_file_among_good_ones(self):
        good = DATA / "robots" / "rhino-xr3.json"
        done = run_xr3("check", good, BROKEN[0], good)
        self.assertEqual(2, done.returncode)
        self.assertEqual(2, done.stdout.count("260.4") // run_xr3("check", good).stdout.count("260.4"))
        self.assertIn(str(BROKEN[0]), done.stderr)

    def test_serve_refuses_broken_files(self):
        for kind, other in ("robot", "workcell"), ("workcell", "robot"):
            with self.subTest(kind):
                file = BROKEN_FOLDER / f"{kind}-ranges.json"
                done = run_xr3("serve", "--robot-port", 0, "--monitor-port", 0, f"--{kind}", file, f"--{other}", "rhino-xr3")
                self.assertEqual((2, ""), (done.returncode, done.stdout))
                self.assertIn(file.name, done.stderr)

    def test_goals_that_need_no_program(self):
        passive, active = '{"kind":"no_stall"}', '{"kind":"order","events":["grasped red"]}'
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "goals.json")
            for goals, options, has_warning in (([passive], [], True), ([passive, active], [], False),
                                                (['{"kind":"tip","xyz_mm":[null,null,877]}'], ["--robot", "adept-one"], False)):
                file.write_text('{"notes":"-",\n "goals":[' + ",".join(goals) + "]}", encoding="utf-8")
                done = run_xr3("check", *options, file)
                self.assertEqual(0, done.returncode, done.stderr)
                if not has_warning:
                    self.assertEqual("", done.stderr)
                    continue
                self.assertIn(f"{file}:2: warning: /goals: found only goals that rhino-xr3 meets at rest, without a program", done.stderr)
                self.assertRegex(done.stderr.rstrip("\n"), FINDING)

    def test_exec_refuses_broken_goals(self):
        """With the findings of `check`, before the program starts."""
        file = BROKEN_FOLDER / "goal-ranges.json"
        done = run_xr3("exec", "--goals", file, "--", "echo", "started")
        self.assertEqual((2, ""), (done.returncode, done.stdout))
        self.assertTrue(done.stderr.endswith(run_xr3("check", file).stderr), done.stderr)


if __name__ == "__main__":
    unittest.main()
