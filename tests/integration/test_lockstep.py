"""Bytes written before a step are executed before it (lockstep.py): some thousand tries, with sanitizers."""

import unittest

from lockstep import Lockstep


class LockstepTests(unittest.TestCase):
    def test_one_line(self):
        with Lockstep(self) as lockstep:
            lockstep.one_line(3000)

    def test_several_lines(self):
        with Lockstep(self) as lockstep:
            lockstep.several_lines(500)

    def test_split_moves(self):
        with Lockstep(self) as lockstep:
            lockstep.split_moves(500)

    def test_fresh_connections(self):
        with Lockstep(self) as lockstep:
            lockstep.fresh_connections(500)

    def test_in_the_worst_order(self):
        for fresh in False, True:
            with self.subTest(fresh=fresh), Lockstep(self) as lockstep:
                lockstep.frozen(50, fresh)

    def test_bursts(self):
        with Lockstep(self) as lockstep:
            lockstep.bursts(10)

    def test_bursts_that_exceed_the_receive_buffer(self):
        with Lockstep(self) as lockstep:
            lockstep.frozen(10, fresh=False, before=25_000 * b"F+0\r")


if __name__ == "__main__":
    unittest.main()
