#!/usr/bin/python3
"""A well-behaved client in a process of its own: sends an inquiry each millisecond, or a ping each five milliseconds,
whether or not the replies to the earlier ones have arrived. Prints how long the replies took, and how long the server
worked meanwhile: its processor time does not depend on other programs on the machine.
Usage: victim.py PORT PID SECONDS line|session"""

import collections
import ctypes
import gc
import json
import os
import select
import socket
import struct
import sys
import time

PATIENCE_NS = 60 * 10**9
SO_TIMESTAMPNS = 35
PERF_EVENT_OPEN = {"x86_64": 298, "aarch64": 241}
PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK, PERF_ATTR_SIZE = 1, 1, 64


def processor_clock(pid):
    """A function that returns the processor time of a process's main thread, in nanoseconds: see perf_event_open(2)
    (a counter of software, the task clock). Where that is not allowed, the clock of the whole process, which the kernel
    advances every 4 ms."""
    attributes = struct.pack("IIQ", PERF_TYPE_SOFTWARE, PERF_ATTR_SIZE, PERF_COUNT_SW_TASK_CLOCK)
    number = PERF_EVENT_OPEN.get(os.uname().machine, -1)
    descriptor = ctypes.CDLL(None).syscall(number, attributes.ljust(PERF_ATTR_SIZE, b"\0"), pid, -1, -1, 0)
    if descriptor >= 0:
        return lambda: int.from_bytes(os.read(descriptor, 8), sys.byteorder)
    clock = (~pid << 3) | 2  # as clock_getcpuclockid(3)
    return lambda: time.clock_gettime_ns(clock)


class Line:
    """Receives replies with the time of their arrival in the kernel, before this process is awake. The line has had its
    first reply: a new connection waits in the kernel behind those that came before it."""

    EVERY_NS = 1_000_000
    REQUEST = b"E?"
    FIRST_REPLIES = 1

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.send()
        first = 0
        while first < self.FIRST_REPLIES:
            first += self.read()[0]

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


class Session(Line):
    """The same on the monitor port, with pings, of which a turn of the server handles one. The first reply is
    `hello`."""

    EVERY_NS = 5_000_000
    REQUEST = b'{"op":"ping"}\n'
    FIRST_REPLIES = 2

    @staticmethod
    def count(data):
        return data.count(b"\n")


def waits_ns(line, pid, seconds):
    """For each reply: its time, and the server's processor time meanwhile."""
    worked = processor_clock(pid)
    sent, waits = collections.deque(), []
    due = time.time_ns()
    ends = due + int(seconds * 10**9)
    while (now := time.time_ns()) < ends or sent:
        if now > ends + PATIENCE_NS:
            return waits + [(now - each, 0) for each, _ in sent]
        if due <= now < ends:
            sent.append((time.time_ns(), worked()))
            line.send()
            due = max(due + line.EVERY_NS, now)
        left_s = (due - time.time_ns()) / 1e9 if now < ends else 1.0
        if select.select([line.socket], [], [], max(left_s, 0))[0]:
            work = worked()
            count, arrived = line.read()
            for _ in range(count):
                sent_at, worked_before = sent.popleft()
                waits.append((arrived - sent_at, min(work - worked_before, arrived - sent_at)))
    return waits


def quantiles(values):
    """p50, p99 and maximum, in milliseconds."""
    values = sorted(values)
    at = lambda rank: values[min(len(values) - 1, int(len(values) * rank))] / 1e6
    return {"p50": at(0.5), "p99": at(0.99), "max": at(1)}


def main():
    gc.disable()
    _, port, pid, seconds, kind = sys.argv
    waits = waits_ns((Line if kind == "line" else Session)(int(port)), int(pid), float(seconds))
    print(json.dumps({"waits": quantiles(wait for wait, _ in waits), "work": quantiles(work for _, work in waits)}))


if __name__ == "__main__":
    main()
