"""Requests that the monitor port refuses: unknown names, wrong arguments, HTTP requests that contain calls. An error
does not change the robot, and the connection stays open unless `bye` follows. (tests/protocol/monitor has every wrong
value, test_hostile.py broken JSON.)"""

import unittest

from support import MonitorError, Server, connect, machine

CALL = b'{"op":"call","id":3,"fn":"step","args":{"ticks":100}}\n'


def call(fn, **arguments):
    return {"op": "call", "fn": fn, "args": arguments}


class Requests(unittest.TestCase):
    REFUSED = [
        ("unknown_op", {"op": "dance"}),
        ("unknown_channel", {"op": "get", "channel": "taste"}),
        ("unknown_fn", call("fly")),
        ("unknown_cell", call("home") | {"cell": "other"}),
        ("bad_args", {"op": "get", "channel": "state", "fields": ["moving", "taste"]}),
        ("bad_args", call("step", ticks=5, after=5)),
        ("bad_args", call("step", ticks=5, after={"line": 1, "bytes_in": -1})),
        ("no_such_line", call("step", ticks=5, after={"line": 99, "bytes_in": 1, "within_ms": 20000})),
        ("bad_args", call("rate", factor=0)),
        ("bad_args", call("reset", hard=True)),
    ]

    def test_refused_requests_change_nothing(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line():
            before = monitor.get()
            for code, request in self.REFUSED:
                with self.subTest(request=request), self.assertRaises(MonitorError) as caught:
                    monitor.request(**request)
                self.assertEqual(code, caught.exception.code, request)
                self.assertTrue(caught.exception.message)
            after = monitor.get()
            self.assertEqual((machine(before), 0, 0), (machine(after), after["tick"], after["epoch"]))
            self.assertEqual(before["clock"], after["clock"])

    def test_replies_have_the_id_of_the_request(self):
        with Server() as xr3, xr3.monitor() as monitor:
            for number in ["a" * 64, "", 0, -7, 2**53 - 1, "é"]:
                monitor.send({"op": "ping", "id": number})
                self.assertEqual({"op": "pong", "id": number}, monitor.read())
            monitor.send({"op": "ping", "more": "ignored"})
            self.assertEqual("pong", monitor.read()["op"])

    def test_a_line_that_is_not_an_object_ends_the_connection(self):
        """So the server reads at most the first line of an HTTP request."""
        with Server() as xr3:
            for intruder in b"POST / HTTP/1.1\r\n", b"[]\n", b"5\n", b"\x00\n":
                with self.subTest(intruder), xr3.monitor() as monitor:
                    monitor.send(b"  \n" + intruder + CALL)
                    bye = monitor.read()
                    self.assertEqual(("bye", "not_json"), (bye["op"], bye["why"]))
                    self.assertIsNone(monitor.read())
            with xr3.monitor() as monitor:
                self.assertEqual(0, monitor.get("moving")["tick"])


class Http(unittest.TestCase):
    def exchange(self, xr3, data):
        with connect(xr3.monitor_port) as sock:
            sock.sendall(data)
            sock.shutdown(1)
            answer = b""
            try:
                while part := sock.recv(65536):
                    answer += part
            except ConnectionResetError:
                pass
            return answer

    def test_an_http_body_is_not_executed(self):
        """A web page can make a browser send an HTTP request with lines of JSON in it."""
        host = b"Host: localhost\r\n"
        with Server() as xr3:
            for request in [
                b"GET /healthz HTTP/1.1\r\n" + host + b"\r\n" + CALL,
                b"GET /healthz HTTP/1.1\r\n" + host + CALL + b"\r\n\r\n",
                b"GET / HTTP/1.1\n" + CALL,
                b"GET /\n" + CALL,
                b"G\n" + CALL,
                b"POST /healthz HTTP/1.1\r\n" + host + b"Content-Length: %d\r\n\r\n" % len(CALL) + CALL,
                b"POST / HTTP/1.1\r\n" + host + b"Transfer-Encoding: chunked\r\n\r\n36\r\n" + CALL,
                b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + CALL,
                b"OPTIONS / HTTP/1.1\r\n" + host + b"\r\n" + CALL,
            ]:
                with self.subTest(request):
                    answer = self.exchange(xr3, request)
                    self.assertNotIn(b'"op"', answer)
                    if answer:
                        self.assertRegex(answer, rb"\AHTTP/1\.[01] \d\d\d ")
            with xr3.monitor() as monitor:
                self.assertEqual(0, monitor.get("moving")["tick"])


if __name__ == "__main__":
    unittest.main()
