"""Exercises as folders: `--exercise` of `xr3 exec` and `xr3 grade` with a name, a folder and a zip archive, and
`xr3 exercise check`, which says of an exercise that is wrong what is wrong with it."""

import json
import os
import pathlib
import shutil
import stat
import tempfile
import unittest
import zipfile

from support import ROOT, run_xr3

MOVE = """import os, socket
line = socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"])))
line.sendall(b"{}\\r")
line.shutdown(socket.SHUT_WR)
while line.recv(100):
    pass
"""
GOALS = {"goals": [{"kind": "joint", "label": "F", "count": 40, "points": 3}, {"kind": "no_stall"}]}
EXERCISE = {"title": "Turn the base", "clock": "bytes:200", "goals": "goals.json"}


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.environment = {**os.environ, "PYTHONPATH": os.path.join(ROOT, "clients/python")}
        self.write("turn/exercise.json", json.dumps(EXERCISE))
        self.write("turn/goals.json", json.dumps(GOALS))
        self.write("turn/solution.py", MOVE.format("F+40"))
        self.write("turn/starter/turn.py", "# Turn the base.\n")
        self.write("turn/wrong/other_way.py", "# expects: joint: -40\n" + MOVE.format("F-40"))

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def run_here(self, *arguments, code=0):
        done = run_xr3(*arguments, cwd=self.folder, env=self.environment)
        self.assertEqual(code, done.returncode, done.stdout + done.stderr)
        return done

    def judge(self, exercise, code=0):
        return self.run_here("exec", "--exercise", exercise, "--", "python3", "turn/solution.py", code=code)


class Exec(Folder):
    def test_a_folder(self):
        for name in "turn", "./turn", self.folder / "turn":
            self.assertIn("score 4 of 4", self.judge(name).stdout)

    def test_an_exercise_of_the_course(self):
        solution = pathlib.Path(ROOT, "docs/course/09-find-and-stack/solution.py")
        done = self.run_here("exec", "--exercise", "09-find-and-stack", "--json", "r.json", "--", "python3", solution)
        self.assertIn("score 19 of 19", done.stdout)
        self.assertEqual(7, json.loads((self.folder / "r.json").read_text(encoding="utf-8"))["seed"])
        done = self.run_here("exec", "--exercise", "09-find-and-stack", "--vary", "8", "--json", "r.json", "--",
                             "python3", solution)
        self.assertEqual(8, json.loads((self.folder / "r.json").read_text(encoding="utf-8"))["seed"])

    def test_it_stands_for_the_options_that_say_the_same(self):
        for option in ("--robot", "adept-one"), ("--clock", "real"), ("--goals", "turn/goals.json"):
            done = self.run_here("exec", "--exercise", "turn", *option, "--", "true", code=2)
            self.assertIn("--exercise", done.stderr)
            self.assertIn(option[0], done.stderr)

    def test_what_is_not_there(self):
        self.assertIn("there is no exercise named turm; use one of: 01-hello, ", self.judge("turm", code=2).stderr)
        self.assertIn("./turm: there is no such folder or archive", self.judge("./turm", code=2).stderr)
        (self.folder / "empty").mkdir()
        self.assertIn("empty: there is no exercise.json in it", self.judge("empty", code=2).stderr)
        self.write("turn/exercise.json", json.dumps({**EXERCISE, "goals": "goal.json"}))
        self.assertIn("turn/goal.json: cannot be read", self.judge("turn", code=2).stderr)

    def test_a_clock_and_a_variation_that_are_none(self):
        for member, value in ("clock", "byte"), ("vary", "seven"):
            self.write("turn/exercise.json", json.dumps({**EXERCISE, member: value}))
            self.assertIn(f"turn/exercise.json: /{member}: {value}: a ", self.judge("turn", code=2).stderr)

    def test_runs_of_an_exercise_that_varies_may_differ(self):
        self.write("turn/exercise.json", json.dumps({**EXERCISE, "vary": "7"}))
        look = MOVE.format("F+40").replace("line.sendall", "import random\nline.sendall").replace('b"F+40', 'b"F?" * random.randint(1, 90) + b"F+40')
        program = self.write("look.py", look)
        self.run_here("exec", "--exercise", "turn", "--repeat", "3", "--", "python3", program)

    def test_grade(self):
        self.write("class/ada.py", MOVE.format("F+40"))
        self.write("class/bob.py", "")
        done = self.run_here("grade", "class", "--exercise", "turn", "--no-sandbox", "--report", "report", "--", "python3", "{}")
        self.assertRegex(done.stdout, r"ada.py +4/4")
        self.assertRegex(done.stdout, r"bob.py +0/4")
        done = self.run_here("grade", "class", "--report", "other", "--", "python3", "{}", code=2)
        self.assertIn("--goals or --exercise", done.stderr)


class Zip(Folder):
    def zip(self, files, name="turn.zip"):
        with zipfile.ZipFile(self.folder / name, "w", zipfile.ZIP_DEFLATED) as archive:
            for path, text in files.items():
                archive.writestr(path, text)
        return name

    def files(self, prefix=""):
        return {prefix + str(path.relative_to(self.folder / "turn")): path.read_text(encoding="utf-8")
                for path in (self.folder / "turn").rglob("*") if path.is_file()}

    def refused(self, words, files):
        own = tempfile.TemporaryDirectory()
        self.addCleanup(own.cleanup)
        self.environment["TMPDIR"] = own.name
        done = self.judge(self.zip(files), code=2)
        self.assertIn(words, done.stderr)
        self.assertEqual([], os.listdir(own.name))

    def test_its_files_or_one_folder(self):
        self.assertIn("score 4 of 4", self.judge(self.zip(self.files())).stdout)
        self.assertIn("score 4 of 4", self.judge(self.zip(self.files("turn/"))).stdout)
        self.assertIn("✓ solution.py", self.run_here("exercise", "check", "turn.zip").stdout)

    def test_names_that_lead_out(self):
        for name in "../out.json", "/tmp/xr3-out.json", "a/../../out.json", "a\\..\\out.json":
            self.refused("leads out of the folder", {**self.files(), name: "{}"})
        self.assertFalse((self.folder / "out.json").exists())

    def test_a_link_becomes_a_file(self):
        link = zipfile.ZipInfo("goals.json")
        link.external_attr = (stat.S_IFLNK | 0o777) << 16
        files = self.files()
        del files["goals.json"]
        self.write("goals.json", json.dumps(GOALS))
        name = self.zip(files)
        with zipfile.ZipFile(self.folder / name, "a") as archive:
            archive.writestr(link, str(self.folder / "goals.json"))
        self.assertIn("goals.json:1:", self.judge(name, code=2).stderr)

    def test_too_large(self):
        self.refused("has more than 64 MiB", {"zeros": b"\0" * (65 << 20)})
        self.refused("has more than 1000 files", {str(number): "" for number in range(1001)})

    def test_damaged(self):
        name = self.zip(self.files())
        path = self.folder / name
        data = bytearray(path.read_bytes())
        self.write("text.zip", "no zip")
        self.assertIn("text.zip: is no zip archive", self.judge("text.zip", code=2).stderr)
        for at in range(30, len(data), 97):
            path.write_bytes(data[:at] + bytes([data[at] ^ 0x55]) + data[at + 1:])
            self.assertIn(run_xr3("exec", "--exercise", name, "--", "true", cwd=self.folder).returncode, (2, 5), at)
        path.write_bytes(data[:len(data) // 2])
        self.assertIn("is no zip archive", self.judge(name, code=2).stderr)


class Check(Folder):
    def check(self, code=0):
        return self.run_here("exercise", "check", "turn", code=code).stdout

    def test_a_good_exercise(self):
        self.assertEqual(["✓ solution.py", "✓ a program that does nothing", "✓ starter/turn.py", "✓ wrong/other_way.py"],
                         [line for line in self.check().splitlines() if not line.startswith(" ")])

    def test_what_the_judge_says_of_a_wrong_program_is_shown(self):
        self.assertIn("    ✗ joint F at 40 counts", self.check())

    def test_a_solution_that_fails(self):
        self.write("turn/solution.py", MOVE.format("F+41"))
        said = self.check(code=2)
        self.assertIn("✗ solution.py: it does not meet all goals\n", said)
        self.assertIn("41", said)

    def test_a_solution_of_each_seed(self):
        self.write("turn/exercise.json", json.dumps({**EXERCISE, "vary": "7"}))
        self.assertEqual(5, self.check().count("✓ solution.py, run "))
        self.assertEqual(2, self.run_here("exercise", "check", "turn", "--seeds", "2").stdout.count("✓ solution.py, run "))

    def test_no_solution(self):
        (self.folder / "turn/solution.py").unlink()
        done = self.run_here("exercise", "check", "turn", code=2)
        self.assertIn("turn: there is no solution", done.stderr)

    def test_goals_that_need_no_program(self):
        self.write("turn/goals.json", json.dumps({"goals": [{"kind": "no_stall"}]}))
        self.write("turn/starter/turn.py", MOVE.format("F+1"))
        self.assertIn("✗ starter/turn.py: it gets 1 points", self.check(code=2))

    def test_a_wrong_program_that_passes(self):
        self.write("turn/wrong/other_way.py", "# expects: joint: -40\n" + MOVE.format("F+40"))
        self.assertIn("✗ wrong/other_way.py: the judge does not find, as its first line states, joint: -40\n", self.check(code=2))

    def test_a_wrong_program_that_fails(self):
        self.write("turn/wrong/broken.py", "# expects: failed\n1 / 0\n")
        self.assertIn("✓ wrong/broken.py\n", self.check())

    def test_a_wrong_program_without_a_statement(self):
        self.write("turn/wrong/other_way.py", MOVE.format("F-40"))
        done = self.run_here("exercise", "check", "turn", code=2)
        self.assertIn("wrong/other_way.py:1: the first line does not say what the judge must find", done.stderr)

    def test_languages(self):
        shutil.copy(pathlib.Path(ROOT, "docs/course/robot.h"), self.folder)
        self.write("turn/solution.c", '#include "robot.h"\nint main(void) { return 0; }\n')
        self.write("turn/wrong/shell.sh", "# expects: joint: 0\ntrue\n")
        said = self.check(code=2)
        self.assertIn("✗ solution.c: it does not meet all goals\n", said, "it was compiled")
        self.assertIn("✓ wrong/shell.sh\n", said)
        self.write("turn/solution.rb", "")
        self.assertIn("solution.rb: is not executable, and its name does not end in one of .c, ",
                      self.run_here("exercise", "check", "turn", code=2).stderr)


if __name__ == "__main__":
    unittest.main()
