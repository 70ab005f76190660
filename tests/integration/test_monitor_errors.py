"""Requests that the monitor port refuses: broken JSON, unknown names, wrong arguments, HTTP requests that
contain calls. An error does not change the robot, and the connection stays open unless `bye` follows."""

import shutil
import subprocess
import unittest

from support import DEADLINE_S, LOCALHOST, MonitorError, Server, connect, machine

CALL = b'{"op":"call","id":3,"fn":"step","args":{"ticks":100}}\n'


def call(fn, **arguments):
    return {"op": "call", "fn": fn, "args": arguments}


class Requests(unittest.TestCase):
    REFUSED = [
        ("unknown_op", {"op": "dance"}),
        ("unknown_op", {"op": 5}),
        ("unknown_op", {"op": None}),
        ("unknown_channel", {"op": "get", "channel": "taste"}),
        ("unknown_fn", call("fly")),
        ("unknown_fn", {"op": "call"}),
        ("unknown_cell", {"op": "get", "channel": "state", "cell": "other"}),
        ("unknown_cell", call("home") | {"cell": "other"}),
        ("bad_args", {"op": "get", "channel": "state", "fields": ["moving", "taste"]}),
        ("bad_args", {"op": "get", "channel": "state", "fields": "moving"}),
        ("bad_args", {"op": "call", "fn": "step", "args": 5}),
        ("bad_args", call("step")),
        ("bad_args", call("step", ticks=-1)),
        ("bad_args", call("step", ticks=1.5)),
        ("bad_args", call("step", ticks="5")),
        ("bad_args", call("step", ticks=10**30)),
        ("bad_args", call("step", ticks=5, tocks=5)),
        ("bad_args", call("step", ticks=5, after=5)),
        ("bad_args", call("step", ticks=5, after={"line": 1})),
        ("bad_args", call("step", ticks=5, after={"line": 1, "bytes_in": -1})),
        ("bad_args", call("step", ticks=5, fields=["taste"])),
        ("no_such_line", call("step", ticks=5, after={"line": 99, "bytes_in": 1, "within_ms": 20000})),
        ("bad_args", call("run_until", max_ticks=5)),
        ("bad_args", call("run_until", idle=True, tick=5, max_ticks=5)),
        ("bad_args", call("run_until", idle=False, max_ticks=5)),
        ("bad_args", call("run_until", tick=-5, max_ticks=5)),
        ("bad_args", call("rate")),
        ("bad_args", call("rate", factor=0)),
        ("bad_args", call("rate", factor=-1)),
        ("bad_args", call("rate", factor=100001)),
        ("bad_args", call("rate", factor="fast")),
        ("bad_args", call("home", now=True)),
        ("bad_args", call("pause", now=True)),
        ("bad_args", call("reset", hard=True)),
    ]
    BROKEN = [b"{\n", b'{"op":"ping"\n', b'{"op":"ping"}}\n', b"{'op':'ping'}\n", b'{"op":"ping",}\n',
              b'{"op":"\xff"}\n', b'{"op":"ping","id":NaN}\n', b'{} {"op":"ping"}\n']

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

    def test_a_duplicate_member_is_refused(self):
        with Server() as xr3, xr3.monitor() as monitor:
            for pointer, line in (
                    ("/args/ticks", b'{"op":"call","id":"d","fn":"step","args":{"ticks":1,"ticks":500}}\n'),
                    ("/name", b'{"op":"call","id":"d","fn":"workcell","args":{"workcell":{"name":"a","name":"b"}}}\n'),
                    ("/op", b'{"op":"ping","id":"d","op":"ping"}\n')):
                monitor.send(line)
                answer = monitor.read()
                with self.subTest(line):
                    self.assertEqual(("d", "bad_args"), (answer["id"], answer["error"]["code"]))
                    self.assertIn((pointer, "each member once"),
                                  [(each["pointer"], each["allowed"]) for each in answer["error"]["details"]])
            self.assertEqual(0, monitor.get()["tick"])

    def test_step_needs_the_manual_clock(self):
        with Server(clock="real") as xr3, xr3.monitor() as monitor:
            for request in call("step", ticks=5), call("run_until", idle=True, max_ticks=5):
                with self.subTest(request=request), self.assertRaises(MonitorError) as caught:
                    monitor.request(**request)
                self.assertEqual("clock_running", caught.exception.code)
                self.assertIn("pause", caught.exception.hint)

    def test_broken_json(self):
        with Server() as xr3, xr3.monitor() as monitor:
            for line in self.BROKEN:
                with self.subTest(line):
                    monitor.send(line)
                    result = monitor.read()
                    self.assertEqual(("result", None, False),
                                     tuple(result[name] for name in ("op", "id", "ok")))
                    self.assertEqual("bad_json", result["error"]["code"])
                    self.assertEqual({"code", "message", "hint", "details"}, set(result["error"]))
            self.assertEqual("pong", monitor.request("ping")["op"])

    def test_depth_and_length(self):
        with Server() as xr3, xr3.monitor() as monitor:
            deep = {}
            for _ in range(40):
                deep = {"deeper": deep}
            monitor.send({"op": "ping", "more": deep})
            self.assertEqual("too_deep", monitor.read()["error"]["code"])
            monitor.send(b'{"op":"ping","id":1,"more":"' + b"x" * 200_000 + b'"}\n')
            self.assertEqual({"op": "pong", "id": 1}, monitor.read())
            monitor.send(b'{"op":"ping","more":"' + b"[" * 100_000 + b'"}\n')
            self.assertEqual("pong", monitor.read()["op"])
            monitor.send(b'{"op":"ping","id":2,"more":"' + b"x" * 300_000)
            answers = []
            while answer := monitor.read():
                answers.append(answer)
            self.assertEqual(("bye", "too_long"), (answers[-1]["op"], answers[-1]["why"]))

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

    @unittest.skipUnless(shutil.which("curl"), "curl is not installed (Debian package curl)")
    def test_health_by_curl(self):
        with Server() as xr3:
            for path, status in [("/healthz", "200"), ("/readyz", "200"), ("/nowhere", "404")]:
                done = subprocess.run(
                    ["curl", "-sS", "-o", "-", "-w", " %{http_code}", f"http://{LOCALHOST}:{xr3.monitor_port}{path}"],
                    capture_output=True, text=True, timeout=DEADLINE_S, check=False)
                self.assertEqual((0, status, ""), (done.returncode, done.stdout[-3:], done.stderr), path)

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

    def test_a_request_cut_at_every_byte(self):
        request = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
        with Server() as xr3, xr3.monitor() as monitor:
            for length in range(1, len(request)):
                with connect(xr3.monitor_port) as first, connect(xr3.monitor_port) as second:
                    first.sendall(request[:length])
                    second.sendall(request[:length])
                    self.assertEqual("pong", monitor.request("ping")["op"])
                    first.close()
                    second.sendall(request[length:])
                    self.assertRegex(second.recv(65536), rb"\AHTTP/1\.1 200 ")

    def test_writing_methods_are_refused(self):
        with Server() as xr3:
            for method in b"POST", b"PUT", b"DELETE", b"PATCH":
                answer = self.exchange(xr3, method + b" /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")
                self.assertRegex(answer, rb"\AHTTP/1\.1 405 ")
            head = self.exchange(xr3, b"HEAD /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            self.assertRegex(head, rb"(?s)\AHTTP/1\.1 200 .*\r\n\r\n\Z")


if __name__ == "__main__":
    unittest.main()
