"""A robot line's wait for its replies beside others that keep the server busy: a line that pours garbage as
fast as it is taken, and viewers of everything. Measured in turns, with and without, in one run; of
several rounds the best counts, since a busy machine only ever adds."""
# labels: release serial

import contextlib
import time
import unittest

from garbage import pour_garbage
from support import Server

ASKED = 1000
ROUNDS = 5
CHANNELS = ("state", "image", "display", "model", "event", "line")


def p99_s(line):
    """The time that 99 of 100 replies come in (seconds)."""
    waits = []
    for _ in range(ASKED):
        started = time.perf_counter()
        line.ask("E?")
        waits.append(time.perf_counter() - started)
    return sorted(waits)[ASKED * 99 // 100]


class Fairness(unittest.TestCase):
    def compare(self, disturbance, most):
        """The p99 with the disturbance is at most so many times the one without."""
        ratios = []
        with Server("--log-level", "error", clock="real") as xr3, xr3.line() as line:
            p99_s(line)
            for _ in range(ROUNDS):
                before = p99_s(line)
                with disturbance(xr3):
                    beside = p99_s(line)
                ratios.append(beside / before)
        self.assertLess(min(ratios), most, ratios)

    def test_beside_garbage(self):
        @contextlib.contextmanager
        def garbage(xr3):
            with pour_garbage(xr3.robot_port, 3600) as pouring, xr3.monitor() as monitor:
                while monitor.call("lines")["lines"][-1]["bytes_in"] < 1_000_000:
                    pass
                yield
                pouring.kill()
        self.compare(garbage, 2.0)


if __name__ == "__main__":
    unittest.main()
