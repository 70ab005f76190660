"""Hostile clients of the monitor port: any input ends with a clear error or a close, and it hardly delays the
answers to another client."""
# labels: serial full

import socket
import time
import unittest

from monitor_schema import messages
from support import DEADLINE_S, Server, connect

MIB = 1 << 20
HEAD_S = 10.0  # the server's timeout for the head of an HTTP request
WAIT_MORE_S = 0.1  # on a busy machine, too; ./test --abuse measures the delays
UPGRADE = (b"GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
           b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n")


def deep(brackets, length):
    return b'{"op":"ping","more":' + brackets[:1] * length + brackets[1:] * length + b"}\n"


def read_to_end(sock):
    data = b""
    try:
        while part := sock.recv(65536):
            data += part
    except ConnectionResetError:
        pass
    return data


class Case(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server("--log-level", "error"))
        self.good = self.enterContext(self.xr3.monitor())

    def waits_s(self, tries=200):
        """The 95th percentile of the time until the good client receives an answer, in seconds."""
        waited = []
        for _ in range(tries):
            started = time.monotonic()
            self.good.request("ping")
            waited.append(time.monotonic() - started)
        return sorted(waited)[-tries // 20]


class Malformed(Case):
    def answers(self, data):
        """Sends the bytes and closes for writing; returns all messages until the server closes."""
        with connect(self.xr3.monitor_port) as sock:
            try:
                sock.sendall(data)
                sock.shutdown(socket.SHUT_WR)
            except OSError:  # the server has closed it already
                pass
            return messages(read_to_end(sock))

    def test_malformed_requests_get_errors(self):
        for code, data in [
            ("bad_json", b'{"op":"ping"\n'), ("bad_json", b"{{\n"), ("bad_json", b"{}}\n"),
            ("bad_json", b'{"op":"\\x"}\n'),
            ("bad_json", b'{"op":"ping","id":1e}\n'), ("bad_json", b'{"op":"ping","id":01}\n'), ("bad_json", b'{"\0":1}\n'),
            ("bad_json", b'{"op":"\\ud800"}\n'), ("bad_json", b'{"op":"\xc3\x28"}\n'),
            ("bad_json", b"{" + b"\xff" * 1000 + b"\n"),
            ("too_deep", deep(b"[]", 40)), ("too_deep", deep(b"[]", 100_000)), ("too_deep", deep(b"[", 200_000)),
            ("too_deep", b'{"op":"call","args":' * 5000 + b"\n"),
            ("unknown_op", b"{}\n"), ("unknown_op", b'{"op":{}}\n'), ("unknown_op", b'{"op":"' + b"x" * 100_000 + b'"}\n'),
        ]:
            with self.subTest(data[:50]):
                hello, result = self.answers(data)
                self.assertEqual(code, result["error"]["code"])
                self.assertLess(len(str(result)), 4096, "the error does not repeat the request")

    def test_invalid_ids(self):
        for wrong in b"{}", b"[1]", b"1.5", b"true", b"1e300", b'"' + b"x" * 65 + b'"', b"123456789012345678901234567890":
            with self.subTest(wrong):
                _, result = self.answers(b'{"op":"ping","id":' + wrong + b"}\n")
                self.assertEqual(("bad_args", None), (result["error"]["code"], result["id"]))

    def test_an_endless_line_of_ten_megabytes(self):
        for start in b'{"op":"ping","more":"', b"{", b" " * 300_000 + b"{", b"x":
            with self.subTest(start[:30]):
                before_s = self.waits_s()
                with connect(self.xr3.monitor_port) as sock:
                    try:
                        for _ in range(10):
                            sock.sendall(start + b"x" * MIB)
                    except (BrokenPipeError, ConnectionResetError):
                        pass
                self.assertLess(self.waits_s(), before_s + WAIT_MORE_S)
        hello, error, bye = self.answers(b'{"op":"ping","more":"' + b"x" * 300_000)
        self.assertEqual(("too_long", "bye", "too_long"), (error["error"]["code"], bye["op"], bye["why"]))

    def test_many_requests_at_once(self):
        data = b'{"op":"ping","id":1}\n' * 50_000
        with connect(self.xr3.monitor_port) as sock:
            sock.setblocking(False)
            view = memoryview(data)
            received = 0
            ends = time.monotonic() + 3 * DEADLINE_S
            while received < 50_000 * len(b'{"op":"pong","id":1}\n') and time.monotonic() < ends:
                try:
                    view = view[sock.send(view[:65536]):] if view else view
                except BlockingIOError:
                    pass
                try:
                    received += len(sock.recv(1 << 20))
                except BlockingIOError:
                    self.good.request("ping")
            self.assertGreaterEqual(received, 50_000 * len(b'{"op":"pong","id":1}\n'))


class Http(Case):
    def status(self, data):
        with connect(self.xr3.monitor_port) as sock:
            try:
                sock.sendall(data)
                sock.shutdown(socket.SHUT_WR)
            except OSError:  # the server has closed it already
                pass
            return read_to_end(sock)[9:12].decode()

    def test_heads(self):
        host = b"Host: localhost\r\n"
        for status, data in [
            ("431", b"GET / HTTP/1.1\r\n" + host + b"X: " + b"x" * 20_000 + b"\r\n\r\n"),
            ("431", b"GET / HTTP/1.1\r\n" + host + b"X: y\r\n" * 70 + b"\r\n"),
            ("414", b"GET /" + b"x" * 9000 + b" HTTP/1.1\r\n" + host + b"\r\n"),
            ("400", b"GET / HTTP/1.1\r\n" + host * 2 + b"\r\n"),
            ("400", b"GET / HTTP/1.1\r\n\r\n"),
            ("400", b"GET  / HTTP/1.1\r\n" + host + b"\r\n"),
            ("400", b"GET / HTTP/1.1\r\n" + host + b"A B: c\r\n\r\n"),
            ("400", b"GET / HTTP/1.1\r\n" + host + b"\0: c\r\n\r\n"),
            ("403", b"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"),
            ("403", b"GET / HTTP/1.1\r\n" + host + b"Origin: null\r\n\r\n"),
            ("403", b"GET / HTTP/1.1\r\n" + host + b"Origin: http://evil.example\r\n\r\n"),
            ("426", b"GET /ws HTTP/1.1\r\n" + host + b"\r\n"),
            ("404", b"GET /../../etc/passwd HTTP/1.1\r\n" + host + b"\r\n"),
            ("404", b"GET /assets/..%2f..%2fetc/passwd HTTP/1.1\r\n" + host + b"\r\n"),
        ]:
            with self.subTest(data[:60]):
                self.assertEqual(status, self.status(data))

    def test_a_head_or_body_of_ten_megabytes(self):
        for start in (b"GET /", b"GET / HTTP/1.1\r\nHost: localhost\r\nX: ", b"POST / HTTP/1.1\r\nHost: localhost\r\n"
                      b"Content-Length: 10485760\r\n\r\n"):
            with self.subTest(start), connect(self.xr3.monitor_port) as sock:
                before_s = self.waits_s()
                try:
                    for _ in range(10):
                        sock.sendall(start + b"x" * MIB)
                        start = b""
                except (BrokenPipeError, ConnectionResetError):
                    pass
                self.assertLess(self.waits_s(), before_s + WAIT_MORE_S)


class Handshakes(Case):
    MANY = 1000

    def test_a_thousand_incomplete_handshakes(self):
        """Incomplete HTTP heads are closed after ten seconds; an incomplete JSON line has no timeout."""
        starts = [b"G", b"GET / HT", UPGRADE, UPGRADE[:-20], b"GET / HTTP/1.1\r\nHost: localhost\r\n", b'{"op":', b""]
        before_s = self.waits_s()
        started = time.monotonic()
        socks = []
        for number in range(self.MANY):
            socks.append(self.enterContext(connect(self.xr3.monitor_port)))
            socks[-1].sendall(starts[number % len(starts)])
        self.assertLess(self.waits_s(), before_s + WAIT_MORE_S)
        for number, sock in enumerate(socks):
            if number % len(starts) < 5:
                answer = read_to_end(sock)
                self.assertNotIn(b'"op"', answer)
                if number == starts.index(UPGRADE[:-20]):
                    self.assertTrue(answer.startswith(b"HTTP/1.1 408 "), answer)
        took_s = time.monotonic() - started
        self.assertLess(took_s, 1.5 * HEAD_S + 5.0)
        self.assertGreater(took_s, 0.8 * HEAD_S)
        self.assertLess(self.waits_s(), before_s + WAIT_MORE_S)
        for sock in socks[5::len(starts)][:10]:
            sock.sendall(b'"ping","id":1}\n')
            hello, pong = messages(self.lines(sock, 2))
            self.assertEqual("pong", pong["op"])

    def lines(self, sock, count):
        with sock.makefile("rb") as file:
            return b"".join(file.readline() for _ in range(count))

    def test_a_connection_above_the_maximum(self):
        """A client above the maximum number of connections is sent the reason."""
        kept = [self.enterContext(connect(self.xr3.monitor_port)) for _ in range(1024)]
        with connect(self.xr3.monitor_port) as sock:
            sock.sendall(b'{"op":"ping"}\n')
            received = read_to_end(sock)
            self.assertIn(b'"full"', received)
        self.good.request("ping")
        for sock in kept:
            sock.close()


if __name__ == "__main__":
    unittest.main()
