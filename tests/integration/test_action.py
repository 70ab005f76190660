"""action.yml: its steps are run as GitHub runs them, with its variables and files, for programs that meet their goals, miss
them, and try to write the result themselves."""
# labels: full

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import ROOT, XR3

try:
    import yaml
except ImportError:
    yaml = None

CI = pathlib.Path(ROOT, "docs", "ci")
TASK_S = 60
MOVE = """
import os, socket
line = socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"])))
line.sendall(b"E+50\\r")
while line.send(b"E?") and line.recv(1)[0] != 32:
    pass
"""
# Prints commands of GitHub, in their old form too, and looks for the files in which it reads results.
CHEAT = r"""
import os
for end in "\n", "\r\n", "\r":
    print(f"x{end}::notice::all is well{end}##[warning]x{end}::add-mask::x", end=end)
print([name for name in os.environ if name.startswith(("GITHUB_", "ACTIONS_", "RUNNER_", "INPUT_"))])
"""
EXPRESSION = re.compile(r"\$\{\{ *(.*?) *\}\}")


@unittest.skipUnless(yaml, "python3-yaml is not installed")
class Action(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.action = yaml.safe_load(pathlib.Path(ROOT, "action.yml").read_text(encoding="utf-8"))
        self.steps = self.action["runs"]["steps"]
        (self.folder / "goals.json").write_text(json.dumps({"goals": [
            {"kind": "joint", "label": "E", "count": 50, "hint": "50 %\nof 100"}, {"kind": "no_stall"}]}), encoding="utf-8")
        (self.folder / "move.py").write_text(MOVE, encoding="utf-8")
        (self.folder / "wrong.py").write_text(MOVE.replace("50", "49"), encoding="utf-8")
        (self.folder / "cheat.py").write_text(CHEAT, encoding="utf-8")
        self.files = {name: self.folder / name.lower() for name in ("GITHUB_OUTPUT", "GITHUB_STEP_SUMMARY")}
        (self.folder / "temp").mkdir()

    def run_step(self, number, place=ROOT, environment=None, **inputs):
        """Runs a step with these inputs, as GitHub does; returns the result of the process."""
        values = {name: str(its.get("default", "")) for name, its in self.action["inputs"].items()} | inputs
        step = self.steps[number]
        given = {name: EXPRESSION.sub(lambda found: values[found[1].removeprefix("inputs.")], text)
                 for name, text in step["env"].items()}
        self.assertEqual("bash", step["shell"])
        return subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]], cwd=self.folder, text=True,
            env={**os.environ, "XR3": XR3, **{name: str(path) for name, path in self.files.items()}, "RUNNER_TEMP": str(self.folder / "temp"),
                 "GITHUB_ACTION_PATH": str(place), "GITHUB_SERVER_URL": "https://github.invalid",
                 "GITHUB_ACTION_REPOSITORY": "owner/xr3", "ACTIONS_RUNTIME_TOKEN": "secret", **given, **(environment or {})},
            stdin=subprocess.DEVNULL, capture_output=True, timeout=TASK_S, check=False)

    def judge(self, program, code, **inputs):
        """The lines of the log that GitHub executes, and those that it does not."""
        done = self.run_step(1, program=f"{sys.executable} {program}", **inputs)
        self.assertEqual(code, done.returncode, done.stdout + done.stderr)
        token, printed, executed = re.fullmatch(r"::stop-commands::(\w{32})\n(.*)\n::\1::\n(.*)", done.stdout, re.DOTALL).groups()
        self.assertNotIn(token, printed)
        return executed.splitlines(), printed

    def text(self, name):
        return self.files[name].read_text(encoding="utf-8")

    def result(self):
        """The folder of the artifact."""
        return pathlib.Path(self.text("GITHUB_OUTPUT").strip().removeprefix("folder="))

    def test_no_input_is_a_part_of_a_command(self):
        for step in self.steps:
            self.assertNotIn("${{", step.get("run", ""))
        used = set(re.findall(r"inputs\.(\w+)", json.dumps(self.steps)))
        self.assertEqual(set(self.action["inputs"]), used)

    def test_a_program_that_meets_its_goals(self):
        executed, printed = self.judge("move.py", 0, goals="goals.json")
        self.assertEqual([], executed)
        self.assertIn("score 2 of 2", printed)
        self.assertIn("| ✓ | joint E at 50 counts, within 0 |", self.text("GITHUB_STEP_SUMMARY"))
        self.assertLessEqual({"recording.xr3rec", "end.svg"}, {path.name for path in (self.result() / "runs").iterdir()})
        upload = self.steps[2]
        self.assertEqual("${{ steps.judge.outputs.folder }}", upload["with"]["path"])
        self.assertEqual(("judge", "actions/upload-artifact@v4"), (self.steps[1]["id"], upload["uses"]))

    def test_a_missed_goal_is_an_annotation(self):
        executed, _ = self.judge("wrong.py", 5, goals="goals.json")
        self.assertEqual([f"::error title={sys.executable} wrong.py::joint E at 50 counts, within 0: it is at 49 counts%0A"
                          "hint: 50 %25%0Aof 100"], executed[:1])
        self.assertIn("| ✗ | joint E at 50 counts, within 0 | it is at 49 counts |", self.text("GITHUB_STEP_SUMMARY"))

    def test_github_executes_nothing_that_the_program_prints(self):
        executed, printed = self.judge("cheat.py", 5, goals="goals.json")
        self.assertTrue(all(line.startswith("::error title=") for line in executed), executed)
        self.assertIn("::notice::all is well", printed)
        self.assertIn("\n[]\n", printed, "the variables of the job")

    def test_inputs_are_options_and_no_shell_reads_them(self):
        mark = self.folder / "mark"
        for name in "program", "goals", "exercise", "robot", "workcell", "clock", "repeat":
            for text in f"$(touch {mark})", f"; touch {mark}", f"`touch {mark}`", f"--csv={mark}":
                done = self.run_step(1, **{"program": "true", name: text})
                self.assertNotEqual(0, done.returncode, text)
                self.assertFalse(mark.exists(), text)
        executed, printed = self.judge("move.py", 0, exercise="", robot="rhino-xr3", workcell="none", clock="bytes:30", repeat="2",
                                     goals="goals.json")
        self.assertEqual([], executed)
        self.assertIn("2 of 2 runs passed", printed)
        executed, _ = self.judge("move.py", 5, exercise="01-hello")
        self.assertRegex(executed[0], "joint E at 140 counts")

    def test_what_cannot_be_judged_is_an_error(self):
        done = self.run_step(1, program="true", goals="none.json")
        self.assertEqual(2, done.returncode)
        self.assertIn("none.json", done.stdout)
        self.assertEqual("::error title=xr3::the program was not judged: the log of this step says why", done.stdout.splitlines()[-1])
        done = self.run_step(1, program="  ")
        self.assertEqual((2, "::error title=xr3::the input program names none\n"), (done.returncode, done.stdout))

    def test_the_package_of_a_release_is_installed(self):
        place, programs = self.folder / "action", self.folder / "bin"
        (place / "docs" / "ci").mkdir(parents=True)
        for name in "action.sh", "get-xr3.sh":
            shutil.copy(CI / name, place / "docs" / "ci")
        (place / "run").write_text('#!/bin/sh\necho "run $*"\n', encoding="utf-8")
        (place / "run").chmod(0o755)
        programs.mkdir()
        for name, text in (("curl", f'echo "$*" >>{self.folder}/asked'), ("apt-get", f'echo "$*" >>{self.folder}/asked'),
                           ("dpkg", "echo arm64"), ("xr3", "echo xr3 1.2.3")):
            (programs / name).write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            (programs / name).chmod(0o755)
        environment = {"PATH": f"{programs}:{os.environ['PATH']}", "XR3_CACHE": "", "TMPDIR": str(self.folder / "temp")}
        done = self.run_step(0, place, environment, version="1.2.3")
        self.assertEqual((0, "xr3 1.2.3\n"), (done.returncode, done.stdout), done.stderr)
        asked = (self.folder / "asked").read_text(encoding="utf-8").splitlines()
        self.assertRegex(asked[0], r" https://github.invalid/owner/xr3/releases/download/v1\.2\.3/xr3_1\.2\.3_arm64\.deb$")
        self.assertRegex(asked[1], r"^install .*/xr3\.deb$")
        self.assertEqual("run --build\n", self.run_step(0, place, environment).stdout)
        for version in "../../1", "1;x", "v1":
            done = self.run_step(0, place, environment, version=version)
            self.assertEqual((2, "::error title=xr3::the input version is a release such as 0.10.0\n"), (done.returncode, done.stdout))

    def test_the_page_uses_inputs_that_exist(self):
        page = (CI / "README.md").read_text(encoding="utf-8")
        shown = yaml.safe_load(re.search(r"^```yaml\n(.*?)^```", page, re.MULTILINE | re.DOTALL)[1])
        given = shown["jobs"]["robot"]["steps"][-1]["with"]
        self.assertLessEqual(set(given), set(self.action["inputs"]))
        listed = re.findall(r"`(\w+)`", "".join(re.findall(r"^\| (`.*?) \|", page, re.MULTILINE)))
        self.assertEqual(set(self.action["inputs"]), set(listed))


if __name__ == "__main__":
    unittest.main()
