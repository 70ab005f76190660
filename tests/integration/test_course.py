"""docs/course: its first steps work as its page shows them, its figures are those that `xr3 draw` makes, its table of
points is that of the goals files, its exercises have all their parts, and the fastest one is judged as its sheet says
(`./test --course`: all)."""
# labels: full

import json
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

import course_runs
from support import DEADLINE_S, ROOT, XR3, run_xr3

COURSE = pathlib.Path(ROOT, "docs", "course")
EXERCISES = sorted(path for path in COURSE.iterdir() if path.is_dir())
FASTEST = "02-forward"
FENCE = re.compile(r"^ *```sh\n(.*?)^ *```", re.DOTALL | re.MULTILINE)
FIGURES = re.compile(r"<!-- figures: (.*?)-->", re.DOTALL)
FIGURE = re.compile(r"\(figures/([\w-]+\.svg)\)")


class Course(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_first_steps(self):
        """All commands of the page in one shell, with the solution in the place of the starter, and `./hello` in the place
        of `python3 hello.py`."""
        for name in "clients", "docs":
            (self.folder / name).symlink_to(pathlib.Path(ROOT, name))
        (self.folder / "build" / "release").mkdir(parents=True)
        (self.folder / "build" / "release" / "xr3").symlink_to(XR3)
        text = (COURSE / "01-hello" / "solution.c").read_text(encoding="utf-8")
        (self.folder / "hello.c").write_text(text, encoding="utf-8")
        commands = "".join(FENCE.findall((COURSE / "README.md").read_text(encoding="utf-8")))
        for part in "cp docs/course/01-hello/starter/hello.py .\n", "-- python3 hello.py\n":
            self.assertIn(part, commands)
        commands = commands.replace("starter/hello.py .", "solution.py hello.py")
        in_c = re.search(r"xr3 exec .*", commands)[0].replace("python3 hello.py", "./hello")
        done = subprocess.run(["bash", "-euc", f"unset PYTHONPATH\n{commands}\n{in_c}\n"], cwd=self.folder,
                              stdin=subprocess.DEVNULL, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
                              capture_output=True, text=True, timeout=DEADLINE_S, check=False)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        self.assertEqual(2, done.stdout.count("\nscore 9 of 9; "), done.stdout)

    def test_figures(self):
        for exercise in EXERCISES:
            page = (exercise / "README.md").read_text(encoding="utf-8")
            drawn = set()
            for command in FIGURES.search(page)[1].replace("\\\n", " ").strip().splitlines():
                _, _, *options, name = shlex.split(command)
                with self.subTest(exercise=exercise.name, figure=name):
                    done = run_xr3("draw", *options, self.folder / name, cwd=exercise)
                    self.assertEqual(0, done.returncode, done.stderr)
                    self.assertEqual((self.folder / name).read_text(encoding="utf-8"),
                                     (exercise / "figures" / name).read_text(encoding="utf-8"),
                                     f"in {exercise}, draw it again")
                drawn.add(name)
            self.assertEqual(drawn, set(FIGURE.findall(page)), exercise.name)
            self.assertEqual(drawn, {path.name for path in (exercise / "figures").iterdir()}, exercise.name)

    def test_table_of_points(self):
        points = []
        for exercise in EXERCISES:
            goals = json.loads((exercise / "goals.json").read_text(encoding="utf-8"))["goals"]
            points.append(sum(goal.get("points", 1) for goal in goals))
        page = (COURSE / "instructor.md").read_text(encoding="utf-8")
        shown = re.search(r"^\| points \| (.*) \|$", page, re.MULTILINE)[1].split(" | ")
        self.assertEqual([*points, sum(points)], [int(number) for number in shown])

    def test_files(self):
        files = sorted(COURSE.glob("*/*.json"))
        self.assertGreater(len(files), len(EXERCISES))
        done = run_xr3("check", *files)
        self.assertEqual((0, ""), (done.returncode, done.stderr))

    def test_every_exercise_has_its_parts(self):
        page = (COURSE / "README.md").read_text(encoding="utf-8")
        for exercise in EXERCISES:
            with self.subTest(exercise.name):
                self.assertIn(f"({exercise.name}/README.md)", page)
                sheet = (exercise / "README.md").read_text(encoding="utf-8")
                self.assertEqual(["Aim", "Theory", "Task", "Run it", "Hints", "Common mistakes"],
                                 re.findall(r"^## (.*)", sheet, re.MULTILINE))
                self.assertEqual(["--exercise", exercise.name], course_runs.options_of(exercise))
                self.assertEqual([course_runs.starter_of(exercise)], list((exercise / "starter").iterdir()))
                self.assertEqual(["c", "py"], sorted(path.suffix[1:] for path in exercise.glob("solution.*")))
                self.assertEqual(5, len(list((exercise / "wrong").iterdir())))

    def test_settings_of_every_exercise(self):
        """The title is that of the sheet, and each file is used."""
        for exercise in EXERCISES:
            with self.subTest(exercise.name):
                settings = json.loads((exercise / "exercise.json").read_text(encoding="utf-8"))
                sheet = (exercise / "README.md").read_text(encoding="utf-8")
                self.assertEqual(f"# {int(exercise.name[:2])}. {settings['title']}", sheet.splitlines()[0])
                used = {value for value in settings.values() if value.endswith(".json")} | {"exercise.json"}
                self.assertEqual(used, {path.name for path in exercise.glob("*.json")})

    def test_the_fastest_exercise(self):
        self.assertEqual([], list(course_runs.troubles_of(COURSE / FASTEST)))


if __name__ == "__main__":
    unittest.main()
