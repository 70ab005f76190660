#!/usr/bin/python3
"""Measures how much one server can serve on this machine, and prints a table in Markdown. The values are
memory and processor time of the server, so that neither the speed of this program nor other programs on the
machine count much.

    capacity.py XR3 [--quick]

With --quick it uses few connections for a short time, to show that it works.
"""

import argparse
import json
import os
import re
import resource
import select
import socket
import subprocess
import sys
import time

HOST = "127.0.0.1"
TIMEOUT_S = 30
INQUIRY = b"E?"
FOLLOW = {"op": "sub", "channel": "state", "max_hz": 60, "on_change": False, "fields": ["joints", "io"]}
TICKS = 600_000


class Server:
    """A running server without a log."""

    def __init__(self, xr3, *options):
        started = time.perf_counter()
        self.process = subprocess.Popen(
            [xr3, "serve", "--robot-port", "0", "--monitor-port", "0", "--log-level", "off", *options],
            stdout=subprocess.PIPE, text=True)
        greeting = self.process.stdout.readline()
        self.start_s = time.perf_counter() - started
        self.robot_port, self.monitor_port = map(int, re.findall(r":(\d+)\b", greeting))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(TIMEOUT_S)
        self.process.stdout.close()

    def cpu_s(self):
        return time.clock_gettime(cpu_clock(self.process.pid))

    def resident_kib(self):
        with open(f"/proc/{self.process.pid}/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 1024


def cpu_clock(pid):
    """The clock of a process's processor time, as clock_getcpuclockid(3) makes it."""
    return (~pid << 3) | 2


def connect(port):
    sock = socket.create_connection((HOST, port), TIMEOUT_S)
    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return sock


def read(sock, count):
    data = b""
    while len(data) < count:
        part = sock.recv(count - len(data))
        if not part:
            raise EOFError("the server has closed a connection")
        data += part
    return data


def request(sock, message):
    """Sends a request; returns the next line that is an answer to it."""
    sock.sendall(json.dumps({"id": 1, **message}).encode() + b"\n")
    data = b""
    while True:
        data += sock.recv(65536)
        for line in data.split(b"\n")[:-1]:
            if json.loads(line).get("id") == 1:
                return json.loads(line)


def close(socks):
    for sock in socks:
        sock.close()


def measure_start(xr3, report, _):
    times = []
    for _ in range(5):
        with Server(xr3) as server:
            times.append(server.start_s)
            idle = server.resident_kib()
    report("start until clients can connect", f"{min(times) * 1000:.0f} ms")
    report("memory of an idle server", f"{idle / 1024:.1f} MiB")


def measure_lines(xr3, report, scale):
    with Server(xr3, "--max-lines", str(scale.lines)) as server:
        before = server.resident_kib()
        lines = [connect(server.robot_port) for _ in range(scale.lines)]
        for line in lines:
            line.sendall(INQUIRY)
        for line in lines:
            read(line, 1)
        report("memory of a line", f"{(server.resident_kib() - before) / scale.lines:.1f} KiB")
        spent, count = server.cpu_s(), 0
        ends = time.monotonic() + scale.seconds
        while time.monotonic() < ends:
            for line in lines:
                line.sendall(INQUIRY)
            for line in lines:
                read(line, 1)
            count += len(lines)
        per_inquiry = (server.cpu_s() - spent) / count
        close(lines)
    report("an inquiry and its reply", f"{per_inquiry * 1e6:.1f} µs")
    report("inquiries a second, on one processor", f"{1 / per_inquiry:,.0f}")


def measure_opening(xr3, report, scale):
    with Server(xr3) as server:
        spent, count = server.cpu_s(), 0
        ends = time.monotonic() + scale.seconds
        while time.monotonic() < ends:
            with connect(server.robot_port) as line:
                line.sendall(INQUIRY)
                read(line, 1)
            count += 1
        each = (server.cpu_s() - spent) / count
    report("to open a line, ask once and close it", f"{each * 1e6:.0f} µs")


def count_lines(socks, seconds):
    """The number of messages that arrive on all connections in this time."""
    poll = select.epoll()
    by_number = {sock.fileno(): sock for sock in socks}
    for number in by_number:
        poll.register(number, select.EPOLLIN)
    count = 0
    ends = time.monotonic() + seconds
    while (left := ends - time.monotonic()) > 0:
        for number, _ in poll.poll(left):
            count += by_number[number].recv(1 << 18).count(b"\n")
    poll.close()
    return count


def measure_sessions(xr3, report, scale):
    with Server(xr3) as server:
        before = server.resident_kib()
        sessions = [connect(server.monitor_port) for _ in range(scale.sessions)]
        for session in sessions:
            request(session, {"op": "ping"})
        report("memory of a monitor session", f"{(server.resident_kib() - before) / scale.sessions:.0f} KiB")
        for session in sessions:
            session.sendall(json.dumps(FOLLOW).encode() + b"\n")
        count_lines(sessions, 0.3)
        spent = server.cpu_s()
        messages = count_lines(sessions, scale.seconds)
        per_message = (server.cpu_s() - spent) / messages
        close(sessions)
    report("a `state` message to a subscriber", f"{per_message * 1e6:.1f} µs")
    report("subscribers of `state` at 60 Hz, on one processor", f"{1 / per_message / 60:,.0f}")


def measure_time(xr3, report, scale):
    """Simulated time while six motors move: the moves are renewed before they end."""
    with Server(xr3, "--clock", "manual") as server, connect(server.monitor_port) as monitor, \
            connect(server.robot_port) as line:
        request(monitor, {"op": "ping"})
        spent, ticks = server.cpu_s(), 0
        sign = "+"
        while ticks < scale.ticks:
            line.sendall("".join(f"{label}{sign}90\r" for label in "BCDEF").encode())
            done = request(monitor, {"op": "call", "fn": "run_until",
                                     "args": {"idle": True, "max_ticks": 60_000, "fields": []}})
            ticks += done["value"]["ran_ticks"]
            sign = "-" if sign == "+" else "+"
        each = (server.cpu_s() - spent) / ticks
    report("a second of motion of five joints, with its commands", f"{each * 1000 * 1e6:.0f} µs")


def measure_http(xr3, report, scale):
    with Server(xr3) as server, connect(server.monitor_port) as sock, sock.makefile("rb") as file:
        for path in "/state", "/metrics", "/view.svg", "/camera.png":
            spent, count = server.cpu_s(), 0
            ends = time.monotonic() + scale.seconds / 4
            while time.monotonic() < ends:
                sock.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
                head = b"".join(iter(file.readline, b"\r\n")).lower()
                file.read(int(re.search(rb"content-length: (\d+)", head)[1]))
                count += 1
            report(f"`GET {path}`", f"{(server.cpu_s() - spent) / count * 1e6:.0f} µs")


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        found = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE)
    return found[1] if found else "unknown"


class Scale:
    def __init__(self, is_quick):
        self.lines, self.sessions = (50, 20) if is_quick else (1000, 500)
        self.seconds = 0.2 if is_quick else 3
        self.ticks = TICKS // (60 if is_quick else 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("xr3", help="the executable to measure")
    parser.add_argument("--quick", action="store_true", help="few connections, a short time")
    given = parser.parse_args()
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
    print(f"Processor: {processor()}; the server uses one of {os.cpu_count()}.\n")
    print("| what | cost or capacity |\n|---|---|")
    for measure in (measure_start, measure_lines, measure_opening, measure_sessions, measure_time, measure_http):
        measure(given.xr3, lambda what, value: print(f"| {what} | {value} |", flush=True), Scale(given.quick))


if __name__ == "__main__":
    sys.exit(main())
