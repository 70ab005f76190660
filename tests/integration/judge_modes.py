"""The ways to run the judge on one machine: as root and as an ordinary user, with and without user namespaces. A test class
that inherits from one of them uses judge() and grade() with programs as text."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from support import HAS_SANDBOX, XR3

PYTHON = "/usr/bin/python3"  # in the sandbox, too
USER = 61000  # an ordinary user, who need not have a name
TASK_S = 120
AS_USER = ["setpriv", f"--reuid={USER}", f"--regid={USER}", "--clear-groups", "--"]
# A user namespace in which no further one can be made: as in many containers.
NO_NAMESPACES = ["unshare", "--user", "--map-current-user", "--keep-caps", "sh", "-c",
                 'echo 0 >/proc/sys/user/max_user_namespaces && exec setpriv --ambient-caps=-all --inh-caps=-all -- "$@"', "sh"]
# Root of a user namespace in which no further one can be made, and which has no other user.
ROOT_WITHOUT = ["unshare", "--user", "--map-root-user", "sh", "-c", 'echo 0 >/proc/sys/user/max_user_namespaces && exec "$@"', "sh"]
GOALS = {"goals": [{"kind": "no_stall", "points": 10}]}  # for programs that move the robot
MOVE = """
import os, socket
with socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"]))) as line:
    line.sendall(b"F+9\\r")
"""


def works(*command):
    try:
        return subprocess.run(command, check=False, capture_output=True).returncode == 0
    except FileNotFoundError:
        return False


class Judge:
    """`before` stands before the command line of xr3."""
    before = []
    needs = ["true"]  # must succeed on this machine

    @classmethod
    def setUpClass(cls):
        if not works(*cls.before, *cls.needs):
            raise unittest.SkipTest(f"this kernel or user may not: {' '.join(cls.before + cls.needs)}")
        if not works(*cls.before, XR3, "--version"):
            raise unittest.SkipTest(f"this user cannot run {XR3}")

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.write("goals.json", json.dumps(GOALS))
        self.give(self.folder)

    def give(self, path):
        """Makes the judge's user the owner."""
        if AS_USER[0] in self.before and os.getuid() == 0:
            os.chown(path, USER, USER)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(text, encoding="utf-8")
        for each in path, *path.parents[:len(path.relative_to(self.folder).parents)]:
            self.give(each)
        return path

    def run_xr3(self, *arguments, code=0, before=(), **options):
        done = subprocess.run([*self.before, *before, XR3, *map(str, arguments)], **{
            "capture_output": True, "text": True, "timeout": TASK_S, "check": False, "cwd": self.folder, **options})
        if code is not None:
            self.assertEqual(code, done.returncode, f"{done.stdout}{done.stderr}")
        return done

    def judge(self, program, *options, words=(), code=0, **more):
        """Runs the program with `words` as its arguments."""
        self.write("program.py", program)
        return self.run_xr3("exec", *options, "--", PYTHON, "program.py", *words, code=code, **more)

    def grade(self, *options, code=0, command=(PYTHON, "{}"), **more):
        """Grades the folder `class`; returns what was printed, and {submission: row of the table}."""
        shutil.rmtree(self.folder / "report", ignore_errors=True)
        done = self.run_xr3("grade", "class", "--goals", "goals.json", "--report", "report", *options, "--", *command,
                            code=code, **more)
        return done, {line.split()[0]: line for line in done.stdout.splitlines()}


class Root(Judge):
    needs = ["sh", "-c", "test $(id -u) = 0 && unshare --net true"]


class User(Judge):
    before = AS_USER if os.getuid() == 0 else []
    needs = ["unshare", "--user", "true"]


class UserWithoutNamespaces(Judge):
    before = [*(AS_USER if os.getuid() == 0 else []), *NO_NAMESPACES]


SANDBOX = unittest.skipUnless(HAS_SANDBOX, "bubblewrap does not work here")
