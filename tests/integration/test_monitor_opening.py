"""Detection of the protocol of a monitor connection by its first bytes, however they are split: JSON lines,
HTTP, or neither. Only connections that are JSON from the first byte on have an effect."""

import select
import time
import unittest

from monitor_schema import messages
from support import Server, connect

METHODS = ["GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "CONNECT"]
CALL = b'{"op":"call","id":9,"fn":"step","args":{"ticks":100}}\n'
PING = b'{"op":"ping","id":1}\n'
BOM = b"\xef\xbb\xbf"
TLS_HELLO = bytes.fromhex("1603010200010001fc0303") + bytes(range(32))
SILENCE_S = 1.0  # the server sends `hello` after this time without input

# (detected protocol, pieces that are sent)
JSON, NOT_JSON, HTTP, CLOSED = "JSON", "not JSON", "HTTP", "closed without a message"
CASES = [
    (JSON, [PING]),
    (JSON, [b"{", PING[1:]]),
    (JSON, [PING[:5], PING[5:12], PING[12:]]),
    (JSON, [b"\r\n", PING]),
    (JSON, [b"\r", b"\n", b"\r\n", PING]),
    (JSON, [b"  \t " + PING]),
    (JSON, [BOM + PING]),
    (JSON, [BOM[:1], BOM[1:2], BOM[2:], PING]),
    (JSON, [BOM + b"\r\n " + PING]),
    (JSON, [b"\r\n" + BOM + PING]),
    (HTTP, [b"\r\nGET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n" + CALL]),
    (HTTP, [b"GET /\r\n" + CALL]),
    (HTTP, [b"GET /healthz HTTP/1.1\n\n" + CALL]),
    (HTTP, [b"HELP\r\n" + CALL]),
    (HTTP, [b"Z", b"\r\n\r\n" + CALL]),
    (HTTP, [b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + CALL]),
    (HTTP, [b"PR", b"I * HTTP/2.0\r\n\r\nSM\r\n\r\n", CALL]),
    (NOT_JSON, [b"help\r\n" + CALL]),
    (NOT_JSON, [b"help\r\n", CALL]),
    (NOT_JSON, [b"h", CALL]),
    (NOT_JSON, [b"get / HTTP/1.1\r\nHost: localhost\r\n\r\n" + CALL]),
    (NOT_JSON, [b"[" + CALL[:-1] + b"]\n"]),
    (NOT_JSON, [b'"text"\n' + CALL]),
    (NOT_JSON, [b"5\n" + CALL]),
    (NOT_JSON, [b"-1\n", CALL]),
    (NOT_JSON, [b"null\n" + CALL]),
    (NOT_JSON, [b"\0" + CALL]),
    (NOT_JSON, [b"\0", CALL]),
    (NOT_JSON, [b"\xff\xfd\x03" + CALL]),
    (NOT_JSON, [BOM + BOM + CALL]),
    (NOT_JSON, [BOM + b"help\n" + CALL]),
    (NOT_JSON, [b"\xef{" + CALL]),
    (NOT_JSON, [b"\xfe\xff" + CALL]),
    (NOT_JSON, [b"\r\n\r\nhelp\n", CALL]),
    (CLOSED, [TLS_HELLO + CALL]),
    (CLOSED, [TLS_HELLO[:1], TLS_HELLO[1:], CALL]),
]


class Stream:
    """A connection whose pieces arrive separately: after each one, an answer to another client, `watcher`,
    shows that the server has had a turn."""

    def __init__(self, xr3, watcher):
        self.socket = connect(xr3.monitor_port)
        self.watcher = watcher

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def send(self, *pieces):
        for piece in pieces:
            try:
                self.socket.sendall(piece)
            except (BrokenPipeError, ConnectionResetError):
                return  # closed already
            self.watcher.request("ping")

    def read_to_end(self):
        return self.read_to_end_of(self.socket)

    @staticmethod
    def read_to_end_of(sock):
        data = b""
        try:
            while part := sock.recv(65536):
                data += part
        except ConnectionResetError:
            pass
        return data

    def ends(self):
        """Closes for writing; returns all bytes that the server sends until it closes."""
        try:
            self.socket.shutdown(1)
        except OSError:
            pass
        return self.read_to_end()


class Opening(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server("--log-level", "warn"))
        self.watcher = self.enterContext(self.xr3.monitor())

    def stream(self):
        return Stream(self.xr3, self.watcher)

    def assert_nothing_acted(self):
        self.assertEqual(0, self.watcher.get("moving")["tick"])

    def check(self, kind, received):
        if kind is JSON:
            self.assertEqual(["hello", "pong"], [message["op"] for message in messages(received)])
        elif kind is NOT_JSON:
            hello, bye = messages(received)
            self.assertEqual(("hello", "bye", "not_json"), (hello["op"], bye["op"], bye["why"]))
            self.assertIn('{"op"', bye["message"], "an example")
        elif kind is HTTP:
            self.assertRegex(received, rb"\AHTTP/1\.[01] \d\d\d ")
            self.assertNotIn(b'"op"', received)
        else:
            self.assertEqual(b"", received)

    def test_first_bytes(self):
        for kind, pieces in CASES:
            with self.subTest(pieces=pieces), self.stream() as stream:
                stream.send(*pieces)
                self.check(kind, stream.ends())
                self.assert_nothing_acted()

    def test_http_responses(self):
        for status, data in [(505, b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"), (400, b"HELP\r\n\r\n"),
                             (400, b"GET / HTTP/1.1\r\n\r\n"),
                             (200, b"GET /healthz HTTP/1.0\r\nHost: a.localhost\r\n\r\n")]:
            with self.subTest(data), self.stream() as stream:
                stream.send(data)
                self.assertRegex(stream.ends(), rb"\AHTTP/1\.[01] %d " % status)

    def requests(self):
        for method in METHODS:
            yield f"{method} /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode(), method

    def test_methods_byte_by_byte(self):
        for request, method in self.requests():
            with self.subTest(method), self.stream() as stream:
                stream.send(*(bytes([byte]) for byte in request[:len(method) + 3]))
                stream.send(request[len(method) + 3:] + CALL)
                self.check(HTTP, stream.read_to_end())
        self.assert_nothing_acted()

    def test_methods_cut_after_each_byte_and_a_pause(self):
        """After one byte of HTTP the server no longer sends `hello`, however long the client pauses."""
        streams = []
        for request, method in self.requests():
            for length in range(1, len(method) + 2):
                stream = self.enterContext(self.stream())
                stream.send(request[:length])
                streams.append((stream, request[length:]))
        self.assertGreater(len(streams), 50)
        sockets = [stream.socket for stream, _ in streams]
        self.assertEqual([], select.select(sockets, [], [], 1.3 * SILENCE_S)[0])
        for stream, rest in streams:
            stream.send(rest + CALL)
            self.check(HTTP, stream.read_to_end())
        self.assert_nothing_acted()

    def greeted(self, befores):
        """For each of these pieces a stream that sends only it and has received `hello`."""
        started = time.monotonic()
        streams = [self.enterContext(self.stream()) for _ in befores]
        for stream, before in zip(streams, befores):
            stream.send(before)
        for stream in streams:
            hello, = messages(stream.socket.recv(65536))
            self.assertEqual("hello", hello["op"])
        self.assertGreater(time.monotonic() - started, 0.9 * SILENCE_S)
        return streams

    def test_after_hello_only_json_is_accepted(self):
        """After `hello` the server accepts only JSON."""
        cases = [(JSON, [PING]), (JSON, [b"{", PING[1:]]), (JSON, [b"\r\n", PING]),
                 (NOT_JSON, [b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n" + CALL]),
                 (NOT_JSON, [b"G", b"ET / HTTP/1.1\r\n\r\n" + CALL]),
                 (NOT_JSON, [b"POST / HTTP/1.1\r\n", CALL]),
                 (NOT_JSON, [b"help\n", CALL]), (NOT_JSON, [TLS_HELLO + CALL])]
        for (kind, pieces), stream in zip(cases, self.greeted([b""] * len(cases))):
            with self.subTest(pieces=pieces):
                stream.send(*pieces)
                last, = messages(stream.ends())
                self.assertEqual(("pong", None) if kind is JSON else ("bye", "not_json"), (last["op"], last.get("why")))
                self.assert_nothing_acted()

    def test_a_machine_that_speaks_http_is_not_greeted(self):
        """A browser opens connections ahead, and takes a greeting for the answer to its next request."""
        get = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n%s\r\n"
        before = [connect(self.xr3.monitor_port, machine=machine) for machine in ("127.0.0.2", "127.0.0.3")]
        before[0].sendall(get % b"Connection: close\r\n")
        before[1].sendall(get % b"")  # this connection stays open
        ahead = [connect(self.xr3.monitor_port, machine=machine) for machine in ("127.0.0.2", "127.0.0.3")]
        typed = connect(self.xr3.monitor_port, machine="127.0.0.2")
        person = connect(self.xr3.monitor_port, machine="127.0.0.4")
        for each in (*before, *ahead, typed, person):
            self.addCleanup(each.close)
        self.assertEqual("hello", messages(person.recv(65536))[0]["op"], "which comes after those of the others would")
        self.assertEqual([], select.select([*ahead, typed], [], [], 0)[0])
        for each in ahead:
            each.sendall(get % b"")
            self.assertRegex(each.recv(65536), rb"\AHTTP/1\.1 200 ")
        typed.sendall(PING)
        typed.shutdown(1)
        self.assertEqual(["hello", "pong"], [message["op"] for message in messages(Stream.read_to_end_of(typed))])

    def test_blanks_and_a_byte_order_mark_count_as_silence(self):
        for stream in self.greeted([b"\r\n", b" ", BOM]):
            stream.send(PING)
            self.assertEqual(["pong"], [message["op"] for message in messages(stream.ends())])

    def test_lines_never_become_http(self):
        for pieces in [PING, b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n" + CALL], [PING + b"POST / HTTP/1.1\r\n", CALL]:
            with self.subTest(pieces), self.stream() as stream:
                stream.send(*pieces)
                received = messages(stream.ends())
                self.assertEqual(["hello", "pong", "bye"], [message["op"] for message in received])
                self.assertEqual("not_json", received[-1]["why"])
        self.assert_nothing_acted()


if __name__ == "__main__":
    unittest.main()
