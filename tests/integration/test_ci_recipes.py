"""The recipes of docs/ci: the shell recipe is run unchanged, with a program that works, one that fails and
one that moves to the wrong place; the other recipes must contain the same commands."""
# labels: full

import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from support import DEADLINE_S, ROOT, XR3

RECIPES = pathlib.Path(ROOT, "docs", "ci")
FILES = ("README.md", "github-actions.yml", "gitlab-ci.yml")


def shown(name):
    """The commands of a recipe that start with xr3/, in order."""
    text = (RECIPES / name).read_text(encoding="utf-8")
    return re.findall(r"^(?: *- (?:run: )?)?(xr3/\S.*)$", text, re.MULTILINE)


class Recipes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "xr3").symlink_to(ROOT)
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        for name in ("my_program.py", "my_check.py"):
            shutil.copy(RECIPES / name, self.folder)

    def run_recipe(self, command=None, **environment):
        """Runs a command line in a folder with xr3 beside the files of a user."""
        return subprocess.run(
            command or shown("README.md")[-1], shell=True, cwd=self.folder, text=True,
            env={**os.environ, "XR3": XR3, "TMPDIR": str(self.temporary), **environment},
            stdin=subprocess.DEVNULL, capture_output=True, timeout=DEADLINE_S, check=False)

    def start_recipe(self, script, *commands):
        """Starts the script with these commands and waits until the first one prints "runs"."""
        process = subprocess.Popen([script, *commands], cwd=self.folder, text=True, stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env={**os.environ, "XR3": XR3, "TMPDIR": str(self.temporary)})
        self.addCleanup(process.communicate)
        for line in process.stdout:
            if line == "runs\n":
                return process
        return self.fail(process.stderr.read())

    def change(self, name, old, new):
        path = self.folder / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new), encoding="utf-8")

    def test_all_recipes_have_the_same_commands(self):
        commands = shown("README.md")
        self.assertEqual("xr3/docs/ci/get-xr3.sh", commands[0])
        for name in FILES:
            with self.subTest(name):
                self.assertEqual(commands, shown(name))

    def test_restored_cache_files_do_not_interfere(self):
        """The cache is a folder of ccache in the job's folder, and git can still clone xr3 beside it."""
        text = (RECIPES / "gitlab-ci.yml").read_text(encoding="utf-8")
        path = re.search(r"^ +paths: \[(\S+)\]$", text, re.MULTILINE)[1]
        self.assertIn(f"XR3_CACHE: {path}\n", text)
        source, job = self.folder / "source", self.folder / "job"
        subprocess.run(["git", "init", "-q", source], check=True, timeout=DEADLINE_S)
        (job / path).mkdir(parents=True)
        (job / path / "kept").touch()
        clone = re.search(r"^ +- (git clone .*)$", text, re.MULTILINE)[1]
        cloned = subprocess.run(clone, shell=True, cwd=job, env={**os.environ, "XR3_URL": f"file://{source}"},
                                capture_output=True, text=True, timeout=DEADLINE_S, check=False)
        self.assertEqual(0, cloned.returncode, cloned.stderr)
        text = (RECIPES / "github-actions.yml").read_text(encoding="utf-8")
        self.assertEqual(path, re.search(r"^ +path: (\.\S+)$", text, re.MULTILINE)[1])
        self.assertIn(f"XR3_CACHE: {path}\n", text)

    def test_a_package_with_another_digest_is_not_installed(self):
        script, package, programs = self.folder / "a/docs/ci/get-xr3.sh", self.folder / "xr3.deb", self.folder / "bin"
        script.parent.mkdir(parents=True)
        shutil.copy(RECIPES / "get-xr3.sh", script)
        package.write_bytes(b"a package")
        programs.mkdir()
        for name, text in (("apt-get", 'echo "$@" >>installed'), ("xr3", "echo xr3 1.2.3")):
            (programs / name).write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            (programs / name).chmod(0o755)
        environment = {"XR3_PACKAGE": str(package), "PATH": f"{programs}:{os.environ['PATH']}", "XR3_CACHE": ""}
        refused = self.run_recipe(f"{script}", XR3_PACKAGE_SHA256="0" * 64, **environment)
        self.assertNotEqual(0, refused.returncode)
        self.assertFalse((self.folder / "installed").exists())
        right = hashlib.sha256(b"a package").hexdigest()
        installed = self.run_recipe(f"{script}", XR3_PACKAGE_SHA256=right, **environment)
        self.assertEqual((0, "xr3 1.2.3\n"), (installed.returncode, installed.stdout), installed.stderr)
        self.assertIn(str(package), (self.folder / "installed").read_text(encoding="utf-8"))

    def test_a_correct_program_passes(self):
        ran = self.run_recipe()
        self.assertEqual((0, ""), (ran.returncode, ran.stderr))
        self.assertEqual(["$ python3 my_program.py", "E is there", "$ python3 my_check.py",
                          "the arm is where it should be"], ran.stdout.splitlines())
        self.assertEqual([], list(self.temporary.iterdir()))

    def test_a_wrong_program_fails(self):
        self.change("my_program.py", "E+50", "E+49")
        ran = self.run_recipe()
        self.assertNotEqual(0, ran.returncode)
        self.assertIn("'E': 49", ran.stderr)

    def test_a_program_whose_commands_are_ignored_fails(self):
        self.change("my_program.py", "E+50", "E+200")
        ran = self.run_recipe()
        self.assertNotEqual(0, ran.returncode)
        self.assertRegex(ran.stderr, "--- log of xr3:\n(?s:.*)E\\+200: a move is")

    def test_returns_the_exit_code_of_the_program(self):
        ran = self.run_recipe("xr3/docs/ci/with-xr3.sh 'exit 7' 'echo not reached'")
        self.assertEqual((7, "$ exit 7\n"), (ran.returncode, ran.stdout))
        self.assertEqual([], list(self.temporary.iterdir()))

    def test_only_the_check_reaches_the_monitor_port(self):
        show = "echo port=${XR3_MONITOR_PORT-none} token=${XR3_TOKEN-none}"
        ran = self.run_recipe(f"xr3/docs/ci/with-xr3.sh '{show}' '{show}'", XR3_TOKEN="of somebody else")
        first, last = [line for line in ran.stdout.splitlines() if line.startswith("port")]
        self.assertEqual("port=none token=none", first)
        self.assertRegex(last, r"^port=\d+ token=[0-9a-f]{32}$")

    def test_a_program_that_finds_the_monitor_port_learns_nothing(self):
        (self.folder / "peek.py").write_text(
            "import json, urllib.error, urllib.request\n"
            "try:\n"
            "    port = json.load(open('ports.json'))['monitor']\n"
            "    urllib.request.urlopen(f'http://localhost:{port}/state', timeout=10)\n"
            "except urllib.error.HTTPError as error:\n"
            "    print('refused', error.code)\n", encoding="utf-8")
        ran = self.run_recipe("xr3/docs/ci/with-xr3.sh 'python3 peek.py' 'true'", XR3_OPTIONS="--port-file ports.json")
        self.assertEqual(["$ python3 peek.py", "refused 403", "$ true"], ran.stdout.splitlines(), ran.stderr)

    def test_a_command_has_a_time_limit(self):
        started = time.monotonic()
        ran = self.run_recipe("xr3/docs/ci/with-xr3.sh 'sleep 1000' 'echo not reached'", XR3_TIME_LIMIT="1")
        self.assertEqual((124, "$ sleep 1000\n"), (ran.returncode, ran.stdout))
        self.assertIn("ended after 1 s (XR3_TIME_LIMIT): sleep 1000", ran.stderr)
        self.assertLess(time.monotonic() - started, DEADLINE_S / 2)

    def test_an_installed_program_is_found(self):
        there = self.folder / "bin"
        there.mkdir()
        (there / "xr3").symlink_to(XR3)
        (self.folder / "alone.sh").write_bytes((RECIPES / "with-xr3.sh").read_bytes())
        ran = self.run_recipe("sh alone.sh 'python3 my_program.py' 'python3 my_check.py'", XR3="",
                              XR3_DATA=os.path.join(ROOT, "data"), PATH=f"{there}:{os.environ['PATH']}")
        self.assertEqual((0, ""), (ran.returncode, ran.stderr))

    def test_a_missing_command_is_an_error(self):
        ran = self.run_recipe("xr3/docs/ci/with-xr3.sh")
        self.assertEqual((2, ""), (ran.returncode, ran.stdout))
        self.assertRegex(ran.stderr, r"\Ausage: \S*with-xr3\.sh 'COMMAND'[^\n]*\n\Z")
        self.assertEqual([], list(self.temporary.iterdir()))

    def test_a_signal_ends_all_processes(self):
        pipe = self.folder / "held"  # every process of the command keeps it open until it exits
        os.mkfifo(pipe)
        for number, code in (signal.SIGTERM, 143), (signal.SIGINT, 130):
            with self.subTest(number.name):
                held = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
                self.addCleanup(os.close, held)
                process = self.start_recipe(
                    "xr3/docs/ci/with-xr3.sh", f"exec 9>held; echo runs; sleep {3 * DEADLINE_S}; true", "echo more")
                os.set_blocking(held, True)
                process.send_signal(number)
                self.assertEqual(code, process.wait(DEADLINE_S))
                self.assertEqual(b"", os.read(held, 1), "its end")
                self.assertNotIn("more", process.stdout.read())
                self.assertEqual([], list(self.temporary.iterdir()))

    def test_commands_get_standard_input_and_default_signals(self):
        process = self.start_recipe("xr3/docs/ci/with-xr3.sh",
                                    "echo runs; read -r word; echo $word; sh -c 'kill -INT $$'")
        self.assertEqual("heard\n", process.communicate("heard\n", timeout=DEADLINE_S)[0])
        self.assertEqual(128 + signal.SIGINT, process.returncode)

    def test_another_address(self):
        ran = self.run_recipe(XR3_LISTEN="::1")
        self.assertEqual((0, ""), (ran.returncode, ran.stderr))
        ran = self.run_recipe("xr3/docs/ci/with-xr3.sh 'echo $XR3_PORT+$XR3_MONITOR_PORT'", XR3_OPTIONS="--listen ::1")
        self.assertRegex(ran.stdout, r"\n\d+\+\d+\n\Z")

    def test_a_server_that_does_not_start(self):
        ran = self.run_recipe(XR3_OPTIONS="--robot no-such-robot")
        self.assertNotEqual(0, ran.returncode)
        self.assertIn("no-such-robot", ran.stderr)

    def test_options_of_the_server(self):
        ran = self.run_recipe("xr3/docs/ci/with-xr3.sh 'curl -s localhost:$XR3_MONITOR_PORT/state'",
                              XR3_OPTIONS="--robot adept-one --clock manual")
        self.assertEqual(0, ran.returncode, ran.stderr)
        self.assertIn('"mode":"manual"', ran.stdout)

    def test_two_runs_at_once(self):
        inner = "xr3/docs/ci/with-xr3.sh 'python3 my_program.py'"
        ran = self.run_recipe(f"""xr3/docs/ci/with-xr3.sh "{inner}" 'python3 my_program.py'""")
        self.assertEqual(0, ran.returncode, ran.stderr)


if __name__ == "__main__":
    unittest.main()
