"""Who may: tokens from a file, the environment or made by the server; what is free without one; where a
server may listen; and that a token is seen nowhere."""

import os
import pathlib
import re
import tempfile
import unittest
import urllib.error
import urllib.request

from support import LOCALHOST, MonitorError, Server, connect, run_xr3

TOKEN = "correct-horse-battery-staple"
WRONG = "correct-horse-battery-stable"
TOLD = r"#token=([A-Za-z0-9_-]{16,})\s"  # on standard error, past the log
CALLS = {"step": {"ticks": 1}, "run_until": {"tick": 5, "max_ticks": 5}, "pause": {}, "resume": {}, "rate": {"factor": 2},
         "reset": {}, "home": {}, "send": {"text": "E+5\r"}, "input": {"input": 1, "value": True},
         "block_move": {"name": "red", "yaw_deg": 1}, "block_remove": {"name": "red"}, "snapshot_save": {"inline": True},
         "key": {"function": "display"}, "lines": {}, "line_disconnect": {"line": 1}, "describe": {}}


class TokenFile:
    """A file with a token in it, as a context."""

    def __init__(self, text=TOKEN + "\n"):
        self.text = text

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        path = pathlib.Path(self.folder.name, "token")
        path.write_text(self.text, encoding="ascii")
        path.chmod(0o600)
        return str(path)

    def __exit__(self, *_):
        self.folder.cleanup()


class Case(unittest.TestCase):
    def guarded(self, *options, **more):
        """A server with the token, from a file."""
        path = self.enterContext(TokenFile())
        return self.enterContext(Server("--token-file", path, *options, **more))

    def refused(self, code, monitor, op, **members):
        with self.assertRaises(MonitorError) as caught:
            monitor.request(op, **members)
        self.assertEqual(code, caught.exception.code)
        return caught.exception


class Tokens(Case):
    def test_without_one_everybody_here_is_in_control(self):
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertEqual("control", monitor.hello["access"])
            monitor.call("step", ticks=1)

    def test_calls_need_it_and_reading_is_free(self):
        xr3 = self.guarded()
        with xr3.monitor() as monitor:
            self.assertEqual("read", monitor.hello["access"])
            for fn, arguments in CALLS.items():
                self.refused("token_required", monitor, "call", fn=fn, args=arguments)
            self.assertEqual(0, monitor.get("moving")["tick"])
            monitor.subscribe("state")
            self.assertEqual("state", monitor.read()["op"])
            self.assertEqual({"access": "control"}, monitor.request("auth", token=TOKEN)["value"])
            monitor.call("step", ticks=7)
        with xr3.monitor() as other:
            self.assertEqual(("read", 7), (other.hello["access"], other.get("moving")["tick"]), "each client by itself")
            self.refused("token_required", other, "call", fn="step", args={"ticks": 1})

    def test_a_wrong_one(self):
        xr3 = self.guarded()
        with xr3.monitor() as monitor:
            for wrong in WRONG, TOKEN[:-1], TOKEN + "x", "":
                self.refused("bad_token", monitor, "auth", token=wrong)
            self.refused("token_required", monitor, "call", fn="step", args={"ticks": 1})
            self.assertEqual("control", monitor.request("auth", token=TOKEN)["value"]["access"])

    def test_five_wrong_ones_end_the_connection(self):
        xr3 = self.guarded()
        with xr3.monitor() as monitor:
            for _ in range(5):
                monitor.send({"op": "auth", "id": 1, "token": WRONG})
            monitor.send({"op": "auth", "id": 2, "token": TOKEN})
            monitor.send({"op": "call", "id": 3, "fn": "step", "args": {"ticks": 1}})
            received = []
            while message := monitor.read():
                received.append(message)
            self.assertEqual(["bad_token"] * 5, [message["error"]["code"] for message in received[:-1]])
            self.assertEqual(("bye", "bad_token"), (received[-1]["op"], received[-1]["why"]))
        with xr3.monitor() as monitor:
            self.assertEqual(0, monitor.get("moving")["tick"])

    def test_auth_where_there_is_none(self):
        with Server() as xr3, xr3.monitor() as monitor:
            try:
                self.assertEqual("control", monitor.request("auth", token=WRONG)["value"]["access"])
            except MonitorError as error:
                self.assertEqual("bad_token", error.code)
            monitor.call("step", ticks=1)

    def test_odd_ones(self):
        xr3 = self.guarded()
        with xr3.monitor() as monitor:
            for members in {}, {"token": 5}, {"token": None}, {"token": [TOKEN]}:
                self.refused("bad_args", monitor, "auth", **members)

    def test_from_the_environment(self):
        with Server(environment={"XR3_TOKEN": TOKEN}) as xr3, xr3.monitor() as monitor:
            self.assertEqual("read", monitor.hello["access"])
            self.assertEqual("control", monitor.request("auth", token=TOKEN)["value"]["access"])

    def test_private(self):
        xr3 = self.guarded("--private")
        with xr3.monitor() as monitor:
            for channel in "state", "image", "event":
                self.refused("token_required", monitor, "get", channel=channel)
                self.refused("token_required", monitor, "sub", channel=channel)
            self.assertEqual("pong", monitor.request("ping")["op"])
            monitor.request("auth", token=TOKEN)
            self.assertEqual(0, monitor.get("moving")["tick"])
        self.assertEqual(200, self.http(xr3, "/healthz")[0])
        for path in "/state", "/robot", "/workcell", "/camera.png", "/camera.pbm", "/view.svg":
            status, body = self.http(xr3, path)
            self.assertIn(status, (401, 403), path)
            self.assertIn(b"token_required", body)

    def http(self, xr3, path):
        try:
            with urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}{path}") as answer:
                return answer.status, answer.read()
        except urllib.error.HTTPError as error:
            with error:
                return error.code, error.read()


class Starts(Case):
    def rejected(self, says, *arguments, **options):
        done = run_xr3("serve", "--robot-port", 0, "--monitor-port", 0, *arguments, **options)
        self.assertEqual((2, ""), (done.returncode, done.stdout), done.stderr)
        self.assertRegex(done.stderr, says)
        self.assertNotIn(TOKEN[:8], done.stderr)

    def test_tokens_that_are_too_short_or_not_there(self):
        with TokenFile("short\n") as path:
            self.rejected("16", "--token-file", path)
        with TokenFile("") as path:
            self.rejected("16", "--token-file", path)
        self.rejected("absent", "--token-file", "/absent/token")
        self.rejected("16", env={**os.environ, "XR3_TOKEN": "short"})

    def test_beyond_loopback_only_with_a_token_or_on_purpose(self):
        for address in "0.0.0.0", "::":
            self.rejected("--insecure", "--listen", address)
        with TokenFile() as path:
            for options in ["--token-file", path], ["--insecure"]:
                with Server("--listen", "0.0.0.0", *options) as xr3, xr3.monitor() as monitor:
                    self.assertEqual("read" if path in options else "control", monitor.hello["access"])

    def test_made_by_the_server(self):
        tokens = set()
        for _ in range(2):
            with Server("--token", "auto") as xr3, xr3.monitor() as monitor:
                self.assertEqual("read", monitor.hello["access"])
                token = re.search(TOLD, xr3.wait_log(TOLD))[1]
                self.assertEqual("control", monitor.request("auth", token=token)["value"]["access"])
                tokens.add(token)
        self.assertEqual(2, len(tokens))


class Secrecy(Case):
    def test_the_token_is_nowhere_to_be_seen(self):
        xr3 = self.guarded("--log-level", "trace")
        with xr3.monitor() as monitor, connect(xr3.monitor_port) as sock:
            monitor.request("auth", token=TOKEN)
            monitor.call("step", ticks=1)
            self.refused("bad_token", monitor, "auth", token=WRONG)
            monitor.send({"op": "auth", "id": TOKEN, "token": 5})
            monitor.read()
            monitor.send(b'{"op":"auth","token":"' + TOKEN.encode() + b'"\n')
            broken = monitor.read()
            self.assertNotIn(TOKEN, str(broken))
            sock.sendall(f"GET /state?token={TOKEN} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
            while sock.recv(65536):
                pass
            for file in "cmdline", "comm":
                with open(f"/proc/{xr3.pid}/{file}", "rb") as shown:
                    self.assertNotIn(TOKEN.encode(), shown.read())
            described = str(monitor.look("model")) + str(monitor.recall("event", since=0))
            self.assertNotIn(TOKEN, described)
        self.assertNotIn(TOKEN, xr3.log())
        self.assertNotIn(WRONG, xr3.log())


if __name__ == "__main__":
    unittest.main()
