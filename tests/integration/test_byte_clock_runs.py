"""An unmodified pick-and-place program with a camera has the same transcript beside full load and without."""

import unittest

from byte_clock_runs import build, counted
from lockstep_runs import full_load


class Runs(unittest.TestCase):
    def test_busy_and_idle_runs_are_the_same(self):
        build()
        idle = counted(1, 1, 2)
        with full_load():
            busy = counted(1, 1, 2)
        self.assertEqual(idle, busy)


if __name__ == "__main__":
    unittest.main()
