"""HTTP resources of the monitor port, with curl: GET and HEAD of every resource, errors, and persistent
connections."""

import json
import pathlib
import subprocess
import tempfile
import unittest

import monitor_schema
from support import DEADLINE_S, LOCALHOST, ROOT, Server, connect, machine, run_xr3

RESOURCES = {"/": "text/html; charset=utf-8", "/healthz": "text/plain; charset=utf-8",
             "/readyz": "text/plain; charset=utf-8", "/metrics": "text/plain; version=0.0.4; charset=utf-8",
             "/state": "application/json", "/robot": "application/json", "/workcell": "application/json",
             "/schema/v1.json": "application/json", "/sites": "application/json", "/camera.png": "image/png",
             "/camera.pbm": "image/x-portable-bitmap", "/view.svg": "image/svg+xml"}
SAFETY = {"x-content-type-options": "nosniff", "cross-origin-resource-policy": "same-origin",
          "content-security-policy": "default-src 'self'; frame-ancestors 'none'; base-uri 'none'"}
PAGE_POLICY = ("default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; frame-ancestors 'none'; "
               "base-uri 'none'")
GET = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"


def curl(xr3, path, *options):
    """Returns status, fields (names in lower case) and body."""
    url = f"http://{LOCALHOST}:{xr3.monitor_port}{path}"
    done = subprocess.run(["curl", "--silent", "--show-error", "--include", *options, url], capture_output=True,
                          timeout=DEADLINE_S, check=True)
    head, _, body = done.stdout.partition(b"\r\n\r\n")
    status, *fields = head.decode().split("\r\n")
    return int(status.split()[1]), {name.lower(): value for name, value in (f.split(": ", 1) for f in fields)}, body


class Resources(unittest.TestCase):
    def test_every_resource(self):
        with Server() as xr3:
            for path, kind in RESOURCES.items():
                with self.subTest(path):
                    status, fields, body = curl(xr3, path)
                    self.assertEqual((200, kind), (status, fields["content-type"]))
                    self.assertEqual(len(body), int(fields["content-length"]))
                    safety = {**SAFETY, "content-security-policy": PAGE_POLICY} if path == "/" else SAFETY
                    self.assertEqual(safety, {name: fields.get(name) for name in SAFETY})
                    self.assertFalse([name for name in fields if name.startswith("access-control")])
                    status, head, nothing = curl(xr3, path, "--head")
                    self.assertEqual((200, fields["content-type"], b""), (status, head["content-type"], nothing))

    def test_unknown_resources(self):
        with Server("--robot", "adept-one") as xr3:
            for path, status, code in [("/nothing", 404, "not_found"), ("/state?cell=other", 404, "unknown_cell"),
                                       ("/?cell=none", 404, "unknown_cell"),
                                       ("/view.svg?vector=0,0,0", 400, "bad_vector"), ("/assets/none.js", 404, "not_found"),
                                       ("/ws", 426, "upgrade_required")]:
                with self.subTest(path):
                    got, _, body = curl(xr3, path)
                    error = json.loads(body)["error"]
                    self.assertEqual((status, code), (got, error["code"]))
                    self.assertEqual({"code", "message", "hint"}, set(error))

    def test_requests_change_nothing(self):
        with Server() as xr3, xr3.monitor() as monitor:
            before = machine(monitor.get())
            for method in "POST", "PUT", "DELETE", "OPTIONS", "PATCH":
                status, fields, _ = curl(xr3, "/state", "--request", method, "--data", "x")
                self.assertEqual((405, "GET, HEAD", "close"), (status, fields["allow"], fields["connection"]))
            self.assertEqual(before, machine(monitor.get()))


class Contents(unittest.TestCase):
    def test_the_state_equals_the_message(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+5\r")
            monitor.step(100, after=line)
            shown = monitor_schema.check(json.loads(curl(xr3, "/state")[2]))
            message = monitor.get()
            message.pop("id")
            self.assertEqual(message, shown)

    def test_the_workcell_starts_a_server_with_its_blocks(self):
        with Server() as xr3, xr3.monitor() as monitor, tempfile.TemporaryDirectory() as folder:
            monitor.call("block_move", name="red", yaw_deg=12)
            path = pathlib.Path(folder, "now.json")
            path.write_bytes(curl(xr3, "/workcell")[2])
            self.assertEqual(0, run_xr3("check", path).returncode)
            with Server("--workcell", path) as again, again.monitor() as other:
                self.assertEqual(monitor.get("blocks")["blocks"], other.get("blocks")["blocks"])

    def test_images(self):
        with Server() as xr3, tempfile.TemporaryDirectory() as folder:
            self.assertEqual(curl(xr3, "/camera.pbm")[2], pathlib.Path(ROOT, "tests/golden/rhino-xr3.pbm").read_bytes())
            self.assertEqual(b"\x89PNG\r\n\x1a\n", curl(xr3, "/camera.png")[2][:8])
            drawn = pathlib.Path(folder, "drawn.svg")
            run_xr3("draw", "--view", "1,-1,1", drawn)
            self.assertEqual(drawn.read_bytes(), curl(xr3, "/view.svg?vector=1%2C-1,1")[2])

    def test_metrics_count(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+5\rE?x")
            monitor.step(1500, after=line)
            line.read(1)
            text = curl(xr3, "/metrics")[2].decode()
            samples = dict(row.rsplit(" ", 1) for row in text.splitlines() if not row.startswith("#"))
            for name, value in [('xr3_lines_open{cell="main"}', 1), ('xr3_bytes_in_total{cell="main"}', 7),
                                ('xr3_bytes_out_total{cell="main"}', 1), ('xr3_viewers{cell="main"}', 1),
                                ('xr3_commands_total{cell="main",kind="move"}', 1),
                                ('xr3_ticks_total{cell="main"}', 1500),
                                ('xr3_simulated_seconds_total{cell="main"}', 1.5)]:
                self.assertEqual(value, float(samples[name]), name)


class Connections(unittest.TestCase):
    def read_answer(self, file):
        head = b"".join(iter(file.readline, b"\r\n")).decode()
        size = int(head.lower().split("content-length: ")[1].split("\r\n")[0]) if head else 0
        return head, file.read(size)

    def test_one_connection_for_many_requests(self):
        with Server() as xr3, connect(xr3.monitor_port) as sock, sock.makefile("rb") as file:
            for _ in range(3):
                sock.sendall(b"\r\n")  # arrives alone, since the server answers another client before the request
                self.assertEqual(b"ok\n", curl(xr3, "/healthz")[2])
                sock.sendall(GET)
                head, body = self.read_answer(file)
                self.assertIn("Connection: keep-alive\r\n", head)
                self.assertEqual(b"ok\n", body)
            sock.sendall(GET * 50 + b"\r\n" + GET.replace(b"\r\n\r\n", b"\r\nConnection: close\r\n\r\n"))
            for _ in range(50):
                self.assertEqual(b"ok\n", self.read_answer(file)[1])
            self.assertIn("Connection: close\r\n", self.read_answer(file)[0])
            self.assertEqual(b"", file.read())

    def test_errors_and_close_end_the_connection(self):
        with Server() as xr3:
            for data in [b"HELP\r\n", b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99\r\n\r\n",
                         b"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n",
                         b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: 44\r\n\r\n" + GET]:
                with self.subTest(data), connect(xr3.monitor_port) as sock, sock.makefile("rb") as file:
                    sock.sendall(data)
                    self.assertIn("Connection: close\r\n", self.read_answer(file)[0])
                    self.assertEqual(b"", file.read())

    def test_shutdown_closes_idle_connections(self):
        """Server.stop() fails if it takes longer than two seconds."""
        with Server() as xr3, connect(xr3.monitor_port) as sock, sock.makefile("rb") as file:
            sock.sendall(GET)
            self.read_answer(file)
            xr3.stop()
            self.assertEqual(b"", file.read())


if __name__ == "__main__":
    unittest.main()
