"""Bytes written before a step are executed before it (lockstep.py): some ten thousand tries. soak_lockstep_tries.py
makes ten times as many."""
# labels: release

import unittest

from lockstep import Lockstep

TRIES = {"one_line": 20_000, "several_lines": 1000, "fresh_connections": 1000, "bursts": 40}


class LockstepTests(unittest.TestCase):
    def test_one_line(self):
        with Lockstep(self) as lockstep:
            lockstep.one_line(TRIES["one_line"])

    def test_several_lines(self):
        with Lockstep(self) as lockstep:
            lockstep.several_lines(TRIES["several_lines"])

    def test_fresh_connections(self):
        with Lockstep(self) as lockstep:
            lockstep.fresh_connections(TRIES["fresh_connections"])

    def test_bursts(self):
        with Lockstep(self) as lockstep:
            lockstep.bursts(TRIES["bursts"])


if __name__ == "__main__":
    unittest.main()
