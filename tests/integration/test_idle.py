"""A robot at rest costs nothing: with clients connected and the clock running, the process is never
scheduled. All cases are watched at once, each in a process of its own."""
# labels: release serial

import contextlib
import os
import select
import time
import unittest

from support import DEADLINE_S, Server

WATCHED_S = 10.0
# A timer that was armed while something moved goes off once more, within this.
LAST_TIMER_S = 1.2


def scheduling(pid):
    """(nanoseconds on a processor, switches away from it) of all threads, as the kernel counts them."""
    ran = switches = 0
    for thread in os.listdir(f"/proc/{pid}/task"):
        with open(f"/proc/{pid}/task/{thread}/schedstat", encoding="ascii") as file:
            ran += int(file.read().split()[0])
        with open(f"/proc/{pid}/task/{thread}/status", encoding="ascii") as file:
            switches += sum(int(row.split()[1]) for row in file if "ctxt_switches" in row)
    return ran, switches


class Case:
    """A server with a monitor and three lines: one that has asked, one with half a command, one mute."""

    CHANNELS = ("state", "image", "display", "model", "event", "line")

    def __init__(self, *options, clock="real", viewers=0):
        self.server = Server(*options, clock=clock)
        self.viewer_count = viewers

    def __enter__(self):
        self.server.__enter__()
        self.monitor = self.server.monitor()
        self.asked, self.begun, self.mute = (self.server.line() for _ in range(3))
        self.asked.ask("E?")
        self.begun.send("E+5")
        self.viewers = [self.server.monitor() for _ in range(self.viewer_count)]
        for number, viewer in enumerate(self.viewers):
            for channel in self.CHANNELS:
                viewer.subscribe(channel, max_hz=(1, 30, 60)[number % 3])
        return self

    def __exit__(self, *problem):
        for monitor in [self.monitor, *self.viewers]:
            monitor.close()
        self.server.__exit__(*problem)

    def sockets(self):
        clients = [self.monitor, *self.viewers, self.asked, self.begun, self.mute]
        return [client.socket for client in clients]

    def move_while_time_runs(self, moves):
        """Moves to their end, in running time."""
        self.asked.send(moves)
        while self.monitor.get("moving")["moving"]:
            pass
        return self

    def move_in_standing_time(self, *moves):
        """Moves, each to where it ends or is stopped; then time runs."""
        self.monitor.call("pause")
        for move in moves:
            self.asked.send(move)
            self.monitor.settle(after=self.asked)
        self.monitor.call("resume")
        return self


class Idle(unittest.TestCase):
    def test_nothing_wakes_a_robot_at_rest(self):
        with contextlib.ExitStack() as stack:
            case = lambda *options, **more: stack.enter_context(Case(*options, **more))
            cases = {
                "at the soft home": case(),
                "in fast time": case(clock="real:1000"),
                "with the manual clock": case(clock="manual"),
                "with fifty viewers": case(viewers=50),
                "with fifty viewers after a move": case(clock="real:100", viewers=50).move_while_time_runs("E+20\rD-9\r"),
                "as mark3": case("--compat", "mark3"),
                "after a move": case(clock="real:100").move_while_time_runs("E+20\rF+50\rD-9\r"),
                "at a limit": case().move_in_standing_time("A+127\r"),
                "stalled": case().move_in_standing_time("E-120\r", "E-120\r", "E-120\r"),
            }
            self.assertIsNotNone(cases["stalled"].monitor.get("stalled")["stalled"])
            self.assertEqual("limit", cases["at a limit"].monitor.get("tool")["tool"]["blocked"])
            sockets = [sock for case in cases.values() for sock in case.sockets()]
            self.take_all(sockets)
            before = {name: scheduling(case.server.pid) for name, case in cases.items()}
            self.watch(sockets, WATCHED_S)
            after = {name: scheduling(case.server.pid) for name, case in cases.items()}
            self.assertEqual(before, after)
            for case in cases.values():
                case.asked.ask("F?")

    def take_all(self, sockets):
        """Reads what viewers are still sent, until nobody has been sent anything for a while."""
        ends = time.monotonic() + DEADLINE_S
        while ready := select.select(sockets, [], [], LAST_TIMER_S)[0]:
            self.assertLess(time.monotonic(), ends, "they are sent more and more")
            for sock in ready:
                sock.recv(1 << 20)

    def watch(self, sockets, seconds):
        """Measures idleness: this waits for nothing, since nothing may come."""
        self.assertEqual(([], [], []), select.select(sockets, [], [], seconds))


if __name__ == "__main__":
    unittest.main()
