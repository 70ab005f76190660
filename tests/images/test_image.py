"""Tests of the run image: size, permissions, start time, health check, options and shutdown."""

import datetime
import os
import pathlib
import pty
import re
import select
import statistics
import subprocess
import tarfile
import tempfile
import time
import unittest

from containers import (DEADLINE_S, HARDENED, IMAGE, LABEL, STUDENT, USER, Robot, docker, inspect)
from xr3 import MonitorError

MOST_BYTES = 60_000_000
MOST_START_MS = 100
MOST_HEALTHCHECK_MS = 100  # a check every 5 s then takes 2 % of a processor
TOKEN = "a token of the tests"
STARTS = 5
CHECKS = 21

# Programs that run in a student's container with the run image's files at /image. They time the process
# alone, without the work of the engine. (XR3_DATA: without /proc, xr3 cannot find its data.)
INSIDE_IMAGE = """
import os, subprocess, time
os.environ["XR3_DATA"] = "/usr/share/xr3"
os.chroot("/image")
"""
TIME_HEALTHCHECK = INSIDE_IMAGE + f"""
for _ in range({CHECKS}):
    start = time.monotonic()
    process = os.posix_spawn("/usr/bin/xr3", ["xr3", "healthcheck"], os.environ)
    assert os.waitpid(process, 0)[1] == 0
    print((time.monotonic() - start) * 1e3)
"""
TIME_START = INSIDE_IMAGE + """
start = time.monotonic()
with subprocess.Popen(["/usr/bin/xr3", "serve"], stdout=subprocess.PIPE, text=True) as xr3:
    line = xr3.stdout.readline()
    print((time.monotonic() - start) * 1e3, line)
    xr3.terminate()
"""


def instant(text):
    """Converts the engine's time format, with nanoseconds, to seconds since 1970."""
    date, clock, fraction = re.match(r"(\S{10}).(\d\d:\d\d:\d\d)\.(\d+)", text).groups()
    seconds = datetime.datetime.fromisoformat(f"{date}T{clock}+00:00").timestamp()
    return seconds + float(f"0.{fraction}")


class Image(unittest.TestCase):
    def test_is_small(self):
        size = inspect(IMAGE, ".Size")
        print(f"\nthe run image has {size / 1e6:.1f} MB (maximum {MOST_BYTES / 1e6:.0f})")
        self.assertLess(size, MOST_BYTES)

    def test_config_has_user_ports_and_signal(self):
        config = inspect(IMAGE, ".Config")
        self.assertEqual(f"{USER}:{USER}", config["User"])
        self.assertEqual({"9600/tcp", "9601/tcp"}, set(config["ExposedPorts"]))
        self.assertIn(config["StopSignal"], ("SIGTERM", "15"))

    def test_has_its_licences_and_the_documentation(self):
        with tempfile.TemporaryDirectory() as folder:
            root = extract(folder)
            names = {path.name for path in (root / "usr/share/doc").iterdir()}
            self.assertLessEqual({"xr3", "three", "pyodide", "cpython", "mkdocs-material", "libc6", "libstdc++6", "libnettle8"}, names)
            for name in names:
                self.assertTrue((root / "usr/share/doc" / name / "copyright").read_text(encoding="utf-8"))
            for site in "docs", "play":
                self.assertTrue((root / "usr/share/xr3" / site / "index.html").exists())

    def test_refuses_to_start_without_a_token(self):
        done = docker("run", "--rm", "--label", LABEL, *HARDENED, IMAGE, fails=True)
        self.assertEqual(2, done.returncode)
        self.assertEqual("", done.stdout)
        for word in ("XR3_TOKEN", "XR3_TOKEN_FILE", "XR3_INSECURE=1"):
            self.assertIn(word, done.stderr)

    def test_other_commands(self):
        robot = docker("run", "--rm", "--label", LABEL, "--network=none", *HARDENED, IMAGE, "kin",
                       "--robot", "adept-one", "--joints", "0,0,0,0")
        self.assertNotEqual("", robot.stdout)


class Start(unittest.TestCase):
    def test_listens_quickly(self):
        """Measures from the start that the engine recorded to the log's time of the line LISTENING; and
        also, as an upper bound, from the request to the engine."""
        started, asked = [], []
        for _ in range(STARTS):
            with Robot(XR3_INSECURE=1) as robot:
                lines = robot.log("--timestamps").splitlines()
                listening = instant(next(line for line in lines if "LISTENING" in line))
                started.append((listening - instant(robot.state("StartedAt"))) * 1e3)
                asked.append((listening - robot.asked_to_start) * 1e3)
        print(f"\nLISTENING {statistics.median(started):.0f} ms after the container's start (maximum"
              f" {max(started):.0f}); {statistics.median(asked):.0f} ms after the request to the engine")
        self.assertLess(max(started), MOST_START_MS)

    def test_start_of_the_program_without_the_engine(self):
        with tempfile.TemporaryDirectory() as folder:
            took, _, line = in_image(folder, TIME_START, "--network=none").partition(" ")
        self.assertIn("LISTENING", line)
        print(f"\nthe program alone, without the engine, is LISTENING {float(took):.0f} ms after its start")
        self.assertLess(float(took), MOST_START_MS)


def extract(folder):
    """Extracts the files of the run image into a folder; returns their root."""
    name = f"{LABEL}-files"
    docker("create", "--name", name, "--label", LABEL, IMAGE)
    try:
        archive = pathlib.Path(folder, "image.tar")
        docker("export", "--output", archive, name)
    finally:
        docker("rm", name)
    root = pathlib.Path(folder, "image")
    with tarfile.open(archive) as tar:
        tar.extractall(root)
    archive.unlink()
    return root


def in_image(folder, program, *options):
    """Runs a Python program in a student's container, as root, with the run image's files at /image."""
    return docker("run", "--rm", "--label", LABEL, "--user=0", "--volume",
                  f"{extract(folder)}:/image:ro", *options, STUDENT, "python3", "-c", program).stdout


class Running(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(XR3_TOKEN=TOKEN, XR3_ROBOT="adept-one").__enter__()
        cls.addClassCleanup(cls.robot.__exit__)

    def beside(self, *command):
        """The output of a program that can see the processes of the server's container."""
        return docker("run", "--rm", "--label", LABEL, "--network=none", "--user", USER,
                      f"--pid=container:{self.robot.name}", STUDENT, *command).stdout

    def test_runs_as_process_one_of_an_unprivileged_user(self):
        status = dict(re.findall(r"^(\w+):\s*(.*)$", self.beside("cat", "/proc/1/status"), re.M))
        self.assertEqual("xr3", status["Name"])
        self.assertEqual([USER] * 4, status["Uid"].split())
        self.assertEqual([USER] * 4, status["Gid"].split())
        for capabilities in ("CapInh", "CapPrm", "CapEff", "CapBnd", "CapAmb"):
            self.assertEqual(0, int(status[capabilities], 16), capabilities)
        self.assertEqual("1", status["NoNewPrivs"])

    def test_cannot_write_its_files(self):
        for user in (USER, "0"):
            with self.subTest(user=user):
                done = self.robot.execute("xr3", "draw", "/usr/share/xr3/picture.svg",
                                          options=["--user", user], fails=True)
                self.assertRegex(done.stderr, "Read-only file system|cannot be written")
        mounts = self.beside("cat", "/proc/1/mounts")
        self.assertRegex(mounts, r"(?m)^\S+ / \S+ ro,")

    def test_options_come_from_the_environment(self):
        with self.robot.monitor() as monitor:
            self.assertEqual("Adept One", monitor.hello["robot"]["name"])

    def test_healthcheck(self):
        self.assertEqual(["CMD", "/usr/bin/xr3", "healthcheck"],
                         inspect(self.robot.name, ".Config.Healthcheck")["Test"])
        self.assertEqual("", self.robot.execute("/usr/bin/xr3", "healthcheck").stdout)
        other = self.robot.execute("/usr/bin/xr3", "healthcheck", "--monitor-port", "9",
                                   fails=True)
        self.assertEqual(4, other.returncode)

    def test_the_engine_reports_healthy(self):
        if "XR3_ENGINE" in os.environ:
            docker("healthcheck", "run", self.robot.name)  # podman leaves this to systemd
        else:
            wait_healthy(self.robot.name)
        self.assertEqual("healthy", inspect(self.robot.name, ".State")["Health"]["Status"])

    def test_healthcheck_is_fast(self):
        with tempfile.TemporaryDirectory() as folder:
            printed = in_image(folder, TIME_HEALTHCHECK, f"--network=container:{self.robot.name}")
        took = sorted(map(float, printed.split()))
        print(f"\nhealthcheck takes {statistics.median(took):.1f} ms (maximum {took[-1]:.1f})")
        self.assertLess(statistics.median(took), MOST_HEALTHCHECK_MS)

    def test_watch(self):
        printed = self.robot.execute("xr3", "watch").stdout
        self.assertIn("Adept", printed)

    def test_watch_at_a_terminal(self):
        screen, terminal = pty.openpty()
        command = ["docker", "exec", "-it", "-e", "TERM=xterm", self.robot.name, "xr3", "watch"]
        with subprocess.Popen(command, stdin=terminal, stdout=terminal, stderr=terminal) as watch:
            os.close(terminal)
            seen = b""
            deadline = time.monotonic() + DEADLINE_S
            while b"Adept" not in seen:
                ready, _, _ = select.select([screen], [], [], deadline - time.monotonic())
                self.assertTrue(ready, seen)
                seen += os.read(screen, 65536)
            os.write(screen, b"q")
            self.assertEqual(0, watch.wait(DEADLINE_S))
        os.close(screen)


def wait_healthy(name):
    """Waits for docker's event that the container's health has changed."""
    command = ["docker", "events", "--since", "10m", "--filter", f"container={name}",
               "--filter", "event=health_status", "--format", "{{.Action}}"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as events:
        try:
            ready, _, _ = select.select([events.stdout], [], [], DEADLINE_S)
            assert ready, "docker did not check the container's health"
        finally:
            events.kill()


class Options(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.folder.chmod(0o755)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        path.chmod(0o644)
        return f"--volume={path}:/lab/{name}:ro"

    def test_a_config_file(self):
        mounted = self.file("lab.toml", 'robot = "intelledex-660"\nclock = "manual"\n')
        with Robot(mounted, command=("serve", "--config", "/lab/lab.toml"), XR3_INSECURE=1) as robot, \
                robot.monitor() as monitor:
            self.assertEqual("Intelledex 660", monitor.hello["robot"]["name"])
            self.assertEqual("manual", monitor.state()["clock"]["mode"])
        with Robot(mounted, XR3_CONFIG="/lab/lab.toml", XR3_CLOCK="real:3", XR3_INSECURE=1) as robot, \
                robot.monitor() as monitor:
            self.assertEqual("Intelledex 660", monitor.hello["robot"]["name"])
            self.assertEqual({"mode": "real", "rate": 3.0}, monitor.state()["clock"])
            self.assertEqual("", robot.execute("xr3", "healthcheck").stdout)

    def test_a_token_file_of_its_owner(self):
        """Only the owner may read the file, and the container runs as that user."""
        mounted = self.file("token", TOKEN + "\n")
        (self.folder / "token").chmod(0o400)
        with Robot(mounted, f"--user={os.getuid()}", XR3_TOKEN_FILE="/lab/token") as robot:
            robot.wait_log("LISTENING")
            self.assertNotIn("every user of this machine", robot.log())

    def test_a_token_file(self):
        mounted = self.file("token", TOKEN + "\n")
        with Robot(mounted, XR3_TOKEN_FILE="/lab/token") as robot:
            with robot.monitor() as monitor, self.assertRaises(MonitorError):
                monitor.call("pause")
            with robot.monitor(TOKEN) as monitor:
                monitor.call("pause")


class Stop(unittest.TestCase):
    def test_sigterm_closes_clients_properly(self):
        with Robot(XR3_INSECURE=1) as robot, robot.monitor() as monitor:
            start = time.monotonic()
            docker("stop", robot.name)
            took = time.monotonic() - start
            bye = monitor.read()
            self.assertEqual(("bye", "shutdown"), (bye["op"], bye["why"]))
            self.assertEqual(0, robot.state("ExitCode"), "the engine kills what does not end in 10 s")
            print(f"\n`docker stop` takes {took:.1f} s")


if __name__ == "__main__":
    unittest.main()
