"""A physical controller behind the lines, for minutes: a homing and a pick with `--mirror`, two lines that ask all the
time, and how soon `device_stop` reaches the device. Prints what it has measured."""

import os
import pathlib
import select
import tempfile
import threading
import time
import unittest

from support import Server, counts
from test_device import STOP, Controller, disable, home_and_pick

POLL_S = 0.020
POLLED_S = 60.0
STOPS = 500
STOP_EVERY_S = 0.05
STOP_MS = 20        # docs/monitor.md; on a busy machine, of every second call
STOP_P99_MS = 250
REPLIES = {b"E?": b"R", b"F?": b"'"}


def figures(times_s):
    """p50, p99 and the maximum, in milliseconds."""
    times = sorted(times_s)
    return tuple(1000 * times[min(len(times) - 1, int(len(times) * rank))] for rank in (0.5, 0.99, 1))


def text_of(times_s):
    return "p50 {:.2f}, p99 {:.2f}, max {:.1f} ms".format(*figures(times_s))


class TheMirror(unittest.TestCase):
    def test_a_homing_and_a_pick(self):
        with tempfile.TemporaryDirectory(prefix="xr3-") as folder:
            path = str(pathlib.Path(folder, "arm"))
            with Server("--compat", "mark3", "--pty", path, clock="real") as arm, \
                    Server("--compat", "mark3", "--serial", path, "--mirror", clock="real") as xr3, \
                    arm.monitor() as there, xr3.monitor() as here:
                disable(xr3, xr3.line())
                home_and_pick(xr3, pause_s=0.05)
                for monitor in there, here:
                    while monitor.get("moving")["moving"]:
                        pass
                    self.assertEqual("red", monitor.get("tool")["tool"]["holding"])
                self.assertEqual(counts(there.get()), counts(here.get()))
                codes = [event["code"] for event in here.recall("event")]
                self.assertEqual([], [code for code in codes if code.startswith("mirror_")])


class Poller(threading.Thread):
    """A program that asks every 20 ms, or as soon as it has its reply if that takes longer."""

    def __init__(self, line, inquiry, expected):
        super().__init__()
        self.line, self.inquiry, self.expected = line, inquiry, expected
        self.times_s, self.wrong = [], []

    def run(self):
        due = time.monotonic()
        ends = due + POLLED_S
        while due < ends:
            asked = time.monotonic()
            reply = self.line.ask(self.inquiry)
            answered = time.monotonic()
            self.times_s.append(answered - asked)
            if reply != self.expected:
                self.wrong.append(reply)
            due = max(due + POLL_S, answered)
            select.select([], [], [], max(0, due - time.monotonic()))


class TwoPrograms(unittest.TestCase):
    def test_a_minute_of_inquiries_on_two_lines(self):
        """The counters of the arm, a second xr3 in manual time, differ and stand still."""
        with tempfile.TemporaryDirectory(prefix="xr3-") as folder:
            path = str(pathlib.Path(folder, "arm"))
            with Server("--compat", "mark3", "--pty", path), Server("--serial", path, clock="real") as xr3, \
                    xr3.monitor() as monitor:
                one, two = xr3.line(), xr3.line()
                disable(xr3, one)
                one.send("E+50\r")
                two.send("F+7\r")
                pollers = [Poller(one, "E?", 82), Poller(two, "F?", 39)]
                for poller in pollers:
                    poller.start()
                for poller in pollers:
                    poller.join()
                asked = sum(len(poller.times_s) for poller in pollers)
                print(f"\n{asked} replies on two lines: {text_of([t for poller in pollers for t in poller.times_s])}")
                self.assertEqual([[], []], [poller.wrong for poller in pollers], "a reply for another line")
                self.assertEqual([b"", b""], [line.unread() for line in (one, two)])
                codes = {event.get("code") for event in monitor.recall("event")}
                self.assertEqual(set(), codes & {"device_silent", "device_unasked", "device_lost"})
                device = monitor.get("device")["device"]
                self.assertEqual((2 * asked + len("E+50\rF+7\r"), asked), (device["bytes_out"], device["bytes_in"]))


class TheStop:
    """One loop that plays two programs, which move and ask every 20 ms, and the device, which answers at once; and
    which calls device_stop again and again. So the figures contain no other thread of this process."""

    def __init__(self, xr3, monitor, controller):
        self.monitor, self.controller = monitor, controller
        self.lines = {inquiry: xr3.line() for inquiry in REPLIES}
        disable(xr3, self.lines[b"E?"])
        self.arrived = b""
        self.times_s, self.replies = [], {inquiry: b"" for inquiry in REPLIES}

    def run(self, stops):
        next_poll = next_stop = time.monotonic()
        called = None
        while len(self.times_s) < stops:
            now = time.monotonic()
            if now >= next_poll:
                next_poll = now + POLL_S
                for inquiry, line in self.lines.items():
                    line.send(b"%c+1\r" % inquiry[0] + inquiry)
            if called is None and now >= next_stop:
                called = time.monotonic()
                self.monitor.send({"op": "call", "id": 1, "fn": "device_stop", "args": {}})
            self.take(max(0, min(next_poll, next_stop) - now) if called is None else next_poll - now)
            if called is not None and STOP in self.arrived:
                self.times_s.append(time.monotonic() - called)
                assert self.monitor.read()["ok"]
                self.arrived = self.arrived.replace(STOP, b"")
                called, next_stop = None, called + STOP_EVERY_S

    def take(self, within_s):
        """Handles what arrives at the device and on the lines."""
        sockets = {line.socket: inquiry for inquiry, line in self.lines.items()}
        ready, _, _ = select.select([self.controller.master, *sockets], [], [], max(0, within_s))
        if self.controller.master in ready:
            self.arrived += os.read(self.controller.master, 4096)
            self.answer()
        for sock in ready:
            if sock in sockets:
                self.replies[sockets[sock]] += sock.recv(4096)

    def answer(self):
        while b"?" in self.arrived:
            before, _, self.arrived = self.arrived.partition(b"?")
            self.controller.answer(REPLIES[before[-1:] + b"?"])
            self.arrived = (STOP if STOP in before else b"") + self.arrived


class Stopping(unittest.TestCase):
    def test_a_stop_reaches_the_device_soon(self):
        with Controller() as controller, Server("--serial", controller.path, clock="real") as xr3, \
                xr3.monitor() as monitor:
            stop = TheStop(xr3, monitor, controller)
            stop.run(STOPS)
            print(f"\ndevice_stop to its bytes, {STOPS} calls: {text_of(stop.times_s)}")
            for inquiry, replies in stop.replies.items():
                self.assertEqual(set(REPLIES[inquiry]), set(replies), f"{inquiry} got a reply of the other line")
            p50, p99, _ = figures(stop.times_s)
            self.assertLess(p50, STOP_MS)
            self.assertLess(p99, STOP_P99_MS)


if __name__ == "__main__":
    unittest.main()
