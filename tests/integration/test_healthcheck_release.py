"""The processor time of the process `xr3 healthcheck`, which a container engine starts every few seconds, compared
with that of the smallest process."""
# labels: release serial

import resource
import statistics
import subprocess
import unittest

from support import Server, run_xr3

MOST_RATIO = 20  # measured: 5.4 to 8.3, most of it to load the libraries
RUNS = 21


def children_s():
    """Seconds of processor time that the child processes that have ended have used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Cost(unittest.TestCase):
    def test_costs_little(self):
        smallest, checks = [], []
        with Server(clock="real") as xr3:
            for _ in range(RUNS):
                before = children_s()
                subprocess.run(["true"], check=True)
                between = children_s()
                done = run_xr3("healthcheck", "--monitor-port", xr3.monitor_port)
                smallest.append(between - before)
                checks.append(children_s() - between)
                self.assertEqual(0, done.returncode, done.stderr)
        ratio = statistics.median(checks) / statistics.median(smallest)
        self.assertLess(ratio, MOST_RATIO, (checks, smallest))


if __name__ == "__main__":
    unittest.main()
