"""The server under attack, as a load sees it, and the data of floods. A load is a function of a Target. It runs
in a process of its own until it is killed. It calls ready() when the attack is in force."""

import contextlib
import itertools
import json
import os
import select
import selectors
import socket
import struct

LOCALHOST = "127.0.0.1"
PATIENCE_S = 30.0
BLOCK_BYTES = 64 * 1024
MOST_AT_ONCE = 1 << 20
RESET = struct.pack("ii", 1, 0)  # the value of SO_LINGER


def connect(port, buffer_bytes=None):
    """A connected socket, perhaps with a small receive buffer, for a client that does not read."""
    sock = socket.socket()
    if buffer_bytes is not None:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer_bytes)
    sock.settimeout(PATIENCE_S)
    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    sock.connect((LOCALHOST, port))
    return sock


def json_line(op, **members):
    return json.dumps({"op": op, **members}, separators=(",", ":")).encode() + b"\n"


def call(fn, **arguments):
    return json_line("call", id=1, fn=fn, args=arguments)


PING = json_line("ping")


def get(path, *fields):
    """An HTTP request."""
    head = [f"GET {path} HTTP/1.1", "Host: localhost", *fields]
    return ("\r\n".join(head) + "\r\n\r\n").encode()


class Target:
    """The ports of a server, and how to flood them. `path` is its pseudo-terminal or its device, and `device` the
    descriptor of the device's end."""

    def __init__(self, robot_port, monitor_port, path=None, device=None):
        self.robot_port, self.monitor_port = robot_port, monitor_port
        self.path, self.device = path, device and int(device)
        self._is_ready = False

    def ready(self):
        """The attack is in force. (The other process reads one line.)"""
        if not self._is_ready:
            os.write(1, b"ready\n")
        self._is_ready = True

    def line(self, **options):
        """A line. It has sent CR: without it, what follows could be taken for the method of an HTTP request."""
        sock = connect(self.robot_port, **options)
        sock.sendall(b"\r")
        return sock

    def untried_line(self):
        """A line that has sent nothing."""
        return connect(self.robot_port)

    def page(self, **options):
        """A connection to the monitor port that has sent nothing."""
        return connect(self.monitor_port, **options)

    def ask(self, *requests):
        """A JSON connection that has sent requests and received their answers. (`hello` comes when a client sends.)"""
        sock = self.page()
        sock.sendall(b"".join(requests) or PING)
        with sock.makefile("rb") as file:
            for _ in range(1 + max(1, len(requests))):
                answer = file.readline()
                if b'"ok":false' in answer:
                    raise ValueError(answer)
        return sock

    def tell(self, *requests):
        """A JSON connection that has sent requests."""
        sock = self.page()
        sock.sendall(b"".join(requests))
        return sock

    def flood(self, opener, data, count=1, reads=True):
        """Repeats the data on connections as fast as the server takes it. Opens a connection again when the server
        closes it."""
        self.flood_each([(opener, data)] * count, reads)

    def flood_each(self, clients, reads=True):
        """Repeats different data on each connection. `clients`: pairs of a function that opens a connection, and its data."""
        choice = selectors.DefaultSelector()
        events = selectors.EVENT_WRITE | (selectors.EVENT_READ if reads else 0)
        blocks = {data: data * max(1, BLOCK_BYTES // len(data)) for _, data in clients}
        for opener, data in clients:
            _register(choice, events, Flood(opener, blocks[data]))
        while True:
            for key, ready in choice.select():
                try:
                    _move(key, ready)
                    self.ready()
                except OSError:
                    choice.unregister(key.fileobj)
                    key.fileobj.close()
                    _register(choice, events, key.data)

    def a_block(self):
        """The name of a block of the workcell."""
        with self.tell(json_line("get", channel="state", fields=["blocks"])) as sock, sock.makefile("rb") as file:
            file.readline()  # hello
            return json.loads(file.readline())["blocks"][0]["name"]

    def storm(self, port, data):
        """Connections that send something and end at once, one after the other, with a reset, so that their ports are
        free again."""
        for number in itertools.count():
            with connect(port) as sock:
                sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET)
                sock.sendall(data)
            if number == 20:
                self.ready()

    def bursts(self, port, data, count):
        """Connections at once, which send something and end at once, again and again."""
        while True:
            with contextlib.ExitStack() as stack:
                socks = [stack.enter_context(socket.socket()) for _ in range(count)]
                for sock in socks:
                    sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET)
                    sock.setblocking(False)
                    sock.connect_ex((LOCALHOST, port))
                for sock in socks:
                    with contextlib.suppress(OSError):
                        sock.send(data)
                select.select([], socks[-1:], [], PATIENCE_S)
            self.ready()

    def hold(self):
        """Waits for ever, and does nothing."""
        self.ready()
        select.select([], [], [])


def read_answer(sock):
    """Reads an answer of unknown length: until the server sends no more for some milliseconds."""
    sock.recv(MOST_AT_ONCE)
    while select.select([sock], [], [], 0.005)[0] and sock.recv(MOST_AT_ONCE):
        pass


class Flood:
    """The data that a connection repeats, and what is left of this turn."""

    def __init__(self, opener, block):
        self.opener, self.block = opener, memoryview(block)
        self.rest = self.block

    def send(self, sock):
        self.rest = self.rest[sock.send(self.rest):] or self.block


def _register(choice, events, flood):
    flood.rest = flood.block
    sock = flood.opener()
    sock.setblocking(False)
    choice.register(sock, events, flood)


def _move(key, ready):
    if ready & selectors.EVENT_READ and not key.fileobj.recv(MOST_AT_ONCE):
        raise ConnectionResetError
    if ready & selectors.EVENT_WRITE:
        key.data.send(key.fileobj)
