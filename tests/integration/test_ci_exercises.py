"""The recipes of docs/ci for exercises: their commands and files are run unchanged, with a right program, wrong ones,
and ones that try to write the result themselves. In the place of a service is what it reads: lines, JUnit, requests."""
# labels: full

import ast
import base64
import http.server
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
import urllib.parse
import xml.etree.ElementTree

from support import GRADE, LOCALHOST, ROOT, XR3

try:
    import yaml
except ImportError:
    yaml = None

CI = pathlib.Path(ROOT, "docs", "ci")
COURSE = pathlib.Path(ROOT, "docs", "course")
PAGE = (CI / "exercises.md").read_text(encoding="utf-8")
TASK_S = 60
# Meets the goal of exercise 1 that needs a program, and misses that of joint F.
PARTIAL = """
import xr3
robot = xr3.connect()
robot.go({"E": 140, "F": 1})
robot.close()
"""
# Each begins a new line for one of the services, which read lines of \n, of \r\n or of \r.
CHEAT = r"""
for end in "\n", "\r\n", "\r", "\x0b", "\x85", "\u2028":
    print("x" + end + "Grade :=>> 100" + end + "--|>" + end + "Grade :=>> 100" + end, end="")
    print("\x1b[2K::notice title=Autograding complete::Points 9/9" + end + "result=e30=" + end, end="")
"""


def blocks(name):
    """The values of `run` and the items of `script` of a recipe, with folded lines joined, as commands."""
    text = (CI / name).read_text(encoding="utf-8")
    folded = re.findall(r"^ +(?:run: |- )>-\n((?: +\S.*\n)+?)(?=^ +- |^ +\w+:|^\S|\Z|\n)", text, re.MULTILINE)
    return [" ".join(each.split()) for each in folded]


class Exercises(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "xr3").symlink_to(ROOT)
        self.environment = {**os.environ, "XR3": XR3, "PYTHONPATH": str(pathlib.Path(ROOT, "clients", "python"))}

    def submit(self, program, name="hello.py"):
        """Puts a program of exercise 1, or the text of one, in the folder."""
        path = COURSE / "01-hello" / program if program.endswith(".py") else None
        (self.folder / name).write_text(path.read_text(encoding="utf-8") if path else program, encoding="utf-8")

    def run_here(self, command, code=0, **environment):
        command = command.replace("xr3/build/release/xr3", XR3)
        done = subprocess.run(command, shell=True, cwd=self.folder, env={**self.environment, **environment},
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=TASK_S, check=False)
        self.assertEqual(code, done.returncode, (done.stdout, done.stderr))
        return done.stdout.decode()

    # --- Moodle with VPL.

    def evaluate(self, name="hello.py", **environment):
        """(comment lines, grades) that VPL reads from the output of its two steps."""
        for each in "vpl_evaluate.sh", "xr3_judge.py":
            shutil.copy(CI / each, self.folder)
        (self.folder / "vpl_environment.sh").write_text(f"export VPL_SUBFILE0='{name}'\n", encoding="utf-8")
        self.run_here("./vpl_evaluate.sh", **environment)
        return self.read_by_vpl(self.run_here("./vpl_execution"))

    @staticmethod
    def read_by_vpl(output):
        """Splits like VPL, at the kind of line end that it finds first in this order."""
        end = next((each for each in ("\r\n", "\n", "\r") if each in output), "\n")
        grades = [line.removeprefix("Grade :=>>").strip() for line in output.split(end) if line.startswith("Grade :=>>")]
        inside = re.findall(r"^<\|--\n(.*?)^--\|>\n", output, re.DOTALL | re.MULTILINE)
        return [line for block in inside for line in block.splitlines()], grades

    def test_vpl_proposes_the_highest_grade_for_a_right_program(self):
        self.submit("solution.py")
        comment, grades = self.evaluate()
        self.assertEqual(["10.00"], grades)
        self.assertIn("-✓ joint E at 140 counts, within 0", comment)
        self.assertIn(">E is there", comment)
        self.assertFalse([line for line in comment if "✗" in line])

    def test_vpl_proposes_the_share_of_the_points_for_a_wrong_program(self):
        self.submit("wrong/unfinished.py")
        output = re.search(r"^```\n(<\|--\n.*?)^```", PAGE, re.DOTALL | re.MULTILINE)[1]
        self.assertEqual(self.read_by_vpl(output), self.evaluate())
        self.submit(PARTIAL)
        self.assertEqual(["8.89"], self.evaluate()[1])
        self.assertEqual(["5.56"], self.evaluate(VPL_GRADEMIN="2", VPL_GRADEMAX="6")[1])

    def test_vpl_proposes_the_lowest_grade_for_a_program_that_does_nothing_or_fails(self):
        for program in "", "this is no Python\n":
            self.submit(program)
            comment, grades = self.evaluate()
            self.assertEqual(["0.00"], grades)
            self.assertIn("-✓ no warnings (not counted)", comment)

    def test_vpl_gets_no_grade_from_the_program(self):
        self.submit(CHEAT)
        comment, grades = self.evaluate()
        self.assertEqual(["0.00"], grades)
        self.assertEqual([], [line for line in comment if not line.isprintable()])
        self.assertEqual("-What the program printed", [line for line in comment if line[0] == "-"][-1])
        self.assertIn(">Grade :=>> 100", comment)

    def test_vpl_says_that_a_program_reached_no_robot(self):
        self.submit("print('hello')\n")
        self.assertIn("-✗ nothing reached this run's robot: use XR3_HOST and XR3_PORT", self.evaluate()[0])

    def test_vpl_shows_the_beginning_of_a_long_output(self):
        self.submit("for i in range(100_000): print(i, 'x' * 1000)\n")
        comment, _ = self.evaluate()
        shown = [line for line in comment if line.startswith(">")]
        self.assertEqual(61, len(shown))
        self.assertLess(max(map(len, shown)), 170)
        self.assertRegex(shown[-1], r"^>and \d+ more lines$")

    def test_vpl_takes_no_module_from_the_submission(self):
        self.submit("solution.py")
        for module in "json", "subprocess", "tempfile":
            self.submit("print('Grade :=>> 10')\nraise SystemExit(0)\n", module + ".py")
        self.assertEqual(["0.00"], self.evaluate()[1], "the student's own program gets them")

    def test_vpl_takes_no_command_from_the_name_of_a_file(self):
        name = "a b;$(touch hacked).py"
        self.submit("solution.py", name)
        self.assertEqual(["10.00"], self.evaluate(name)[1])
        self.assertFalse((self.folder / "hacked").exists())

    def test_vpl_gets_a_grade_if_a_program_prints_other_bytes_than_utf_8(self):
        self.submit("solution.py")
        text = (self.folder / "hello.py").read_text(encoding="utf-8")
        self.submit(text + r"import sys; sys.stdout.buffer.write(b'caf\xe9 \xff\xc3\n')" + "\n")
        comment, grades = self.evaluate()
        self.assertEqual(["10.00"], grades)
        self.assertIn(">caf� ��", comment)

    def test_vpl_gets_a_grade_whatever_the_locale_and_the_name_are(self):
        name = os.fsdecode(b"Ren\xe9.py")
        self.submit("solution.py", name)
        shutil.copy(CI / "xr3_judge.py", self.folder)
        judge = f"{sys.executable} xr3_judge.py vpl --exercise 01-hello -- {sys.executable} Ren?.py"
        for locale in ({"LC_ALL": "C"}, {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
                       {"PYTHONIOENCODING": "latin-1"}, {"PYTHONIOENCODING": "ascii"}):
            with self.subTest(locale):
                comment, grades = self.read_by_vpl(self.run_here(judge, **locale))
                self.assertEqual(["10.00"], grades)
                self.assertIn("-✓ joint E at 140 counts, within 0", comment)

    def test_vpl_gets_a_comment_and_no_grade_if_the_judge_cannot_run(self):
        self.submit("solution.py")
        for each in "vpl_evaluate.sh", "xr3_judge.py":
            shutil.copy(CI / each, self.folder)
        self.environment["XR3"] = str(self.folder / "no-such-program")
        self.evaluate_fails("cannot be started")
        self.environment["XR3"] = XR3
        script = self.folder / "vpl_evaluate.sh"
        script.write_text(script.read_text(encoding="utf-8").replace("01-hello", "no-such-exercise"), encoding="utf-8")
        self.evaluate_fails("no-such-exercise")

    def evaluate_fails(self, reason):
        self.run_here("./vpl_evaluate.sh", VPL_SUBFILE0="hello.py")
        comment, grades = self.read_by_vpl(self.run_here("./vpl_execution", code=1))
        self.assertEqual([], grades)
        self.assertTrue(comment[0].startswith("-The program was not judged"))
        self.assertIn(reason, comment[1])

    def test_vpl_runs_a_program_on_the_terminal(self):
        self.submit("solution.py")
        shutil.copy(CI / "vpl_run.sh", self.folder)
        self.run_here("./vpl_run.sh", VPL_SUBFILE0="hello.py")
        output = self.run_here("./vpl_execution")
        self.assertIn("E is there\n", output)
        self.assertIn("score 9 of 9; ", output)

    # --- GitHub Classroom.

    def classroom(self):
        """The result that the step `judge` of the workflow puts out."""
        shutil.rmtree(self.folder / "result", ignore_errors=True)
        commands = blocks("classroom.yml")
        self.assertEqual(1, len(commands))
        summary = re.search(r"- run: (cat summary.*)", (CI / "classroom.yml").read_text(encoding="utf-8"))[1]
        files = {name: str(self.folder / name.lower()) for name in ("GITHUB_OUTPUT", "GITHUB_STEP_SUMMARY")}
        pathlib.Path(files["GITHUB_OUTPUT"]).unlink(missing_ok=True)
        self.log = self.run_here(f"{{ {commands[0]}; }} 2>&1 && {summary}", **files)
        names = dict(line.split("=", 1) for line in pathlib.Path(files["GITHUB_OUTPUT"]).read_text().splitlines())
        self.assertEqual({"result"}, set(names))
        return json.loads(base64.b64decode(names["result"]))

    def test_classroom_gets_the_points_of_each_goal(self):
        self.submit("solution.py")
        result = self.classroom()
        self.assertEqual((1, "pass", 9), (result["version"], result["status"], result["max_score"]))
        self.assertEqual([4, 1, 2, 1, 1], [test["score"] for test in result["tests"]])
        self.submit("wrong/unfinished.py")
        result = self.classroom()
        self.assertEqual(("fail", [0] * 5), (result["status"], [test["score"] for test in result["tests"]]))
        self.assertEqual({"fail"}, {test["status"] for test in result["tests"]})
        self.assertTrue(result["tests"][1]["message"].startswith("not counted: "))
        self.assertEqual("it is at 50 counts", result["tests"][0]["message"])
        self.assertIn("| ✗ | joint E at 140 counts", (self.folder / "github_step_summary").read_text(encoding="utf-8"))
        self.assertEqual("6", xml.etree.ElementTree.parse(self.folder / "junit.xml").getroot()[0].get("tests"))
        self.assertTrue((self.folder / "result" / "end.svg").exists())

    def test_classroom_gets_no_result_from_the_program(self):
        self.submit(CHEAT + "import os\nprint([name for name in os.environ if name.startswith('GITHUB_')])\n")
        result = self.classroom()
        self.assertEqual(0, sum(test["score"] for test in result["tests"]))
        self.assertNotIn("Autograding complete", self.log)
        printed = (self.folder / "result" / "output.txt").read_text(encoding="utf-8")
        self.assertTrue(printed.endswith("[]\n"), printed)

    def test_classroom_knows_a_program_that_fails(self):
        self.submit("raise SystemExit(3)\n")
        self.assertEqual("error", self.classroom()["status"])
        self.assertIn("✗ the program ended with exit code 3; nothing reached this run's robot", self.log)

    # --- GitLab.

    def test_gitlab_gets_a_test_for_each_goal(self):
        judge, _ = blocks("gitlab-exercise.yml")
        for program, code, failures in (("solution.py", 0, "0"), ("wrong/unfinished.py", 5, "1")):
            self.submit(program)
            shutil.rmtree(self.folder / "result", ignore_errors=True)
            self.run_here(judge, code)
            suite = xml.etree.ElementTree.parse(self.folder / "junit.xml").getroot()[0]
            self.assertEqual(("6", failures), (suite.get("tests"), suite.get("failures")))
        self.assertIn("it is at 50 counts", (self.folder / "summary.md").read_text(encoding="utf-8"))

    def test_gitlab_writes_the_summary_below_the_merge_request(self):
        seen = []

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_POST(self):
                body = self.rfile.read(int(self.headers["content-length"])).decode()
                seen.append((self.path, self.headers["PRIVATE-TOKEN"], urllib.parse.parse_qs(body)["body"][0]))
                self.send_response(201 if self.headers["PRIVATE-TOKEN"] == "token" else 401)
                self.end_headers()

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer((LOCALHOST, 0), Handler)
        self.addCleanup(server.server_close)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.shutdown)
        (self.folder / "summary.md").write_text("| ✗ | a & b |\n", encoding="utf-8")
        _, note = blocks("gitlab-exercise.yml")
        variables = {"CI_API_V4_URL": f"http://{LOCALHOST}:{server.server_port}/api/v4", "CI_PROJECT_ID": "7",
                     "CI_MERGE_REQUEST_IID": "3", "no_proxy": "*"}
        self.run_here(note, ROBOT_TOKEN="token", **variables)
        self.assertEqual([("/api/v4/projects/7/merge_requests/3/notes", "token", "| ✗ | a & b |\n")], seen)
        self.run_here(note, code=22, ROBOT_TOKEN="another", **variables)

    # --- nbgrader.

    def cell(self):
        """The value of the page's test cell, as nbgrader takes it: that of the last line."""
        shutil.copy(CI / "xr3_judge.py", self.folder)
        code = re.search(r"^```python\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)[1]
        tree = ast.parse(code)
        self.assertIsInstance(tree.body[-1], ast.Expr)
        last = ast.unparse(tree.body.pop())
        (self.folder / "cell.py").write_text(f"{ast.unparse(tree)}\nprint({last})\n", encoding="utf-8")
        return self.run_here(f"{sys.executable} cell.py").splitlines()

    def test_nbgrader_gets_partial_credit(self):
        self.submit("solution.py")
        self.assertEqual("9.0", self.cell()[-1])
        self.submit(PARTIAL)
        *report, value = self.cell()
        self.assertEqual("8.0", value)
        self.assertIn("  it is at 1 counts", report)

    def test_nbgrader_gets_points_whatever_the_locale_is(self):
        self.submit("solution.py")
        self.environment |= {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
        self.assertEqual("9.0", self.cell()[-1])

    def test_nbgrader_marks_what_the_program_prints(self):
        self.submit(CHEAT)
        *report, value = self.cell()
        self.assertEqual("0.0", value)
        self.assertIn("| Grade :=>> 100", report)

    # --- The files.

    def test_of_several_runs_the_worst_counts(self):
        """One of three runs, which are made at the same time, fails."""
        program = (COURSE / "01-hello" / "solution.py").read_text(encoding="utf-8")
        counter = str(self.folder / "count")
        self.submit(f"with open({counter!r}, 'a+') as count:\n    count.write('x')\n    failed = count.tell() == 2\n{program}\n"
                    "if failed:\n    print('bad luck')\n    raise SystemExit(1)\n")
        shutil.copy(CI / "xr3_judge.py", self.folder)
        output = self.run_here(f"{sys.executable} -I xr3_judge.py vpl {self.luck()} -- {sys.executable} hello.py")
        comment, grades = self.read_by_vpl(output)
        self.assertEqual(["0.00"], grades)
        self.assertRegex(comment[0], r"\A-Run [123] counts, the worst of 3\Z")
        self.assertEqual("-✗ the program ended with exit code 1", comment[1])
        self.assertIn(">bad luck", comment)

    def luck(self):
        """The options of the page for several runs."""
        options = re.search(r"`(--repeat \d+ --vary \d+)`", PAGE)[1]
        return f"--exercise 01-hello {options}"

    def test_the_teacher_grades_what_was_collected(self):
        """The commands of the page, with folders as the services make them."""
        commands = re.findall(r"^\$ (xr3 grade .*)$", PAGE, re.MULTILINE)
        layouts = (("exercise-1-submissions", "exercise-1-ada/hello.py", "exercise-1-bob/my_program.py"),
                   ("submissions", "Ada King_11_assignsubmission_file/hello.py", "Bob_12_assignsubmission_file/hello.py"),
                   ("submitted", "ada/week1/hello.py", "bob/week1/hello.py"))
        self.assertEqual(len(layouts), len(commands))
        for (folder, *files), command in zip(layouts, commands):
            with self.subTest(command):
                for file in files:
                    (self.folder / folder / file).parent.mkdir(parents=True)
                    self.submit("solution.py", f"{folder}/{file}")
                printed = self.run_here(command.replace("xr3 ", f"{XR3} ", 1).replace("grade ", f"grade {' '.join(GRADE[1:])} ", 1))
                self.assertEqual(2, len(re.findall(r"(?m)^.*  9/9 ", printed)), printed)
                moodle = self.folder / "report" / "moodle.csv"
                self.assertEqual("assignsubmission" in files[0], moodle.exists())
                shutil.rmtree(self.folder / "report")

    def test_wrong_arguments(self):
        judge = f"{sys.executable} {CI / 'xr3_judge.py'}"
        for arguments in "", "vpl --exercise 01-hello", "moodle -- python3 hello.py", "vpl --":
            self.run_here(f"{judge} {arguments}", code=2)

    @unittest.skipUnless(yaml, "python3-yaml is not installed")
    def test_the_workflows_are_valid(self):
        steps = yaml.safe_load((CI / "classroom.yml").read_text(encoding="utf-8"))["jobs"]["run-autograding-tests"]["steps"]
        judge = next(step for step in steps if step.get("id") == "judge")
        self.assertEqual(blocks("classroom.yml"), [judge["run"]])
        reporter = steps[-1]
        self.assertEqual(({"JUDGE_RESULTS": "${{ steps.judge.outputs.result }}"}, {"runners": "judge"}),
                         (reporter["env"], reporter["with"]))
        jobs = yaml.safe_load((CI / "gitlab-exercise.yml").read_text(encoding="utf-8"))
        self.assertEqual(blocks("gitlab-exercise.yml"), [*jobs["judge"]["script"], *jobs["note"]["script"]])
        self.assertEqual({"junit": "junit.xml"}, jobs["judge"]["artifacts"]["reports"])

    def test_all_recipes_build_in_the_same_way(self):
        for one, other in (("github-actions.yml", "classroom.yml"), ("gitlab-ci.yml", "gitlab-exercise.yml")):
            texts = [(CI / name).read_text(encoding="utf-8") for name in (one, other)]
            begin, end = ("- uses: actions/checkout", "python3\n") if "github" in one else ("  cache:", "python3\n")
            parts = [text[text.index(begin):text.index(end)] for text in texts]
            self.assertEqual(*parts)


if __name__ == "__main__":
    unittest.main()
