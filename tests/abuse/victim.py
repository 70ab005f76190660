#!/usr/bin/python3
"""A well-behaved client in a process of its own: sends an inquiry each millisecond, or a ping each five milliseconds,
whether or not the replies to the earlier ones have arrived, or one step of time after another. For each line of its
input it does so for some seconds on a connection of its own, and prints how long the replies took, how long the server
worked meanwhile (its processor time does not depend on other programs on the machine), and how long the slowest
bystander took: on each core, and on a pseudo-terminal if that is asked for, an idle program echoes what it gets.
Usage: victim.py PORT PID SECONDS line|pty|session|step ADDRESS [pty]. It connects from the ADDRESS. PORT is a path for
`pty`."""

import collections
import ctypes
import gc
import json
import math
import os
import pathlib
import select
import socket
import struct
import subprocess
import sys
import time

from target import LOCALHOST

ECHO = pathlib.Path(__file__).with_name("echo.py")
PATIENCE_NS = 60 * 10**9
SO_TIMESTAMPNS = 35
# A client that sends each millisecond has many segments in flight if each reply takes some. The kernel allows ten in a
# new connection, and four with BBR, which some machines use: then it, not the server, makes an inquiry wait for several
# replies. With Reno, a few bursts of inquiries enlarge that number.
CONGESTION_CONTROL = b"reno"
BURST = 32
PERF_EVENT_OPEN = {"x86_64": 298, "aarch64": 241}
PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK, PERF_ATTR_SIZE = 1, 1, 64


def process_clock(pid):
    """A function that returns the processor time of a process, in nanoseconds: see clock_getcpuclockid(3)."""
    clock = (~pid << 3) | 2
    return lambda: time.clock_gettime_ns(clock)


def processor_clock(pid):
    """A function that returns the processor time of a process's main thread, in nanoseconds: see perf_event_open(2)
    (a counter of software, the task clock). Where that is not allowed, the clock of the whole process, which the kernel
    advances every 4 ms."""
    attributes = struct.pack("IIQ", PERF_TYPE_SOFTWARE, PERF_ATTR_SIZE, PERF_COUNT_SW_TASK_CLOCK)
    number = PERF_EVENT_OPEN.get(os.uname().machine, -1)
    descriptor = ctypes.CDLL(None).syscall(number, attributes.ljust(PERF_ATTR_SIZE, b"\0"), pid, -1, -1, 0)
    if descriptor >= 0:
        return lambda: int.from_bytes(os.read(descriptor, 8), sys.byteorder)
    return process_clock(pid)


class Line:
    """Receives replies with the time of their arrival in the kernel, before this process is awake. The line has had its
    first reply: a new connection waits in the kernel behind those that came before it."""

    EVERY_NS = 1_000_000
    REQUEST = b"E?"
    FIRST_REPLIES = 1
    BURSTS = 4  # before the measurement, see CONGESTION_CONTROL
    HAS_ONE_AT_A_TIME = False

    def __init__(self, port, address=LOCALHOST):
        self.socket = socket.socket()
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_CONGESTION, CONGESTION_CONTROL)
        self.socket.bind((address, 0))
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
    """The same on a pseudo-terminal, which does not tell when replies arrived: the time is that at which they are read."""

    def __init__(self, path, _):
        self.socket = open(path, "r+b", buffering=0, opener=lambda path, flags: os.open(path, flags | os.O_NOCTTY))
        self.send()
        self.read_replies(self.FIRST_REPLIES)

    def send(self):
        self.socket.write(self.REQUEST)

    def read(self):
        data = self.socket.read(4096)
        return self.count(data), time.time_ns()


class Session(Line):
    """The same on the monitor port, with pings, of which a turn of the server handles one. The first reply is
    `hello`."""

    EVERY_NS = 5_000_000
    REQUEST = b'{"op":"ping"}\n'
    FIRST_REPLIES = 2
    BURSTS = 0

    @staticmethod
    def count(data):
        return data.count(b"\n")


class Step(Session):
    """The same with steps of time, each of which is sent some time after the answer to the last one."""

    EVERY_NS = 50_000_000
    HAS_ONE_AT_A_TIME = True
    REQUEST = b'{"op":"call","id":1,"fn":"step","args":{"ticks":1,"fields":[]}}\n'


class Bystander(Line):
    """The same from an idle process on one core that does not know the server: what it waits, the machine costs."""

    EVERY_NS = 2_000_000
    REQUEST = b"?"
    BURSTS = 0

    def __init__(self, core):
        self.process = subprocess.Popen([sys.executable, ECHO, str(core)], stdout=subprocess.PIPE)
        super().__init__(int(self.process.stdout.readline()))

    def end(self):
        self.process.kill()
        self.process.communicate()


class PtyBystander(Pty):
    """The same on a pseudo-terminal."""

    EVERY_NS = 2_000_000
    REQUEST = b"?"

    def __init__(self):
        self.process = subprocess.Popen([sys.executable, ECHO, "pty"], stdout=subprocess.PIPE)
        super().__init__(self.process.stdout.readline().decode().strip(), None)

    end = Bystander.end


class Probe:
    """A line, its inquiries that wait for their replies, and for each reply its time and what `worked` advanced by
    meanwhile."""

    def __init__(self, line, worked=lambda: 0):
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

    def give_up(self, now):
        self.waits += [(now - each, 0) for each, _ in self.sent]


def measure(probes, seconds):
    """Lets the probes ask for so long, and waits for the last replies."""
    ends = time.time_ns() + int(seconds * 10**9)
    by_socket = {each.line.socket: each for each in probes}
    while (now := time.time_ns()) < ends or any(each.sent for each in probes):
        if now > ends + PATIENCE_NS:
            for each in probes:
                each.give_up(now)
            return
        for each in probes:
            if each.due <= now < ends:
                each.send(now)
        left_s = (min(each.due for each in probes) - time.time_ns()) / 1e9 if now < ends else 1.0
        for readable in select.select(list(by_socket), [], [], max(left_s, 0))[0]:
            by_socket[readable].read()


def quantiles(values):
    """p50, p99 and maximum, in milliseconds."""
    values = sorted(values)
    at = lambda rank: values[min(len(values) - 1, int(len(values) * rank))] / 1e6
    return {"p50": at(0.5), "p99": at(0.99), "max": at(1)}


def figures(opener, worked, bystanders, seconds):
    """A round."""
    with opener() as line:
        server = Probe(line, worked)
        probes = [Probe(each) for each in bystanders]
        measure([server, *probes], seconds)
    waits, work = zip(*server.waits)
    return {"waits": quantiles(waits), "work": quantiles(work),
            "bystander": max((quantiles(wait for wait, _ in each.waits) for each in probes),
                             key=lambda each: each["p99"])}


KINDS = {"line": Line, "pty": Pty, "session": Session, "step": Step}


def main():
    gc.disable()
    _, port, pid, seconds, kind, address, *more = sys.argv
    opener = lambda: KINDS[kind](port, address)
    bystanders = [Bystander(core) for core in os.sched_getaffinity(0)]
    if more == ["pty"]:
        bystanders.append(PtyBystander())
    worked = processor_clock(int(pid))
    for _ in sys.stdin:
        print(json.dumps(figures(opener, worked, bystanders, float(seconds))), flush=True)
    for each in bystanders:
        each.end()


if __name__ == "__main__":
    main()
