"""A robot at rest uses no processor time: even with connected clients and a running clock, the kernel never
schedules the process. All cases are observed at the same time, each with its own server."""
# labels: release serial full

import contextlib
import os
import select
import tempfile
import time
import unittest

from support import DEADLINE_S, Server

WATCHED_S = 10.0
# A timer that was started while something moved expires once more, within this time.
LAST_TIMER_S = 1.2


def scheduling(pid):
    """(processor time in nanoseconds, context switches) of all threads of a process."""
    ran = switches = 0
    for thread in os.listdir(f"/proc/{pid}/task"):
        with open(f"/proc/{pid}/task/{thread}/schedstat", encoding="ascii") as file:
            ran += int(file.read().split()[0])
        with open(f"/proc/{pid}/task/{thread}/status", encoding="ascii") as file:
            switches += sum(int(row.split()[1]) for row in file if "ctxt_switches" in row)
    return ran, switches


class Case:
    """A server with a monitor client and three lines: after an inquiry, with half a command, and silent."""

    CHANNELS = ("state", "image", "display", "model", "event", "line")

    def __init__(self, *options, clock="real", viewers=0):
        self.server = Server(*options, clock=clock)
        self.viewer_count = viewers
        self.program = None

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
        if self.program is not None:
            os.close(self.program)
        for monitor in [self.monitor, *self.viewers]:
            monitor.close()
        self.server.__exit__(*problem)

    def sockets(self):
        clients = [self.monitor, *self.viewers, self.asked, self.begun, self.mute]
        return [client.socket for client in clients]

    def leave_replies_unread(self):
        """A program writes to the pseudo-terminal until nothing is taken any more, and reads nothing."""
        self.program = os.open(self.server.ptys[0], os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        while select.select([], [self.program], [], LAST_TIMER_S)[1]:
            try:
                os.write(self.program, b"E?" * 1000)
            except BlockingIOError:  # less room than one write needs
                break
        return self

    def move_while_time_runs(self, moves):
        """Sends moves with the clock running and waits until they are done."""
        self.asked.send(moves)
        while self.monitor.get("moving")["moving"]:
            pass
        return self

    def move_in_standing_time(self, *moves):
        """Sends moves with the manual clock, each until it is done or blocked; then starts the clock."""
        self.monitor.call("pause")
        for move in moves:
            self.asked.send(move)
            self.monitor.settle(after=self.asked)
        self.monitor.call("resume")
        return self


class Idle(unittest.TestCase):
    def test_a_robot_at_rest_does_not_wake_up(self):
        with contextlib.ExitStack() as stack:
            case = lambda *options, **more: stack.enter_context(Case(*options, **more))
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="xr3-"))
            cases = {
                "at the soft home": case(),
                "in fast time": case(clock="real:1000"),
                "with the manual clock": case(clock="manual"),
                "with fifty viewers": case(viewers=50),
                "with fifty viewers after a move": case(clock="real:100", viewers=50).move_while_time_runs("E+20\rD-9\r"),
                "as mark3": case("--compat", "mark3"),
                "after a move": case(clock="real:100").move_while_time_runs("E+20\rF+50\rD-9\r"),
                "at a limit": case().move_in_standing_time("A-127\r"),
                "with a pseudo-terminal": case("--pty", f"{folder}/free"),
                "with unread replies": case("--pty", f"{folder}/rhino").leave_replies_unread(),
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
        """Reads from all sockets until none has received anything for LAST_TIMER_S."""
        ends = time.monotonic() + DEADLINE_S
        while ready := select.select(sockets, [], [], LAST_TIMER_S)[0]:
            self.assertLess(time.monotonic(), ends, "the server does not stop sending")
            for sock in ready:
                sock.recv(1 << 20)

    def watch(self, sockets, seconds):
        """Checks that no socket receives anything for this time."""
        self.assertEqual(([], [], []), select.select(sockets, [], [], seconds))


if __name__ == "__main__":
    unittest.main()
