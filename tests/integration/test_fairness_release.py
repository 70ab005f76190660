"""A robot line's wait for its replies beside a line that pours garbage as fast as it is taken, and beside
monitor clients that ask without end. Measured in turns, with and without, in one run; of several rounds
the best counts, since a busy machine only adds."""
# labels: release serial

import contextlib
import time
import unittest

from garbage import ask_without_end, pour_garbage
from support import Server

ASKED = 1000
ROUNDS = 5


def waits_s(line):
    """The times in which replies come, the shortest first (seconds)."""
    waits = []
    for _ in range(ASKED):
        started = time.perf_counter()
        line.ask("E?")
        waits.append(time.perf_counter() - started)
    return sorted(waits)


@contextlib.contextmanager
def garbage(xr3):
    with pour_garbage(xr3.robot_port, 3600) as pouring, xr3.monitor() as monitor:
        while monitor.call("lines")["lines"][-1]["bytes_in"] < 1_000_000:
            pass
        yield
        pouring.kill()


@contextlib.contextmanager
def requests(xr3, request):
    with ask_without_end(xr3.monitor_port, request) as asking, xr3.monitor() as monitor:
        first = monitor.look("state")["seq"]
        while monitor.look("state")["seq"] < first + 20:  # time runs: a state that is looked at is a new one
            pass
        yield
        asking.kill()


class Fairness(unittest.TestCase):
    def compare(self, rank, most, disturbance, *options):
        """The wait of this rank (0 the shortest, 1 the longest) grows so many times at most."""
        ratios = []
        with Server("--log-level", "error", clock="real") as xr3, xr3.line() as line:
            waits_s(line)
            for _ in range(ROUNDS):
                alone = waits_s(line)[int(ASKED * rank)]
                with disturbance(xr3, *options):
                    beside = waits_s(line)[int(ASKED * rank)]
                ratios.append(beside / alone)
        self.assertLess(min(ratios), most, ratios)

    def test_beside_garbage(self):
        self.compare(0.99, 2.0, garbage)

    def test_beside_monitor_clients(self):
        """One request of theirs at a time, whatever it costs, and as much writing."""
        for request in b'{"op":"ping"}\n', b'{"op":"get","channel":"state"}\n', b'{"op":"get","channel":"line"}\n':
            with self.subTest(request):
                self.compare(0.5, 8.0, requests, request)


if __name__ == "__main__":
    unittest.main()
