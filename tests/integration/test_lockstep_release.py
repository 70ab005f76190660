"""Bytes written before a step are executed before it (lockstep.py): a hundred thousand tries."""
# labels: release

import unittest

from lockstep import Lockstep


class LockstepTests(unittest.TestCase):
    def test_one_line(self):
        with Lockstep(self) as lockstep:
            lockstep.one_line(100_000)

    def test_several_lines(self):
        with Lockstep(self) as lockstep:
            lockstep.several_lines(5000)

    def test_fresh_connections(self):
        with Lockstep(self) as lockstep:
            lockstep.fresh_connections(5000)

    def test_bursts(self):
        with Lockstep(self) as lockstep:
            lockstep.bursts(200)


if __name__ == "__main__":
    unittest.main()
