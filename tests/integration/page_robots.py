"""Robots for the Python package of the page, clients/web/src/python/xr3_page, as its worker provides them: one that
follows a script in simulated time, and one that is the line to a real server."""

import socket

_Socket = socket.socket  # before the package replaces it
WAIT_S = 20.0  # for a reply of a real server; only a failing test waits so long
START_S = 1_700_000_000.5


class ScriptedRobot:
    """A robot whose lines follow a script. Simulated time passes only while a program waits. `calls` has the calls of
    functions whose arguments matter, `answers` the replies to what is sent, and `typed` the lines of input."""

    monitor_port = 9601

    def __init__(self, typed=(), answers=None):
        self.now_ms = 0.0
        self.calls = []
        self.answers = answers or {}
        self.typed = list(typed)
        self.room = 10**6  # number of bytes that all lines together still take
        self.sent = {}
        self._due = {}  # by line: (ms, bytes that arrive, or b"" at the end)
        self._arrived = {}

    # --- The script.

    def arrives(self, line, data, at_ms=0.0):
        """Lets bytes arrive, or with b"" the end, on a line that may not be open yet."""
        self._due.setdefault(line, []).append((at_ms, data))

    # --- The functions of the page.

    def open(self):
        return self._open("open")

    def open_monitor(self):
        return self._open("open_monitor")

    def _open(self, kind):
        number = 1 + len(self.sent)
        self.calls.append((kind, number))
        self.sent[number], self._arrived[number] = b"", b""
        self._due.setdefault(number, [])
        return number

    def send(self, line, data, timeout):
        assert isinstance(data, bytes), data
        if self._has_ended(line):
            return -2
        taken = min(len(data), self.room)
        self.room -= taken
        if not taken and data:
            assert timeout >= 0, "a send that would wait for ever"
            self.now_ms += timeout
        self.sent[line] += data[:taken]
        if data in self.answers:
            self.arrives(line, self.answers[data], self.now_ms)
        return taken

    def receive(self, line, size, timeout, peek):
        self.calls.append(("receive", line, size, timeout, peek))
        if not self.waiting(line) and not self._waits(line, timeout):
            return None
        data = self._arrived[line][:size]
        if not peek:
            self._arrived[line] = self._arrived[line][size:]
        return data

    def _waits(self, line, timeout):
        """Lets time pass until something arrives; False after the timeout."""
        due = self._due[line][0][0] if self._due[line] else None
        if due is None and timeout < 0:
            raise OSError("nothing more can arrive")
        is_in_time = due is not None and (timeout < 0 or due <= self.now_ms + timeout)
        self.now_ms = max(self.now_ms, due) if is_in_time else self.now_ms + timeout
        return is_in_time and self.waiting(line) != 0

    def _has_ended(self, line):
        self._take_due(line)
        return self._due[line][:1] == [(self._due[line][0][0], b"")] if self._is_due(line) else False

    def _is_due(self, line):
        return bool(self._due[line]) and self._due[line][0][0] <= self.now_ms

    def _take_due(self, line):
        while self._is_due(line) and self._due[line][0][1]:
            self._arrived[line] += self._due[line].pop(0)[1]

    def waiting(self, line):
        ended = self._has_ended(line)
        return len(self._arrived[line]) or (-1 if ended else 0)

    def finish(self, line):
        self.calls.append(("finish", line))

    def close(self, line):
        self.calls.append(("close", line))

    def sleep(self, ms):
        self.calls.append(("sleep", ms))
        self.now_ms += ms

    def now(self):
        return self.now_ms

    def wall(self):
        return START_S

    def ask(self, prompt):
        self.calls.append(("ask", prompt))
        return self.typed.pop(0) if self.typed else None


class ServerRobot:
    """The robot of a real server, by TCP connections. Simulated time is that of the program's own sleeping."""

    monitor_port = 9601

    def __init__(self, robot_port, monitor_port):
        self._ports = robot_port, monitor_port
        self._now_ms = 0.0
        self._sockets = []

    def open(self):
        return self._open(self._ports[0])

    def open_monitor(self):
        return self._open(self._ports[1])

    def _open(self, port):
        self._sockets.append(_Socket(socket.AF_INET, socket.SOCK_STREAM))
        self._sockets[-1].settimeout(WAIT_S)
        self._sockets[-1].connect(("127.0.0.1", port))
        self._sockets[-1].setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return len(self._sockets)

    def send(self, line, data, timeout):
        self._sockets[line - 1].sendall(data)
        return len(data)

    def receive(self, line, size, timeout, peek):
        try:
            return self._sockets[line - 1].recv(size, socket.MSG_PEEK if peek else 0)
        except TimeoutError:
            return None

    def finish(self, line):
        self._sockets[line - 1].shutdown(socket.SHUT_WR)

    def close(self, line):
        self._sockets[line - 1].close()

    def sleep(self, ms):
        self._now_ms += ms

    def now(self):
        return self._now_ms

    def wall(self):
        return START_S

    def ask(self, prompt):
        return None


class JsValue:
    """A JavaScript object, such as a Uint8Array."""

    def __init__(self, value):
        self.value = value

    def to_py(self):
        return memoryview(self.value) if isinstance(self.value, bytes) else self.value


class Promise:
    def __init__(self, function):
        self.then = function


class JsError(Exception):
    def __init__(self, name, message):
        super().__init__(f"{name}: {message}")
        self.name, self.message = name, message


class FakeFfi:
    """The names of pyodide.ffi that the package uses."""

    JsException = JsError
    to_js = JsValue

    @staticmethod
    def run_sync(promise):
        return promise.then()


class JavaScriptRobot:
    """A robot with JavaScript's values, whose functions return promises."""

    monitor_port = 9601.0

    def __init__(self, robot):
        self._robot = robot

    def __getattr__(self, name):
        def call(*arguments):
            return Promise(lambda: self._call(name, arguments))
        return call

    def _call(self, name, arguments):
        assert not any(isinstance(each, bytes) for each in arguments), "bytes of Python"
        plain = [each.value if isinstance(each, JsValue) else each for each in arguments]
        try:
            value = getattr(self._robot, name)(*plain)
        except OSError as error:
            raise JsError("Error", str(error)) from None
        return JsValue(value) if isinstance(value, bytes) else value
