"""The limits of a run: memory, processes and files of all its processes, and simulated time to the tick, in every mode."""

import json
import unittest

from judge_modes import SANDBOX, Root, User, UserWithoutNamespaces

TOUCH = """
import os, time
def children(count, act):
    for _ in range(count):
        if os.fork() == 0:
            act()
            time.sleep(100)
"""
TWO_LARGE = TOUCH + "children(2, lambda: globals().update(x=b'x' * (200 << 20)))\ntime.sleep(100)\n"
SHARED = TOUCH + "x = b'x' * (200 << 20)\nchildren(5, lambda: None)\ntime.sleep(1)\n"
MANY = TOUCH + "children(30, lambda: None)\ntime.sleep(100)\n"
BOMB = """
import os
while True:
    try:
        os.fork()
    except OSError:
        os.write(1, b"refused\\n")
"""
FILES = """
import time
for number in range(10_500):
    open(f"/tmp/{number}", "w").close()
time.sleep(100)
"""
MOVE = """
import os, socket
line = socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"])))
line.sendall(b"F+90\\r")
"""
ASK = MOVE + """
while True:
    line.sendall(b"F?" * 500)
    line.recv(1000)
"""


class Limits:
    options = []

    def assert_limit(self, words, program, *options):
        done = self.judge(program, *self.options, *options, code=7)
        self.assertIn(words, done.stdout)
        return done

    def test_memory_of_all_processes_together(self):
        self.assert_limit("the program had more than 300 MiB of memory (--memory)", TWO_LARGE, "--memory", "300")

    def test_memory_that_processes_share_counts_once(self):
        self.judge(SHARED, *self.options, "--memory", "400")

    def test_processes(self):
        self.assert_limit("the program had more than 10 processes (--processes)", MANY, "--processes", "10")

    def simulated(self, program, *options):
        """(report, exit code) of a run of half a second of simulated time."""
        done = self.judge(program, *self.options, "--goals", "goals.json", "--max-sim-seconds", "0.5", "--json", "run.json", *options, code=7)
        self.assertIn("the limit of 0.5 simulated seconds was reached (--max-sim-seconds)", done.stdout)
        return json.loads((self.folder / "run.json").read_text(encoding="utf-8"))

    def test_simulated_time_is_exact(self):
        self.write("goals.json", json.dumps({"goals": [{"kind": "joint", "label": "F", "count": 90, "within": 89}]}))
        for program, clock in (ASK, "bytes:0"), (ASK, "bytes:900"), (ASK, "bytes:10000"), (MOVE, "bytes:0,settle=10000"):
            report = self.simulated(program, "--clock", clock)
            self.assertEqual(500, report["ticks"], (program, clock))
        self.write("goals.json", json.dumps({"goals": [{"kind": "joint", "label": "F", "count": 90}]}))
        self.assertFalse(self.simulated(MOVE)["goals"][0]["met"], "it comes to rest later, and is judged at the limit")


class Bounded(Limits):
    """The limits of tasks, if a user namespace counts its own."""

    def test_a_program_that_forks_without_end(self):
        done = self.judge(BOMB, *self.options, "--processes", "2", code=7)
        self.assertIn("the program had more than 2 processes (--processes)", done.stdout)


class RootWithoutSandbox(Limits, Root, unittest.TestCase):
    pass


class UserWithoutSandbox(Bounded, User, unittest.TestCase):
    pass


class UserInABareContainer(Limits, UserWithoutNamespaces, unittest.TestCase):
    pass


class Files:
    def test_files(self):
        self.assert_limit("the program had more than 10000 files", FILES)


@SANDBOX
class RootInTheSandbox(Bounded, Files, Root, unittest.TestCase):
    options = ["--sandbox"]


@SANDBOX
class UserInTheSandbox(Bounded, Files, User, unittest.TestCase):
    options = ["--sandbox"]


if __name__ == "__main__":
    unittest.main()
