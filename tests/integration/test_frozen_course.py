"""The programs of the course, in Python and C, each in a class that its teacher freezes for half a minute: all meet their
goals."""
# labels: full

import concurrent.futures
import os
import pathlib
import subprocess
import tempfile
import threading
import unittest

from support import ROOT, Server

COURSE = pathlib.Path(ROOT, "docs", "course")
# Programs of the tenth give up on a reply after a second: in a lesson they run under `xr3 exec`, without a freeze.
EXERCISES = sorted(path for path in COURSE.iterdir() if path.is_dir() and path.name != "10-robust")
FROZEN_S = 30
SLOW = 0.2  # rate of the clock until the freeze, so that no program ends before it
WORKS_S = 400


def summary(monitor):
    return monitor.call("cells")["cells"][0]


class FrozenCourse(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def command(self, exercise, language):
        if language == "Python":
            return ["python3", exercise / "solution.py"]
        binary = self.folder / exercise.name
        subprocess.run(["cc", "-O1", "-I", COURSE, exercise / "solution.c", "-lm", "-o", binary], check=True)
        return [binary]

    def run_frozen(self, exercise, language):
        """Runs a solution, freezes its robot after the first command until it has been frozen for FROZEN_S. Returns the
        exit code, the output and the summary of the cell."""
        command = self.command(exercise, language)
        with Server("--exercise", exercise, clock=f"real:{SLOW}") as xr3, xr3.monitor() as monitor:
            environment = {**os.environ, "XR3_HOST": "127.0.0.1", "XR3_PORT": str(xr3.robot_port),
                           "XR3_MONITOR_PORT": str(xr3.monitor_port), "PYTHONPATH": f"{ROOT}/clients/python"}
            program = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                       stderr=subprocess.STDOUT, text=True)
            try:
                while summary(monitor)["last_command"] is None and program.poll() is None:
                    pass
                monitor.call("freeze")
                frozen = program.poll() is None
                threading.Event().wait(FROZEN_S)
                self.assertTrue(summary(monitor)["frozen"])
                still = program.poll() is None
                monitor.call("unfreeze")
                monitor.call("rate", factor=1)
                output, _ = program.communicate(timeout=WORKS_S)
            finally:
                program.kill()
            self.assertTrue(frozen and still, f"{exercise.name} in {language} has ended before:\n{output}")
            monitor.call("pause")
            monitor.call("run_until", idle=True, max_ticks=60_000)
            return program.returncode, output, summary(monitor)

    def test_all_programs_survive_a_freeze(self):
        runs = [(exercise, language) for exercise in EXERCISES for language in ("Python", "C")]
        with concurrent.futures.ThreadPoolExecutor(len(runs)) as pool:
            results = list(pool.map(lambda run: self.run_frozen(*run), runs))
        for (exercise, language), (code, output, cell) in zip(runs, results):
            with self.subTest(exercise=exercise.name, language=language):
                self.assertEqual(0, code, output[-2000:])
                self.assertEqual(*cell["points"], f"{cell['goals']}\n{output[-2000:]}")


if __name__ == "__main__":
    unittest.main()
