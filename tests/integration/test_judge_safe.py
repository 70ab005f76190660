"""A program under test cannot reach the judge, and nothing of it outlives the run: as root and as an ordinary user, with and
without the sandbox, and without user namespaces. SECURITY.md names the classes."""

import fcntl
import os
import unittest

from judge_modes import MOVE, SANDBOX, Judge, Root, User, UserWithoutNamespaces

TOKEN = "sixteen letters!"
# Asks whether a process of xr3 that it can see, the judge or its keeper, lets it read its environment, its open files and its
# memory. With arguments: only those that have them on their command lines, since other tests run judges of the same user.
LOOK = f"""
import os, sys
for pid in filter(str.isdigit, os.listdir("/proc")):
    try:
        command = open(f"/proc/{{pid}}/cmdline", "rb").read()
    except OSError:
        continue
    words = command.split(b"\\0")
    if not words[0].endswith(b"xr3") or not all(word.encode() in words for word in sys.argv[1:]):
        continue
    for what in "environ", "fd", "mem":
        try:
            path = f"/proc/{{pid}}/{{what}}"
            os.listdir(path) if what == "fd" else os.close(os.open(path, os.O_RDONLY))
            print("reached", what, command)
        except OSError:
            pass
print("token", {TOKEN!r} in str(os.environ), "looked")
"""
# A chain of processes, each of which starts the next one and ends, in sessions of their own. Each holds a lock.
CHAIN = """
import fcntl, os, signal, time
end = time.monotonic() + 20
file = open("lock", "w")
fcntl.flock(file, fcntl.LOCK_SH)
for number in signal.SIGTERM, signal.SIGHUP, signal.SIGINT:
    signal.signal(number, signal.SIG_IGN)
if os.fork() == 0:
    while time.monotonic() < end:
        os.setsid()
        if os.fork():
            os._exit(0)
"""
STUBBORN = """
import fcntl, os, signal, time
file = open("lock", "w")
fcntl.flock(file, fcntl.LOCK_SH)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
for hop in range(3):
    if os.fork() == 0:
        os.setsid()
        time.sleep(100)
"""
KILL_THE_JUDGE = "import os, signal\nos.kill(os.getppid(), signal.SIGKILL)\nprint('alive')\n"


class Hidden:
    options = []

    def test_the_environment_files_and_memory_of_the_judge_are_out_of_reach(self):
        done = self.judge(LOOK, *self.options, words=[self.folder.name], env={**os.environ, "XR3_TOKEN": TOKEN})
        self.assertEqual("token False looked", done.stdout.splitlines()[0], done.stdout)


class Ended:
    """Without the sandbox: programs may write a file of the test's folder."""
    options = []

    def assert_no_process_is_left(self):
        with open(self.folder / "lock", encoding="utf-8") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)  # raises BlockingIOError

    def test_no_process_outlives_the_run(self):
        for program in STUBBORN, CHAIN:
            for _ in range(3):
                self.judge(program, *self.options)
                self.assert_no_process_is_left()

    def test_no_process_outlives_a_run_that_is_ended(self):
        self.judge(STUBBORN + "time.sleep(1000)\n", "--max-seconds", "1", code=7)
        self.assert_no_process_is_left()

    def test_the_end_of_a_program_is_told_as_it_is(self):
        self.assertIn("exit code 3", self.judge("raise SystemExit(3)\n", code=6).stdout)
        self.assertIn("signal 11 (Segmentation fault)",
                      self.judge("import os\nos.kill(os.getpid(), 11)\n", code=6).stdout)
        self.assertIn("no-such cannot be started: No such file or directory",
                      self.run_xr3("exec", "--", "./no-such", code=6).stdout)


class Apart:
    """With a PID namespace."""

    def test_a_program_does_not_see_the_judge(self):
        self.assertEqual("alive", self.judge(KILL_THE_JUDGE, *self.options).stdout.splitlines()[0])


class Report:
    """A class with submissions that attack the judge."""
    options = []
    code = 0

    def test_a_submission_that_attacks_its_judge_fails_alone(self):
        for name, program in {"ada": MOVE, "eve": KILL_THE_JUDGE, "mallory": LOOK + MOVE, "zoe": MOVE}.items():
            self.write(f"class/{name}.py", program)
        done, rows = self.grade(*self.options, "--jobs", "2", code=self.code)
        for name in "ada", "mallory", "zoe":
            self.assertRegex(rows[f"{name}.py"], r"^\w+\.py +10/10 *$")
        self.assertRegex(rows["eve.py"], " 0/10 " if self.code == 0 else "the run could not be made|the program ended with")


class RootWithoutSandbox(Apart, Ended, Root, unittest.TestCase):
    pass


class UserWithoutSandbox(Apart, Hidden, Ended, Report, User, unittest.TestCase):
    def grade(self, *options, **more):
        return super().grade("--no-sandbox", *options, **more)


class UserInABareContainer(Hidden, Ended, Report, UserWithoutNamespaces, unittest.TestCase):
    code = 1  # a run could not be made

    def grade(self, *options, **more):
        return super().grade("--no-sandbox", *options, **more)


@SANDBOX
class RootInTheSandbox(Apart, Hidden, Report, Root, unittest.TestCase):
    def judge(self, *arguments, **more):
        return super().judge(*arguments, "--sandbox", **more)


@SANDBOX
class UserInTheSandbox(Apart, Hidden, Report, User, unittest.TestCase):
    def judge(self, *arguments, **more):
        return super().judge(*arguments, "--sandbox", **more)


class WithoutTheSandbox(Judge, unittest.TestCase):
    """grade needs it, unless it is told otherwise."""

    def test_grade_names_the_package_of_bubblewrap(self):
        self.write("class/ada.py", MOVE)
        done, _ = self.grade(code=2, env={**os.environ, "PATH": "/nowhere"})
        self.assertEqual("xr3: the sandbox needs bubblewrap (Debian package bubblewrap); install it, or add --no-sandbox, which runs the "
                         "submissions with your rights\n", done.stderr)
        self.assertFalse((self.folder / "report").exists())
        done, rows = self.grade("--no-sandbox")
        self.assertIn("10/10", rows["ada.py"])
        done = self.judge("", "--sandbox", code=2, env={**os.environ, "PATH": "/nowhere"})
        self.assertIn("the sandbox needs bubblewrap (Debian package bubblewrap)", done.stderr)


if __name__ == "__main__":
    unittest.main()
