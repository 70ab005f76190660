"""A robot at rest costs nothing: with clients connected and the clock running, the process is never
scheduled."""
# labels: release serial

import os
import select
import unittest

from support import Server

WATCHED_S = 1.0


def scheduling(pid):
    """(nanoseconds on a processor, switches away from it) of all threads, as the kernel counts them."""
    ran = switches = 0
    for thread in os.listdir(f"/proc/{pid}/task"):
        with open(f"/proc/{pid}/task/{thread}/schedstat", encoding="ascii") as file:
            ran += int(file.read().split()[0])
        with open(f"/proc/{pid}/task/{thread}/status", encoding="ascii") as file:
            switches += sum(int(row.split()[1]) for row in file if "ctxt_switches" in row)
    return ran, switches


class Idle(unittest.TestCase):
    def assert_never_runs(self, xr3, *sockets):
        """Measures idleness for a second: not a wait for something, since nothing may come. A timer
        that was armed before and is not needed any more still goes off once; that is let pass first."""
        self.assertEqual(([], [], []), select.select(sockets, [], [], 1.2 * WATCHED_S))
        before = scheduling(xr3.pid)
        self.assertEqual(([], [], []), select.select(sockets, [], [], WATCHED_S))
        self.assertEqual(before, scheduling(xr3.pid))

    def test_at_rest_with_clients(self):
        for clock in "real", "real:1000", "manual":
            with self.subTest(clock), Server(clock=clock) as xr3, xr3.monitor() as monitor:
                with xr3.line() as asked, xr3.line() as begun, xr3.line() as silent:
                    self.assertEqual(32, asked.ask("E?"))
                    begun.send("E+5")
                    self.assertEqual(32, silent.ask("F?"))
                    self.assertEqual(False, monitor.get("moving")["moving"])
                    self.assert_never_runs(xr3, asked.socket, begun.socket, silent.socket, monitor.socket)
                    self.assertEqual(32, asked.ask("E?"))

    def test_at_rest_again_after_a_move(self):
        with Server(clock="real:100") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+20\rF+300\rD-9\r")
            while line.ask("E?") != 32 or line.ask("D?") != 32:
                pass
            xr3.monitor().close()
            heartbeat_s = 2 * WATCHED_S  # whatever was still armed goes off in that time
            select.select([line.socket], [], [], heartbeat_s)
            self.assert_never_runs(xr3, line.socket, monitor.socket)

    def test_blocked_and_stalled_are_rest_too(self):
        """A motor at its limit keeps its counter, and a stalled robot its moves: neither keeps time."""
        for name, work in [("blocked", "A+127\r"), ("stalled", "E-120\r" * 3)]:
            with self.subTest(name), Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
                for move in work.split("\r")[:-1]:
                    line.send(move + "\r")
                    state = monitor.settle(after=line)
                self.assertFalse(state["moving"])
                monitor.call("resume")
                self.assert_never_runs(xr3, line.socket, monitor.socket)


if __name__ == "__main__":
    unittest.main()
