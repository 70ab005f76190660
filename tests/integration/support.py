"""Helpers of the integration tests: a running xr3, a serial line over TCP, and a monitor client (JSON lines).

Nothing here sleeps. A test advances time with Monitor.step, or waits for an event (a byte, an end of file,
the exit of a process, a line of the log) with a deadline. Only a failing test waits until the deadline.
"""

import collections
import errno
import json
import os
import re
import signal
import socket
import struct
import subprocess
import threading
import time

import monitor_schema

XR3 = os.environ["XR3"]
ROOT = os.environ["XR3_ROOT"]
DEADLINE_S = 20.0
SHUTDOWN_S = 2.0  # guaranteed by xr3
LOCALHOST = "127.0.0.1"
MOST_COUNTS_A_MOVE = 100
# For tests of memory: without the sanitizer's quarantine of freed memory, which would count.
NO_QUARANTINE = {"ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "")
                 + ":quarantine_size_mb=0:thread_local_quarantine_size_kb=0"}


def has_sandbox():
    """Whether bubblewrap is there and may make its namespaces: not so in some containers."""
    try:
        return subprocess.run(["bwrap", "--ro-bind", "/", "/", "--unshare-user", "--unshare-pid", "--proc", "/proc", "true"],
                              check=False, capture_output=True).returncode == 0
    except FileNotFoundError:
        return False


HAS_SANDBOX = has_sandbox()
GRADE = ("grade",) if HAS_SANDBOX else ("grade", "--no-sandbox")  # the command, as this machine allows it


def run_xr3(*arguments, **options):
    """Runs xr3 until it exits; returns the result, with text output."""
    return subprocess.run([XR3, *map(str, arguments)], capture_output=True, text=True,
                          timeout=DEADLINE_S, check=False, **options)


def connect(port, buffer_bytes=None, machine=None):
    """A connected TCP socket whose operations raise TimeoutError after the deadline. To the server, `machine`, an
    address of loopback but LOCALHOST, is another machine."""
    sock = socket.socket()
    if machine is not None:
        sock.bind((machine, 0))
    if buffer_bytes is not None:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer_bytes)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, buffer_bytes)
    sock.settimeout(DEADLINE_S)
    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    sock.connect((LOCALHOST, port))
    return sock


class Server:
    """A context manager for a running `xr3 serve` on two free ports. At the end SIGTERM must stop it with
    exit code 0.

    `with Server("--compat", "mark3") as xr3:` is at tick 0, with the manual clock by default. `command` is
    the command line to which the options are added.
    """

    def __init__(self, *options, clock="manual", environment=None, command=(XR3, "serve"), pass_fds=()):
        self.command = list(map(str, command))
        self.options = ["--robot-port", "0", "--monitor-port", "0", "--clock", clock, *map(str, options)]
        self.environment = {**os.environ, **(environment or {})}
        self.pass_fds = pass_fds
        self.lines = []
        self._log = ""
        self._log_grew = threading.Condition()

    def __enter__(self):
        self.process = subprocess.Popen(
            [*self.command, *self.options], cwd=ROOT, env=self.environment, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, pass_fds=self.pass_fds)
        self.pid = self.process.pid
        self._log_reader = threading.Thread(target=self._read_log, daemon=True)
        self._log_reader.start()
        try:
            self._read_ports()
        except BaseException:
            self.process.kill()
            self.process.wait()
            raise
        return self

    def _read_ports(self):
        watchdog = threading.Timer(DEADLINE_S, self.process.kill)
        watchdog.start()
        self.greeting = self.process.stdout.readline()
        watchdog.cancel()
        ports = re.fullmatch(r"LISTENING robot=\S+:(\d+) monitor=\S+:(\d+)((?: pty=\S+)*)\n", self.greeting)
        if not ports:
            self.process.kill()
            self._log_reader.join()
            raise AssertionError(f"xr3 did not start: {self.greeting!r}\n{self._log}")
        self.robot_port, self.monitor_port = map(int, ports.groups()[:2])
        self.ptys = re.findall(r"pty=(\S+)", ports[3])

    def _read_log(self):
        for line in self.process.stderr:
            with self._log_grew:
                self._log += line
                self._log_grew.notify_all()

    def __exit__(self, kind, error, trace):
        if kind is not None:
            self.process.kill()
            self.process.wait()
            self._log_reader.join()
            print(f"--- log of xr3 {' '.join(self.options)}\n{self._log}---")
        elif self.process.poll() is None:
            code = self.stop(within_s=DEADLINE_S)  # the leak check is slow on a busy machine
            assert code == 0, f"xr3 ended with {code}\n{self._log}"
        self.process.stdout.close()
        self.process.stderr.close()
        for line in self.lines:
            line.close()

    def stop(self, how=signal.SIGTERM, within_s=SHUTDOWN_S, meanwhile=lambda: None):
        """Stops the server with a signal; returns its exit code. Fails if it takes longer than `within_s`."""
        started = time.monotonic()
        self.process.send_signal(how)
        meanwhile()
        try:
            code = self.process.wait(DEADLINE_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise AssertionError(f"xr3 did not end after signal {how}\n{self._log}") from None
        took = time.monotonic() - started
        self._log_reader.join()
        assert took < within_s, f"xr3 took {took:.2f} s to end\n{self._log}"
        rest = self.process.stdout.read()
        assert rest == "", f"more than one line on standard output: {rest!r}"
        return code

    def log(self):
        with self._log_grew:
            return self._log

    def wait_log(self, pattern, times=1):
        """Waits until the log has `times` matches of the pattern; returns the log."""
        with self._log_grew:
            found = self._log_grew.wait_for(
                lambda: len(re.findall(pattern, self._log)) >= times, DEADLINE_S)
            assert found, f"not {times} of {pattern!r} in the log:\n{self._log}"
            return self._log

    def page(self):
        """The line that names the page."""
        opened = r"(?m)^xr3: open \S+\n"
        return re.findall(opened, self.wait_log(opened))[0]

    def line(self, **options):
        """Opens a serial line. Its number counts the calls of this method, so open all lines with it."""
        self.lines.append(Line(connect(self.robot_port, **options), len(self.lines) + 1))
        return self.lines[-1]

    def monitor(self):
        return Monitor(self.monitor_port)

    def status(self, name):
        """A number from /proc/PID/status, such as VmRSS (KiB) or voluntary_ctxt_switches."""
        with open(f"/proc/{self.pid}/status", encoding="ascii") as file:
            return int(re.search(rf"^{name}:\s+(\d+)", file.read(), re.MULTILINE).group(1))


class Line:
    """A serial line: a raw socket to the robot port. `sent` counts the bytes written to it."""

    def __init__(self, sock, number=None):
        self.socket = sock
        self.number = number
        self.sent = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def send(self, data):
        data = data.encode("ascii") if isinstance(data, str) else data
        self.socket.sendall(data)
        self.sent += len(data)

    def read(self, count):
        """Reads exactly `count` reply bytes; EOFError if the server closes before."""
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise EOFError(f"closed after {data!r}")
            data += part
        return data

    def ask(self, inquiry):
        """Sends an inquiry; returns its reply, one byte, as a number."""
        self.send(inquiry)
        return self.read(1)[0]

    def read_to_end(self):
        """Reads until the server closes the connection; a reset counts as a close."""
        data = b""
        try:
            while part := self.socket.recv(65536):
                data += part
        except (ConnectionResetError, BrokenPipeError):
            pass
        return data

    def unread(self):
        """Reads the bytes that have arrived, without waiting: b"" if there are none, None if closed."""
        self.socket.setblocking(False)
        try:
            return self.socket.recv(65536) or None
        except BlockingIOError:
            return b""
        except ConnectionResetError:
            return None
        finally:
            self.socket.settimeout(DEADLINE_S)

    def finish_sending(self):
        """Closes the sending side; nothing to do if the server has closed the connection with a reset already."""
        try:
            self.socket.shutdown(socket.SHUT_WR)
        except OSError as error:
            if error.errno != errno.ENOTCONN:
                raise

    def abort(self):
        """Closes with a TCP reset."""
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.socket.close()

    def close(self):
        self.socket.close()


class MonitorError(Exception):
    """A result with ok: false."""

    def __init__(self, error):
        super().__init__(f"{error['code']}: {error['message']} ({error['hint']})")
        self.code, self.message, self.hint = error["code"], error["message"], error["hint"]
        self.details = error["details"]


class Monitor:
    """A client of the monitor port (JSON lines). It sends first, so that it receives `hello` at once.
    Each received message must conform to a strict copy of data/schema/monitor-v1.schema.json."""

    def __init__(self, port, buffer_bytes=None):
        self.socket = connect(port, buffer_bytes)
        self._file = self.socket.makefile("rb")
        self._last_id = 0
        self._kept = collections.deque()  # messages that arrived before the answer to a request
        self._subscribed = False
        self._partial = set()  # channels requested with `fields`
        self.send({"op": "ping", "id": 0})
        self.hello = self.read()
        assert self.hello["op"] == "hello", self.hello
        assert self.read() == {"op": "pong", "id": 0}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._file.close()
        self.socket.close()

    def send(self, message):
        """Sends an object as a JSON line, or bytes unchanged."""
        data = message if isinstance(message, bytes) else json.dumps(message).encode() + b"\n"
        self.socket.sendall(data)

    def read(self, is_whole=None):
        """The next message, or None at the end of the stream. With is_whole=False members may be missing,
        because `fields` selected some of them."""
        if self._kept:
            return self._kept.popleft()
        line = self.read_line()
        return self._checked(json.loads(line), is_whole) if line else None

    def _checked(self, message, is_whole=None):
        if is_whole is None:
            is_whole = message.get("op") not in self._partial
        return monitor_schema.check(message, is_whole)

    def read_line(self):
        return self._file.readline()

    def read_until(self, is_last):
        """The messages up to and including the first for which is_last(message) is true."""
        messages = []
        while not messages or not is_last(messages[-1]):
            messages.append(self.read())
            assert messages[-1] is not None, f"closed after {messages[-10:-1]}"
        return messages

    def request(self, op, **members):
        """Sends a request with a new id; returns its answer, or raises MonitorError. Other messages that
        arrive before the answer are kept for `read`; they require a subscription."""
        self._last_id += 1
        self.send({"op": op, "id": self._last_id, **members})
        is_whole = False if '"fields"' in json.dumps(members) else None
        while True:
            line = self.read_line()
            assert line, f"the monitor closed instead of answering {op}"
            answer = json.loads(line)
            if answer.get("id") == self._last_id and answer["op"] not in ("event", "line"):
                break
            assert self._subscribed, answer
            self._kept.append(self._checked(answer))
        self._checked(answer, is_whole)
        if answer["op"] == "result" and not answer["ok"]:
            raise MonitorError(answer["error"])
        return answer

    def call(self, fn, /, **arguments):
        """Makes a call; returns the value of its result."""
        value = self.request("call", fn=fn, args=arguments)["value"]
        return monitor_schema.check_value(fn, value, "fields" not in arguments)

    def subscribe(self, channel, **options):
        """Subscribes; returns the parameters in effect."""
        self._subscribed = True
        if "fields" in options:
            self._partial.add(channel)
        value = self.request("sub", channel=channel, **options)["value"]
        return monitor_schema.check_value("sub", value)

    def unsubscribe(self, channel):
        return monitor_schema.check_value("unsub", self.request("unsub", channel=channel)["value"])

    def recall(self, channel, **options):
        """The recorded messages of channel `event` or `line`, oldest first."""
        self._subscribed = True
        if "fields" in options:
            self._partial.add(channel)
        self.request("get", channel=channel, **options)
        recalled = [message for message in self._kept if message.get("id") == self._last_id]
        self._kept = collections.deque(message for message in self._kept if "id" not in message)
        return recalled

    def get(self, *fields):
        """The state, with all members or with these members only."""
        return self.look("state", **({"fields": list(fields)} if fields else {}))

    def look(self, channel, **options):
        """The current message of a latest-wins channel."""
        return self.request("get", channel=channel, **options)

    def step(self, ticks, after=None, fields=None):
        """Advances the manual clock; `after` a line has received what was sent on it (a Line, or its
        number and a count of bytes). Returns the state."""
        arguments = {"ticks": ticks}
        if after is not None:
            number, sent = after if isinstance(after, tuple) else (after.number, after.sent)
            arguments["after"] = {"line": number, "bytes_in": sent,
                                  "within_ms": int(DEADLINE_S * 1000)}
        if fields is not None:
            arguments["fields"] = fields
        return self.call("step", **arguments)["state"]

    def settle(self, after=None):
        """Advances time until nothing moves; returns the state."""
        self.step(0, after, fields=[])
        return self.call("run_until", idle=True, max_ticks=10**6)["state"]


def motors(state):
    """The joints and the tool of a state, by label."""
    return {motor["label"]: motor for motor in [*state["joints"], state["tool"]]}


def counts(state, labels="FEDCBA"):
    """Encoder counts without zeros, as a string such as "E-40 D40", which is readable in a failure."""
    by_label = motors(state)
    return " ".join(f"{label}{by_label[label]['count']}" for label in labels
                    if label in by_label and by_label[label]["count"])


def machine(state):
    """The members of a state that describe the machine: all but the envelope and the clock."""
    return {name: value for name, value in state.items()
            if name not in ("op", "id", "cell", "epoch", "seq", "tick", "clock")}


def drive(line, monitor, **targets):
    """Moves motors by counts, at the same time, in moves that fit into the error counter."""
    while any(targets.values()):
        for label, left in targets.items():
            move = max(-MOST_COUNTS_A_MOVE, min(MOST_COUNTS_A_MOVE, left))
            line.send(f"{label}{move:+d}\r")
            targets[label] -= move
        monitor.settle(after=line)
    return monitor.get()
