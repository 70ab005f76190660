"""`xr3 healthcheck` with a real server, without a server, and with servers other than xr3."""

import contextlib
import os
import pathlib
import socket
import subprocess
import tempfile
import threading
import unittest

from support import DEADLINE_S, LOCALHOST, XR3, Server, run_xr3

NO_SERVER = 4
TOKEN = "a token of no meaning"
HELLO = b'{"op":"hello","proto":1,"server":"xr3 9.9.9"}\n'
PONG = b'{"op":"pong","id":"health"}\n'
READY = b"HTTP/1.1 200 OK\r\n\r\nok\n"
NOT_READY = b'HTTP/1.1 503 No\r\n\r\n{"error":{"code":"not_ready","message":"no line today","hint":"wait"}}'


@contextlib.contextmanager
def stand_in(*answers):
    """A server other than xr3: after the first byte of each connection it sends the next answer. It closes
    the connection at once if the answer is empty, else when the client closes. Without answers, connections
    stay in the accept queue. Yields the port."""
    with socket.create_server((LOCALHOST, 0)) as server:
        def serve():
            for answer in answers:
                client, _ = server.accept()
                with client:
                    client.recv(1)
                    client.sendall(answer)
                    while answer and client.recv(4096):  # discards other requests until the client closes
                        pass
        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        yield server.getsockname()[1]
        thread.join(DEADLINE_S)
        assert not thread.is_alive(), "not every answer was used"


@contextlib.contextmanager
def unused_port(family=socket.AF_INET, host=LOCALHOST):
    """A port on which no process listens; it is reserved until the end of the context."""
    with socket.socket(family) as taken:
        taken.bind((host, 0))
        yield taken.getsockname()[1]


def check(*arguments, environment=None):
    return run_xr3("healthcheck", *arguments, env={**os.environ, **(environment or {})})


class Healthcheck(unittest.TestCase):
    def healthy(self, *arguments, **how):
        done = check(*arguments, **how)
        self.assertEqual((0, "", ""), (done.returncode, done.stdout, done.stderr))

    def unhealthy(self, says, *arguments, code=NO_SERVER, **how):
        done = check(*arguments, **how)
        self.assertEqual((code, ""), (done.returncode, done.stdout), done.stderr)
        self.assertRegex(done.stderr, r"\Axr3: [^\n]+\n\Z", "one sentence on one line")
        self.assertRegex(done.stderr, says)

    def test_a_running_server_is_healthy(self):
        with Server() as xr3, xr3.monitor() as monitor:
            self.healthy("--monitor-port", xr3.monitor_port)
            self.healthy(environment={"XR3_MONITOR_PORT": str(xr3.monitor_port)})
            self.assertEqual([], monitor.call("lines")["lines"])
            self.assertNotIn("warning", xr3.log())

    def test_a_server_with_a_token_is_healthy(self):
        with tempfile.TemporaryDirectory() as folder:
            ports = pathlib.Path(folder, "ports.json")
            with Server("--private", "--port-file", ports, environment={"XR3_TOKEN": TOKEN}):
                self.healthy("--port-file", ports)
            with Server("--token", "auto", "--port-file", ports):
                self.healthy(environment={"XR3_PORT_FILE": str(ports), "XR3_MONITOR_PORT": "0"})

    def test_every_listen_address(self):
        for listen in "localhost", "127.0.0.1", "127.9.9.9", "0.0.0.0", "::1", "::":
            with self.subTest(listen), Server("--listen", listen, "--insecure") as xr3:
                port = xr3.greeting.rsplit(":", 1)[1].strip()
                self.healthy("--listen", listen, "--monitor-port", port)
                self.healthy(environment={"XR3_LISTEN": listen, "XR3_MONITOR_PORT": port})

    def test_it_has_no_side_effects(self):
        with Server("--log-level", "debug") as xr3, xr3.monitor() as monitor:
            log = xr3.page() and xr3.log()
            for _ in range(3):
                self.healthy("--monitor-port", xr3.monitor_port)
            self.assertEqual([], monitor.recall("event"))
            self.assertEqual([], monitor.recall("line"))
            self.assertEqual(log, xr3.log())
            line = xr3.line()
            line.send("E+5\r")
            monitor.step(1, after=line)
            self.assertEqual([1], [line["line"] for line in monitor.call("lines")["lines"]])

    def test_a_server_with_all_lines_taken_is_not_ready(self):
        with Server("--max-lines", 1) as xr3:
            line = xr3.line()
            line.ask("E?")
            self.unhealthy(r"is not ready: every line is in use: 1 are open \(--max-lines\)",
                           "--monitor-port", xr3.monitor_port)
            line.ask("E?")
            line.finish_sending()
            self.assertEqual(b"", line.read_to_end())
            self.healthy("--monitor-port", xr3.monitor_port, "--wait", DEADLINE_S)

    def test_a_closed_port_is_unhealthy(self):
        with unused_port() as port:
            self.unhealthy(rf"cannot connect to 127\.0\.0\.1:{port} \(Connection refused\)",
                           "--monitor-port", port)
        with unused_port(socket.AF_INET6, "::1") as port:
            self.unhealthy(rf"\[::1\]:{port}", "--monitor-port", port, "--listen", "::")

    def test_other_servers_are_unhealthy(self):
        with stand_in(b"HTTP/1.1 400 Bad Request\r\n\r\n") as port:
            self.unhealthy("is not xr3: it sends \"HTTP/1.1 400 Bad", "--monitor-port", port)

    def test_the_robot_port_is_unhealthy(self):
        with Server() as xr3, xr3.monitor() as monitor:
            before = monitor.get("joints", "moving")
            self.unhealthy("sends nothing", "--monitor-port", xr3.robot_port, "--wait", "0.1")
            after = monitor.get("joints", "moving")
            self.assertEqual(before["joints"], after["joints"])

    def test_a_silent_server_times_out(self):
        with stand_in() as port:  # connections succeed, but receive nothing
            self.unhealthy("sends nothing", "--monitor-port", port, "--wait", "0.1")
        with socket.socket() as server:
            server.bind((LOCALHOST, 0))
            server.listen(0)
            address = server.getsockname()
            with contextlib.ExitStack() as waiting:  # fills the accept queue, so that no connection succeeds
                for _ in range(3):
                    client = waiting.enter_context(socket.socket())
                    client.setblocking(False)
                    client.connect_ex(address)
                self.unhealthy("timed out", "--monitor-port", address[1], "--wait", "0.1")

    def test_waits_until_it_is_healthy(self):
        answers = [b"HTTP/1.1 503 Starting\r\n\r\n", b"", HELLO + PONG, NOT_READY, HELLO + PONG, READY]
        with stand_in(*answers) as port:  # which sees to it that each was asked for
            self.healthy("--monitor-port", port, "--wait", DEADLINE_S)

    def test_waits_for_a_server_that_starts_later(self):
        with tempfile.TemporaryDirectory() as folder:
            ports = pathlib.Path(folder, "ports.json")
            self.unhealthy("ports.json", "--port-file", ports)
            with subprocess.Popen([XR3, "healthcheck", "--port-file", ports, "--wait", str(DEADLINE_S)]) as waiting, \
                    Server("--port-file", ports):
                self.assertEqual(0, waiting.wait(DEADLINE_S))

    def test_waits_for_a_closed_port_to_open(self):
        with socket.socket() as server:
            server.bind((LOCALHOST, 0))
            port = server.getsockname()[1]
            with subprocess.Popen([XR3, "healthcheck", "--monitor-port", str(port), "--wait", str(DEADLINE_S)]) as waiting:
                server.listen()
                for answer in HELLO + PONG, READY:
                    client, _ = server.accept()
                    with client:
                        client.sendall(answer)
                        while client.recv(4096):
                            pass
                self.assertEqual(0, waiting.wait(DEADLINE_S))

    def test_invalid_port_files_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            ports = pathlib.Path(folder, "ports.json")
            for text in "", "{", "[]", "{}", '{"monitor":"9601"}', '{"monitor":0}', '{"monitor":65536}', '{"monitor":-1}':
                with self.subTest(text):
                    ports.write_text(text, encoding="ascii")
                    for wait in [], ["--wait", "0.1"]:
                        self.unhealthy("ports.json: contains no monitor port", "--port-file", ports, *wait, code=2)
            self.unhealthy("is a folder", "--port-file", folder, code=2)

    def test_waits_for_an_incomplete_port_file(self):
        with tempfile.TemporaryDirectory() as folder, Server() as xr3:
            ports = pathlib.Path(folder, "ports.json")
            ports.write_text("{", encoding="ascii")
            with subprocess.Popen([XR3, "healthcheck", "--port-file", ports, "--wait", str(DEADLINE_S)]) as waiting:
                with self.assertRaises(subprocess.TimeoutExpired, msg="it waits"):
                    waiting.wait(0.2)
                ports.write_text(f'{{"monitor": {xr3.monitor_port}}}', encoding="ascii")
                self.assertEqual(0, waiting.wait(DEADLINE_S))

    def test_invalid_arguments_are_refused(self):
        self.unhealthy(r"--wait: abc: a number from 0 to 86400;", "--wait", "abc", code=2)


if __name__ == "__main__":
    unittest.main()
