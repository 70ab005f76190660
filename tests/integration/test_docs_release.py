"""Runs the commands that README.md and docs/ show, with the ports and paths of a test. test_tutorial.py and
test_troubleshooting.py run those of docs/tutorial and of docs/troubleshooting.md."""

import concurrent.futures
import csv
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import unittest

from pages import has_a_reader, is_command, write_files
from support import DEADLINE_S, GRADE, ROOT, XR3, Server, run_xr3

RUNS = 8  # number at the same time; their programs pause most of the time
JUDGE_S = 120.0
FENCE = re.compile(r"^ *```.*?\n(.*?)^ *```", re.DOTALL | re.MULTILINE)
XR3_COMMAND = re.compile(r"(?:\$ )?((?:XR3_\w+=\S+ )*)(?:build/release/)?xr3 (.+)")
CLIENT_COMMAND = re.compile(r"(?:\$ )?(?:nc|curl|printf|echo) .*localhost")
# The commands in fences that other tests run: the file and the beginning of the line, and the test.
ELSEWHERE = {
    "exec.md: cc ": "test_exec.py",
    "frameworks.md: cmake ": "test_frameworks.py",
    "frameworks.md: cp ": "test_frameworks.py",
    "frameworks.md: ctest ": "test_frameworks.py",
    "frameworks.md: java ": "test_frameworks.py",
    "frameworks.md: javac ": "test_frameworks.py",
    "frameworks.md: node ": "test_frameworks.py",
    "README.md: cc ": "test_course.py",
    "README.md: cp ": "test_course.py",
    "README.md: ./run": "test_run.py",
    "README.md: ./test": "test_inline_commands_release.py",
    "README.md: $ telnet": "test_readme.py",
    "README.md: xr3/": "test_ci_recipes.py",
    "instructor.md: cp ": "test_own_exercise.py",
    "operations.md: ./run --build": "test_operations.py",
    "operations.md: sudo ": "test_operations.py",
    "operations.md: head -c": "test_operations.py",
    "operations.md: scripts/capacity": "test_operations.py",
    "packages.md: python3 -m venv": "../packages/test_wheel.py",
    "packages.md: sudo apt install": "../packages/test_packages.py",
    "packages.md: sudo systemctl": "test_operations.py",
    "packages.md: tar ": "../packages/test_packages.py",
    "playground.md: python3 -m": "../play/page_test.mjs",
    "playground.md: scripts/playground": "../play/page_test.mjs",
    "protocol.md: $ ./run": "test_run.py",
    "protocol.md: $ telnet": "test_clients.py",
    "serial-ports.md: socat": "../lines/test_socat.py",
}
# Folders of submissions as services make them: test_ci_exercises.py
COLLECTED = {("exercises.md", folder) for folder in ("exercise-1-submissions", "submissions", "submitted")}
BEHIND = re.compile(r"(\s+#.*|\s{2,}\S.*)$")  # a comment after a command


def shown_lines():
    """(file, line) of every line in a code fence; lines that end in \\ are joined with the next one."""
    for path in [pathlib.Path(ROOT, "README.md"), *sorted(pathlib.Path(ROOT, "docs").rglob("*.md"))]:
        if has_a_reader(path):
            continue
        for block in FENCE.findall(path.read_text(encoding="utf-8")):
            for line in re.sub(r" *\\\n *", " ", block).splitlines():
                yield path.name, line.strip()


def xr3_commands():
    for name, line in shown_lines():
        match = XR3_COMMAND.match(line)
        if match:
            variables = dict(word.split("=", 1) for word in match[1].split())
            yield name, variables, shlex.split(BEHIND.sub("", match[2]))


def client_commands():
    for name, line in shown_lines():
        if CLIENT_COMMAND.match(line):
            yield name, BEHIND.sub("", line.removeprefix("$ "))


class Docs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        write_files(self.folder)

    def serve(self, arguments, variables):
        command = [XR3, "serve", *arguments, "--robot-port", "0", "--monitor-port", "0"]
        with subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, env={**os.environ, **variables}) as process:
            greeting = process.stdout.readline()
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=DEADLINE_S)
        self.assertRegex(greeting, "^LISTENING ")
        self.assertEqual(0, process.returncode)

    def test_every_command_is_run(self):
        commands = [f"{name}: {line}" for name, line in shown_lines()
                    if not XR3_COMMAND.match(line) and not CLIENT_COMMAND.match(line)
                    and (line.startswith("$ ") or is_command(line))]
        for command in commands:
            self.assertTrue(command.startswith(tuple(ELSEWHERE)),
                            f"{command}: run it here, or name its test in ELSEWHERE")
        for beginning, test in ELSEWHERE.items():
            self.assertTrue(pathlib.Path(ROOT, "tests", "integration", test).exists())
            self.assertTrue(any(command.startswith(beginning) for command in commands), f"no page has {beginning}")

    def test_commands_of_xr3(self):
        commands = [command for command in xr3_commands() if command[2][0] not in ("exec", "grade")]
        self.assertGreater(len(commands), 10)
        for name, variables, (what, *arguments) in commands:
            with self.subTest(file=name, command=[what, *arguments]):
                if what == "serve" and "--help" not in arguments:
                    options = list(arguments)
                    for port in "--robot-port", "--monitor-port":
                        if port in options:
                            at = options.index(port)
                            del options[at:at + 2]
                    self.serve(options, variables)
                    continue
                if arguments[:1] == ["docs/graded/submissions"]:
                    continue  # test_graded_release.py
                if what == "exercise":
                    continue  # test_own_exercise.py
                if what == "convert" and "--force" not in arguments:
                    (self.folder / arguments[-1]).unlink(missing_ok=True)
                if what == "watch":
                    with Server() as xr3:
                        self.assertEqual(0, run_xr3("watch", f"localhost:{xr3.monitor_port}").returncode)
                    continue
                if what == "term":
                    with Server() as xr3:
                        done = run_xr3("term", f"localhost:{xr3.robot_port}", *arguments, input="")
                    self.assertEqual((0, "", ""), (done.returncode, done.stdout, done.stderr))
                    continue
                if what == "healthcheck":
                    self.ask_for_health(arguments)
                    continue
                if what == "workcell":
                    self.leave_the_editor(arguments)
                    continue
                self.run_to_end(what, arguments)

    def run_to_end(self, what, arguments):
        """Runs a command, and removes the report that it has written: the next command writes one of the same name."""
        environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(ROOT, "clients", "python"))}
        done = run_xr3(what, *arguments, cwd=self.folder, stdin=subprocess.DEVNULL, env=environment)
        self.assertEqual(0, done.returncode, done.stderr)
        if "--report" in arguments:
            shutil.rmtree(self.folder / arguments[arguments.index("--report") + 1])

    def test_commands_of_the_judge(self):
        """The programs of `exec` meet all goals. Each `grade` has a folder of its own for its report."""
        commands = [(name, variables, words) for name, variables, words in xr3_commands()
                    if words[0] in ("exec", "grade") and (name, words[1]) not in COLLECTED]
        self.assertGreater(len(commands), 10)
        with concurrent.futures.ThreadPoolExecutor(RUNS) as pool:
            runs = [pool.submit(self.judge, words, f"report-{i}") for i, (_, _, words) in enumerate(commands)]
            for i, (name, _, words) in enumerate(commands):
                with self.subTest(file=name, command=words):
                    done = runs[i].result()
                    self.assertEqual(0, done.returncode, done.stdout + done.stderr)
                    if words[0] == "exec":
                        self.assertNotIn("✗", done.stdout)
                        self.assertEqual(not {"--goals", "--exercise"}.isdisjoint(words), "score " in done.stdout)
                    else:
                        self.check_report(self.folder / words[1], self.folder / f"report-{i}")

    def test_the_shown_report(self):
        """The first fence of docs/exec.md with a report is what its first command prints last."""
        page = pathlib.Path(ROOT, "docs", "exec.md").read_text(encoding="utf-8")
        report = next(fence for fence in FENCE.findall(page) if fence.startswith("✓"))
        words = next(words for name, _, words in xr3_commands() if name == "exec.md")
        printed = self.judge(words, "report").stdout
        self.assertTrue(printed.endswith(report), printed)

    def judge(self, words, report):
        words = [report if word == "report" else word for word in words]
        if words[0] == "grade":
            words[:1] = GRADE
        environment = {**os.environ, "PYTHONPATH": str(self.folder / "clients" / "python"),
                       "PYTHONDONTWRITEBYTECODE": "1"}
        return subprocess.run([XR3, *words], cwd=self.folder, stdin=subprocess.DEVNULL, env=environment,
                              capture_output=True, text=True, timeout=JUDGE_S, check=False)

    def check_report(self, submissions, folder):
        """The report has a page, and a row for each submission, one of which meets all goals."""
        names = sorted(path.name for path in submissions.iterdir())
        with open(folder / "grades.csv", encoding="utf-8-sig") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(names, sorted(row["submission"] for row in rows))
        self.assertEqual(1, sum(row["points"] == row["max_points"] for row in rows), rows)
        page = (folder / "index.html").read_text(encoding="utf-8")
        for name in names:
            self.assertIn(name, page)

    def ask_for_health(self, arguments):
        """Runs `healthcheck` with a server on a free port that writes the port file of the command."""
        with Server("--port-file", self.folder / "ports.json") as xr3:
            arguments = [str(xr3.monitor_port) if word == "9701" else word for word in arguments]
            environment = {**os.environ, "XR3_MONITOR_PORT": str(xr3.monitor_port)}
            done = run_xr3("healthcheck", *arguments, cwd=self.folder, env=environment)
        self.assertEqual((0, "", ""), (done.returncode, done.stdout, done.stderr))

    def leave_the_editor(self, arguments):
        """Runs `workcell` without input: it prints its first question and does not change the file."""
        before = (self.folder / "lab.json").read_text(encoding="utf-8")
        done = run_xr3("workcell", *arguments, cwd=self.folder, stdin=subprocess.DEVNULL)
        self.assertIn(done.returncode, (0, 2), done.stderr)
        self.assertIn("lab.json", done.stdout)
        self.assertEqual(before, (self.folder / "lab.json").read_text(encoding="utf-8"))

    def test_commands_of_clients(self):
        commands = list(client_commands())
        self.assertGreater(len(commands), 2)
        with Server(clock="real") as xr3:
            for name, command in commands:
                with self.subTest(file=name, command=command):
                    command = command.replace("9600", str(xr3.robot_port)).replace("9601", str(xr3.monitor_port))
                    command = command.replace("nc localhost", "nc -N localhost").replace("build/release/xr3", XR3)
                    done = subprocess.run(["bash", "-c", command], stdin=subprocess.DEVNULL, capture_output=True,
                                          timeout=DEADLINE_S, check=False)
                    self.assertEqual(0, done.returncode, done.stderr)
                    self.assertNotEqual(b"", done.stdout)

    def test_scripts_accept_their_documented_options(self):
        for script in "./run", "./test", "scripts/setup":
            with self.subTest(script):
                done = subprocess.run([script, "--help"], cwd=ROOT, capture_output=True, text=True,
                                      timeout=DEADLINE_S, check=False)
                self.assertEqual(0, done.returncode)
                self.assertIn(script.split("/")[-1], done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
