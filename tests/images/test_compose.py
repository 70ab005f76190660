"""Tests of the compose files: they are valid, the lab starts and stops, and the test project has the exit
code of the check, which alone has the token."""

import json
import pathlib
import re
import shutil
import socket
import subprocess
import tempfile
import unittest
import urllib.request
import uuid

from containers import DEADLINE_S, LABEL, ROOT, environment_without_xr3, inspect
from xr3 import Monitor, MonitorError

LAB, TEST, CLASS = "docker/compose.yml", "docker/compose.test.yml", "docker/compose.class.yml"
FILES = (LAB, TEST, CLASS)
TOKEN = "a token of the tests"
SET = {"XR3_TOKEN": TOKEN, "CLASS": "/class", "CLASS_USER": "1000"}  # all that the files require
RECIPE = ROOT / "docs" / "ci"

PEEK = """
import json, os, socket
with socket.create_connection(("xr3", 9601)) as monitor, monitor.makefile("rw") as lines:
    print('{"op": "get", "id": 1, "channel": "state"}', file=lines, flush=True)
    answer = next(message for message in map(json.loads, lines) if message.get("id") == 1)
print(json.dumps({"error": answer["error"]["code"],
                  "variables": sorted(name for name in os.environ if "XR3" in name)}))
"""


def free_ports(count):
    """Free ports of this machine, because a compose file cannot ask for a free port."""
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [sock.getsockname()[1] for sock in sockets]
    for sock in sockets:
        sock.close()
    return ports


class Project:
    """A project of docker compose, removed at the end."""

    def __init__(self, file, **environment):
        self.command = ["docker", "compose", "-p", f"{LABEL}-{uuid.uuid4().hex[:8]}", "-f", file]
        self.environment = {**environment_without_xr3(), **environment}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.run("down")

    def run(self, *arguments):
        return subprocess.run([*self.command, *arguments], cwd=ROOT, env=self.environment, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, check=False,
                              timeout=2 * DEADLINE_S)


class Files(unittest.TestCase):
    def test_are_valid(self):
        for file in FILES:
            with self.subTest(file):
                done = Project(file, **SET).run("config", "--quiet")
                self.assertEqual(0, done.returncode, done.stdout + done.stderr)

    def test_every_service_is_limited(self):
        for file in FILES:
            with self.subTest(file):
                config = Project(file, **SET).run("config").stdout
                services = len(re.findall(r"^ +image: ", config, re.MULTILINE))
                self.assertGreater(services, 0, config)
                for setting in ("mem_limit", "pids_limit", "driver: json-file", "max-size: ", "max-file: "):
                    self.assertEqual(services, len(re.findall(rf"^ +{setting}", config, re.MULTILINE)), setting)

    def test_needs_a_token(self):
        for file in LAB, TEST:
            with self.subTest(file):
                done = Project(file).run("config", "--quiet")
                self.assertNotEqual(0, done.returncode)
                self.assertIn("XR3_TOKEN", done.stderr)


class Class(unittest.TestCase):
    def test_needs_a_folder_and_its_owner(self):
        for name in "CLASS", "CLASS_USER":
            done = Project(CLASS, **{other: value for other, value in SET.items() if other != name}).run("config", "--quiet")
            self.assertNotEqual(0, done.returncode)
            self.assertIn(name, done.stderr)


class Lab(unittest.TestCase):
    def test_starts_and_stops(self):
        robot_port, monitor_port = free_ports(2)
        with Project(LAB, XR3_TOKEN=TOKEN, XR3_ROBOT="adept-one", XR3_ROBOT_PORT=str(robot_port),
                     XR3_MONITOR_PORT=str(monitor_port)) as lab:
            up = lab.run("up", "-d", "--no-build")
            self.assertEqual(0, up.returncode, up.stderr)
            follower = subprocess.Popen([*lab.command, "logs", "--follow"], cwd=ROOT, text=True,
                                        env=lab.environment, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL)
            with follower:
                self.assertTrue(any("LISTENING" in line for line in follower.stdout))
                follower.kill()
            container = lab.run("ps", "--quiet").stdout.strip()
            self.assertEqual(1 << 30, inspect(container, ".HostConfig.Memory"))
            self.assertEqual(64, inspect(container, ".HostConfig.PidsLimit"))
            with urllib.request.urlopen(f"http://localhost:{monitor_port}/") as page:
                self.assertIn(b"<!doctype html>", page.read())
            with Monitor("127.0.0.1", monitor_port) as monitor:
                self.assertEqual("Adept One", monitor.hello["robot"]["name"])
                with self.assertRaises(MonitorError):
                    monitor.call("pause")
            with Monitor("127.0.0.1", monitor_port, token=TOKEN) as monitor:
                monitor.call("pause")
            with socket.create_connection(("127.0.0.1", robot_port)) as line:
                line.sendall(b"E?")
                self.assertEqual(b" ", line.recv(1))


class Student(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.folder.chmod(0o755)
        for name in ("my_program.py", "my_check.py"):
            shutil.copy(RECIPE / name, self.folder)

    def verdict(self, service="check", token=TOKEN, **environment):
        """The result of the service, with the output of the program in `program`."""
        with Project(TEST, XR3_TOKEN=token, **environment) as project:
            done = project.run("run", "--rm", "-T", service)
            done.program = project.run("logs", "student").stdout
            return done

    def test_a_correct_program_passes(self):
        done = self.verdict(STUDENT=str(self.folder))
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        self.assertIn("E is there", done.program)
        self.assertIn("the arm is where it should be", done.stdout)

    def test_a_wrong_program_fails(self):
        program = self.folder / "my_program.py"
        program.write_text(program.read_text(encoding="utf-8").replace("E+50", "E+49"),
                           encoding="utf-8")
        done = self.verdict(STUDENT=str(self.folder))
        self.assertNotEqual(0, done.returncode)
        self.assertIn("'E': 49", done.stdout + done.stderr)

    def test_a_program_that_fails_is_not_checked(self):
        done = self.verdict(RUN="exit 7", CHECK="echo checked")
        self.assertNotEqual(0, done.returncode)
        self.assertNotIn("checked", done.stdout)
        self.assertEqual(7, self.verdict("student", RUN="exit 7").returncode)

    def test_a_program_learns_nothing_at_the_monitor_port(self):
        """The check has no token, and without one the port shows no state."""
        (self.folder / "peek.py").write_text(PEEK, encoding="utf-8")
        done = self.verdict(STUDENT=str(self.folder), RUN="python3 peek.py", CHECK="true")
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        found = json.loads(re.search(r"\{.*\}", done.program)[0])
        self.assertEqual({"error": "token_required", "variables": ["XR3_HOST", "XR3_PORT"]}, found)


if __name__ == "__main__":
    unittest.main()
