"""The judge's verdicts on twenty programs, five of them wrong in five ways, and what it costs. Run by `./test --course`;
prints the times that it measures."""

import concurrent.futures
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
import unittest

from course_runs import COURSE, options_of
from support import GRADE, ROOT, XR3

CLIENTS = pathlib.Path(ROOT, "clients")
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(CLIENTS / "python")}
FIND = ["--goals", "find-and-pick"]
CAMERA_PROGRAM = [sys.executable, CLIENTS / "python/6_find_and_pick.py"]
STUDENTS = 200
AT_ONCE = 8  # programs
MOST_ADDED_MS, MOST_REPEATED_S, MOST_CLASS_S = 100, 100, 300

# Wrong programs: the fault, the kinds of goals that are missed or the outcome, and the message for the student.
WRONG = {
    "never_moves": ("""robot.ask("E?")""", {"block", "order"}, '"grasped red" did not happen'),
    "stalls": ("""
for _ in range(10):
    robot.send("D-60\\r")
    for _ in range(60):
        robot.ask("D?")""", {"block", "order", "no_stall"}, "the tool tip entered"),
    "drops_outside": ("""
red = robot.look().patches()[0]
robot.pick(xr3.Pose(red.x, red.y, 20, red.yaw))
robot.place(xr3.Pose(400, 0, 20, 0))""", {"block"}, "60.5 mm away"),
    "hangs": ("""import time; time.sleep(1000)""", "time_up", "the program still ran after 5 seconds (--max-seconds)"),
    "crashes": ("""import os, signal; os.kill(os.getpid(), signal.SIGSEGV)""", "failed", "signal 11 (Segmentation fault)"),
}


def judged(options, command, folder):
    """(exit code, report, what was printed) of a run."""
    result = pathlib.Path(tempfile.mkdtemp(dir=folder), "result.json")
    done = subprocess.run([XR3, "exec", *options, "--json", result, "--quiet", "--", *command], cwd=ROOT, env=ENVIRONMENT,
                          capture_output=True, text=True, check=False)
    return done.returncode, json.loads(result.read_text(encoding="utf-8")), done.stdout


def right_programs(folder):
    """(name, options of exec, command) of fifteen programs: one task in five languages, and ten tasks in Python."""
    for compiler, source, more in ("gcc", "c/6_find_and_pick.c", ["c/robot.c"]), ("g++", "cpp/6_find_and_pick.cpp", []):
        binary = pathlib.Path(folder, compiler)
        subprocess.run([compiler, "-o", binary, *(CLIENTS / each for each in [source, *more]), "-lm"], check=True)
        yield source, FIND, [binary]
    for interpreter, source in ("bash", "bash/6_find_and_pick.sh"), ("node", "javascript/6_find_and_pick.js"):
        yield source, FIND, [interpreter, CLIENTS / source]
    yield "python/6_find_and_pick.py", FIND, CAMERA_PROGRAM
    for exercise in sorted(path for path in COURSE.iterdir() if path.is_dir()):
        yield exercise.name, options_of(exercise), [sys.executable, exercise / "solution.py"]


class Verdicts(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def test_fifteen_right_programs_meet_all_goals(self):
        programs = list(right_programs(self.folder))
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            runs = [pool.submit(judged, options, command, self.folder) for _, options, command in programs]
            for (name, _, _), run in zip(programs, runs):
                code, report, printed = run.result()
                with self.subTest(name):
                    self.assertTrue(report["passed"], printed)
                    self.assertEqual(0, code)
        self.assertEqual(15, len(programs))

    def test_five_wrong_programs_miss_what_they_do_wrong_and_are_told(self):
        for name, (text, wanted, told) in WRONG.items():
            with self.subTest(name):
                program = pathlib.Path(self.folder, f"{name}.py")
                program.write_text(f"import xr3\nrobot = xr3.connect()\n{text}\nrobot.close()\n", encoding="utf-8")
                code, report, printed = judged([*FIND, "--max-seconds", "5"], [sys.executable, program], self.folder)
                self.assertFalse(report["passed"])
                self.assertIn(told, printed)
                if isinstance(wanted, str):
                    self.assertEqual((wanted, {"time_up": 7, "failed": 6}[wanted]), (report["outcome"], code))
                else:
                    self.assertEqual(("finished", 5), (report["outcome"], code), printed)
                    self.assertEqual(wanted, {goal["kind"] for goal in report["goals"] if not goal["met"]}, printed)


def median_ms(command, count=21):
    times = []
    for _ in range(count):
        before = time.perf_counter()
        subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
        times.append(1000 * (time.perf_counter() - before))
    return statistics.median(times)


class Costs(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def timed(self, *arguments):
        """(seconds, what was printed) of an xr3 command that succeeds."""
        before = time.monotonic()
        done = subprocess.run([XR3, *arguments], cwd=ROOT, env=ENVIRONMENT, capture_output=True, text=True, check=False)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        return time.monotonic() - before, done.stdout

    def test_a_run_adds_little_to_the_time_of_the_program(self):
        alone, judged_ms = median_ms(["true"]), median_ms([XR3, "exec", *FIND, "--", "true"])
        print(f"\nexec adds {judged_ms - alone:.1f} ms to a program (bound: {MOST_ADDED_MS})")
        self.assertLess(judged_ms - alone, MOST_ADDED_MS)

    def test_a_hundred_runs_of_the_camera_program(self):
        seconds, printed = self.timed("exec", *FIND, "--repeat", "100", "--quiet", "--", *CAMERA_PROGRAM)
        print(f"\n100 runs of the camera program: {seconds:.1f} s (bound: {MOST_REPEATED_S})")
        self.assertIn("100 of 100 runs passed", printed)
        self.assertLess(seconds, MOST_REPEATED_S)

    def test_a_class_of_two_hundred(self):
        """Three quarters hand in the solution, the others the five wrong programs of the sheet."""
        exercise = COURSE / "07-pick"
        wrong = sorted((exercise / "wrong").glob("*.py"))
        for student in range(STUDENTS):
            source = wrong[student // 4 % len(wrong)] if student % 4 == 3 else exercise / "solution.py"
            path = pathlib.Path(self.folder, "class", f"student{student:03}.py")
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(source.read_bytes())
        report = pathlib.Path(self.folder, "report")
        seconds, _ = self.timed(*GRADE, path.parent, "--exercise", exercise.name, "--report", report, "--",
                                sys.executable, "{}")
        print(f"\n{STUDENTS} submissions graded: {seconds:.1f} s (bound: {MOST_CLASS_S})")
        with open(report / "grades.csv", encoding="utf-8-sig") as file:
            rows = list(csv.DictReader(file))
        passed = [row for row in rows if row["points"] == row["max_points"]]
        self.assertEqual((STUDENTS, STUDENTS * 3 // 4), (len(rows), len(passed)))
        for row in rows:
            self.assertTrue((report / row["submission"] / "recording.xr3rec").stat().st_size)
        self.assertLess(seconds, MOST_CLASS_S)


if __name__ == "__main__":
    unittest.main(verbosity=2)
