#!/usr/bin/python3
"""A well-behaved client in a process of its own: sends an inquiry each millisecond, or a ping each five milliseconds,
whether or not the replies to the earlier ones have arrived, or one step of time after another. For each line of its
input it does so for some seconds on a connection of its own, and prints how long the event loop of the server ran
between an inquiry and its reply (other programs on the machine do not change that), and how long the reply took.
Usage: victim.py PORT PID SECONDS line|pty|session|step. PORT is a path for `pty`."""

import collections
import ctypes
import gc
import json
import math
import os
import select
import socket
import struct
import sys
import time

from target import LOCALHOST

PATIENCE_NS = 60 * 10**9
SO_TIMESTAMPNS = 35
# A client that sends each millisecond has many segments in flight if each reply takes some. The kernel allows ten in a
# new connection, and four with BBR, which some machines use: then it, not the server, makes an inquiry wait for several
# replies. With Reno, a few bursts of inquiries enlarge that number.
CONGESTION_CONTROL = b"reno"
BURST = 32
PERF_EVENT_OPEN = {"x86_64": 298, "aarch64": 241}
PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK, PERF_ATTR_SIZE = 1, 1, 64


def processor_clock(pid):
    """A function that returns the time for which a process's main thread, the event loop of the server, has run, in
    nanoseconds: see perf_event_open(2) (a counter of software, the task clock). Where that is not allowed, from
    /proc/PID/schedstat, which the kernel advances at each switch of threads and each tick (mostly 4 ms)."""
    attributes = struct.pack("IIQ", PERF_TYPE_SOFTWARE, PERF_ATTR_SIZE, PERF_COUNT_SW_TASK_CLOCK)
    number = PERF_EVENT_OPEN.get(os.uname().machine, -1)
    descriptor = ctypes.CDLL(None).syscall(number, attributes.ljust(PERF_ATTR_SIZE, b"\0"), pid, -1, -1, 0)
    if descriptor >= 0:
        return lambda: int.from_bytes(os.read(descriptor, 8), sys.byteorder)
    schedstat = os.open(f"/proc/{pid}/schedstat", os.O_RDONLY)
    return lambda: int(os.pread(schedstat, 64, 0).split()[0])


class Line:
    """Receives replies with the time of their arrival in the kernel, before this process is awake. The line has had its
    first reply: a new connection waits in the kernel behind those that came before it."""

    EVERY_NS = 1_000_000
    REQUEST = b"E?"
    FIRST_REPLIES = 1
    BURSTS = 4  # before the measurement, see CONGESTION_CONTROL
    HAS_ONE_AT_A_TIME = False

    def __init__(self, port):
        self.socket = socket.socket()
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_CONGESTION, CONGESTION_CONTROL)
        self.socket.connect((LOCALHOST, int(port)))
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.send()
        self.read_replies(self.FIRST_REPLIES)
        for _ in range(self.BURSTS):
            for _ in range(BURST):
                self.send()
            self.read_replies(BURST)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def read_replies(self, count):
        while count > 0:
            count -= self.read()[0]

    def send(self):
        self.socket.sendall(self.REQUEST)

    @staticmethod
    def count(data):
        """The number of replies in the data."""
        return len(data)

    def read(self):
        """(number of replies, time of arrival)"""
        data, notes, _, _ = self.socket.recvmsg(4096, 256)
        if not data:
            raise EOFError("the server has closed the line of the well-behaved client")
        for level, kind, value in notes:
            if (level, kind) == (socket.SOL_SOCKET, SO_TIMESTAMPNS):
                seconds, nanoseconds = struct.unpack("qq", value)
                return self.count(data), seconds * 10**9 + nanoseconds
        return self.count(data), time.time_ns()


class Pty(Line):
    """Inquiries on a pseudo-terminal, which does not report the time of arrival: replies count from when they are read."""

    def __init__(self, path):
        self.socket = open(path, "r+b", buffering=0, opener=lambda path, flags: os.open(path, flags | os.O_NOCTTY))
        self.send()
        self.read_replies(self.FIRST_REPLIES)

    def send(self):
        self.socket.write(self.REQUEST)

    def read(self):
        data = self.socket.read(4096)
        return self.count(data), time.time_ns()


class Session(Line):
    """Pings on the monitor port, one a turn of the server. The first reply is `hello`."""

    EVERY_NS = 5_000_000
    REQUEST = b'{"op":"ping"}\n'
    FIRST_REPLIES = 2
    BURSTS = 0

    @staticmethod
    def count(data):
        return data.count(b"\n")


class Step(Session):
    """Steps of time on the monitor port, each sent some time after the answer to the last one."""

    EVERY_NS = 50_000_000
    HAS_ONE_AT_A_TIME = True
    REQUEST = b'{"op":"call","id":1,"fn":"step","args":{"ticks":1,"fields":[]}}\n'


class Probe:
    """A line, its inquiries that wait for their replies, and for each reply its time and what `worked` advanced by
    meanwhile. This process may read a reply late: then the server has gone on working, but the time of the kernel's
    arrival limits what counts."""

    def __init__(self, line, worked):
        self.line, self.worked = line, worked
        self.sent, self.waits = collections.deque(), []
        self.due = time.time_ns()

    def send(self, now):
        self.sent.append((time.time_ns(), self.worked()))
        self.line.send()
        self.due = math.inf if self.line.HAS_ONE_AT_A_TIME else max(self.due + self.line.EVERY_NS, now)

    def read(self):
        work = self.worked()
        count, arrived = self.line.read()
        for _ in range(count):
            sent_at, worked_before = self.sent.popleft()
            self.waits.append((arrived - sent_at, min(work - worked_before, arrived - sent_at)))
        self.due = min(self.due, time.time_ns() + self.line.EVERY_NS)

    def measure(self, seconds):
        """Asks for these seconds, and waits for the last replies."""
        ends = time.time_ns() + int(seconds * 10**9)
        while (now := time.time_ns()) < ends or self.sent:
            if now > ends + PATIENCE_NS:
                raise TimeoutError(f"{len(self.sent)} inquiries of the well-behaved client have no reply")
            if self.due <= now < ends:
                self.send(now)
            left_s = (self.due - time.time_ns()) / 1e9 if now < ends else 1.0
            if select.select([self.line.socket], [], [], min(max(left_s, 0), 1.0))[0]:
                self.read()


def quantiles(values):
    """p50, p99 and maximum, in milliseconds."""
    values = sorted(values)
    at = lambda rank: values[min(len(values) - 1, int(len(values) * rank))] / 1e6
    return {"p50": at(0.5), "p99": at(0.99), "max": at(1)}


def figures(opener, worked, seconds):
    """A round."""
    with opener() as line:
        probe = Probe(line, worked)
        probe.measure(seconds)
    waits, work = zip(*probe.waits)
    return {"waits": quantiles(waits), "work": quantiles(work)}


KINDS = {"line": Line, "pty": Pty, "session": Session, "step": Step}


def main():
    gc.disable()
    _, port, pid, seconds, kind = sys.argv
    worked = processor_clock(int(pid))
    for _ in sys.stdin:
        print(json.dumps(figures(lambda: KINDS[kind](port), worked, float(seconds))), flush=True)


if __name__ == "__main__":
    main()
