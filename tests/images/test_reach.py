"""Access to a server in a container: from this machine by mapped ports, from a second container by the
service's name, and calls without a token."""

import asyncio
import concurrent.futures
import json
import pathlib
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

import websockets

from containers import ROOT, Network, Robot
from xr3 import MonitorError

sys.path.insert(0, str(ROOT / "tests" / "clients"))

import examples  # noqa: E402

TOKEN = "a token of the tests"
COMMANDS = {"python": "cd /clients/python && python3 {}.py", "c": "/clients/c/build/{}"}
BY_NAME = ROOT / "tests" / "images" / "by_name.py"
AT_ONCE = 3
PROFILE = "paper"  # that of a server without options


def get(url, host=None):
    """(code, text) of a GET; `host` replaces the Host header."""
    request = urllib.request.Request(url, headers={"Host": host} if host else {})
    try:
        with urllib.request.urlopen(request, timeout=20) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


class MappedPort(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(XR3_TOKEN=TOKEN, XR3_ALLOW_HOST="robot.lab").__enter__()
        cls.addClassCleanup(cls.robot.__exit__)
        cls.page = f"http://localhost:{cls.robot.monitor_port}/"

    def test_the_page_and_its_script(self):
        code, page = get(self.page)
        self.assertEqual(200, code)
        self.assertIn("<!doctype html>", page)
        code, script = get(self.page + "assets/main.js")
        self.assertEqual(200, code)
        self.assertGreater(len(script), 100_000)

    def test_allowed_host_names(self):
        for host, code in (("127.0.0.1", 200), ("lab-server", 200), ("robot.lab", 200),
                           ("evil.example", 403)):
            with self.subTest(host):
                self.assertEqual(code, get(self.page, host)[0])

    def test_calls_need_the_token(self):
        with self.robot.monitor() as monitor:
            self.assertEqual("read", monitor.hello["access"])
            monitor.state()
            with self.assertRaises(MonitorError) as refused:
                monitor.call("pause")
        print(f"\nwithout a token: {refused.exception}")
        self.assertIn("token", refused.exception.code)
        with self.robot.monitor(TOKEN) as monitor:
            monitor.call("pause")
            monitor.call("resume")

    def test_websocket(self):
        asyncio.run(self.talk_by_websocket())

    async def talk_by_websocket(self):
        address = f"ws://localhost:{self.robot.monitor_port}/ws"
        origin = f"http://localhost:{self.robot.monitor_port}"
        async with websockets.connect(address, origin=origin, subprotocols=["xr3.v1"]) as page:
            hello = json.loads(await page.recv())
            self.assertEqual("hello", hello["op"])
            call = json.dumps({"op": "call", "id": 1, "fn": "home", "args": {}})
            await page.send(call)
            self.assertFalse(json.loads(await page.recv())["ok"])
            await page.send(json.dumps({"op": "auth", "id": 2, "token": TOKEN}))
            self.assertTrue(json.loads(await page.recv())["ok"])
            await page.send(call)
            self.assertTrue(json.loads(await page.recv())["ok"])

    def test_a_robot_line(self):
        with examples.Robot("127.0.0.1", self.robot.robot_port) as robot:
            self.assertEqual(0, robot.to_go("E"))


class SecondContainer(unittest.TestCase):
    """A second container finds the server by its name. Every Python and C example does so, with a new
    server each."""

    @classmethod
    def setUpClass(cls):
        cls.network = Network().__enter__()
        cls.addClassCleanup(cls.network.__exit__)

    def test_reaches_the_server_by_service_name(self):
        with Robot(f"--network={self.network.name}", "--network-alias=xr3", XR3_TOKEN=TOKEN):
            options = [f"--volume={BY_NAME}:/by_name.py:ro", "-e", "PYTHONPATH=/clients/python"]
            seen = self.network.student("python3", "/by_name.py", "xr3", TOKEN, options=options)
        self.assertEqual(["page", "websocket", "calls", "line"], seen.stdout.split())

    def test_examples(self):
        every = [(language, example) for language in COMMANDS for example in examples.EXAMPLES]
        with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
            for what, fault in zip(every, pool.map(lambda what: self.fault_of(*what), every)):
                with self.subTest(language=what[0], example=what[1]):
                    self.assertIsNone(fault)

    def fault_of(self, language, example):
        try:
            self.run_example(language, example)
        except (AssertionError, OSError, examples.Wrong) as fault:
            return str(fault)
        return None

    def run_example(self, language, example):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder).chmod(0o755)
            table = examples.workcell_for(example, folder)
            with Robot(f"--network={self.network.name}", f"--volume={table}:/lab/table.json:ro",
                       XR3_WORKCELL="/lab/table.json", XR3_CLOCK="real:50", XR3_INSECURE=1) as robot, \
                    robot.monitor() as monitor:
                if example == "3_home":
                    examples.displace(robot)
                blocks = {block["name"]: block for block in monitor.state("blocks")["blocks"]}
                command = COMMANDS[language].format(example)
                printed = self.network.student("sh", "-c", command,
                                               options=["-e", f"XR3_HOST={robot.name}"]).stdout
                examples.check_output(example, PROFILE, printed)
                examples.check_outcome(monitor, examples.OUTCOMES[example], blocks)


if __name__ == "__main__":
    unittest.main()
