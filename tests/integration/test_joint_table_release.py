"""`xr3 replay --csv` of a recording that spans days: written as it grows, with a bound."""
# labels: release serial

import pathlib
import resource
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, XR3, Server

FAR = 10**9  # ticks: eleven and a half days
MOST_ROWS = 5_000_000
MEMORY_KIB = 64 * 1024


class LongRecordings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def record(self, clock, ticks):
        """A recording in which a joint moves, and then nothing until the end."""
        file = self.folder / "session.xr3"
        with Server("--record", file, clock=clock) as xr3, xr3.monitor() as monitor:
            with xr3.line() as line:
                line.ask("E+9\rE?")
            if ticks:
                monitor.call("step", ticks=ticks)
        return file

    def replay(self, file, *options):
        """The replay, with its peak of memory in KiB so far as `memory`."""
        command = [XR3, "replay", file, "--csv", self.folder / "joints.csv", *options]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=10 * DEADLINE_S, check=False)
        done.memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        return done

    def refused(self, done):
        self.assertEqual(2, done.returncode, done.stderr)
        self.assertIn(f"more than {MOST_ROWS} lines; with a longer --every (now 100 ms)", done.stderr)
        self.assertEqual(["session.xr3"], [path.name for path in self.folder.iterdir()], "no draft is left")
        self.assertLess(done.memory, MEMORY_KIB)

    def test_a_call_that_lets_days_pass(self):
        file = self.record("manual", FAR)
        self.refused(self.replay(file))
        done = self.replay(file, "--every", 3_600_000)
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertEqual(1 + FAR // 3_600_000 + 1, len((self.folder / "joints.csv").read_text("ascii").splitlines()))

    def test_a_far_time_to_stop(self):
        self.refused(self.replay(self.record("real", 0), "--until", FAR))


if __name__ == "__main__":
    unittest.main()
