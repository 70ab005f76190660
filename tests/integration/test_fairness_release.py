"""A robot line's wait for its replies beside a line that pours garbage as fast as it is taken. Measured in
turns, with and without, in one run; of several rounds the best counts, since a busy machine only adds."""
# labels: release serial

import contextlib
import time
import unittest

from garbage import pour_garbage
from support import Server

ASKED = 1000
ROUNDS = 5


def p99_s(line):
    """The time that 99 of 100 replies come in (seconds)."""
    waits = []
    for _ in range(ASKED):
        started = time.perf_counter()
        line.ask("E?")
        waits.append(time.perf_counter() - started)
    return sorted(waits)[ASKED * 99 // 100]


@contextlib.contextmanager
def garbage_beside(xr3):
    with pour_garbage(xr3.robot_port, 3600) as pouring, xr3.monitor() as monitor:
        while monitor.call("lines")["lines"][-1]["bytes_in"] < 1_000_000:
            pass
        yield
        pouring.kill()


class Fairness(unittest.TestCase):
    MOST = 2.0

    def test_beside_garbage(self):
        ratios = []
        with Server("--log-level", "error", clock="real") as xr3, xr3.line() as line:
            p99_s(line)
            for _ in range(ROUNDS):
                alone = p99_s(line)
                with garbage_beside(xr3):
                    beside = p99_s(line)
                ratios.append(beside / alone)
        self.assertLess(min(ratios), self.MOST, ratios)


if __name__ == "__main__":
    unittest.main()
