"""deploy/systemd: the unit is valid and hardened, and its command line starts the real server, which reports
to a service manager. systemd-analyze checks more, where it is installed."""
# labels: full

import os
import pathlib
import re
import resource
import shlex
import shutil
import signal
import socket
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, ROOT, XR3, Server

FOLDER = pathlib.Path(ROOT, "deploy", "systemd")
UNIT = FOLDER / "xr3.service"
PROGRAM = "/usr/local/bin/xr3"
TOKEN = "a token of the tests\n"
MOST_EXPOSURE = 2.0
# The server allows this number of sockets, and 36 other descriptors: server/net/socket_limits.
DESCRIPTORS = 36 + 64 + 1024 + 64
ANALYZE = shutil.which("systemd-analyze")
NEEDS_ANALYZE = unittest.skipUnless(ANALYZE, "needs systemd-analyze, which is in the package systemd")


def settings():
    """The settings of the unit: lists of values by (section, name)."""
    found, section = {}, None
    for line in UNIT.read_text(encoding="utf-8").splitlines():
        if heading := re.fullmatch(r"\[(\w+)\]", line):
            section = heading[1]
        elif line and not line.startswith("#"):
            name, equals, value = line.partition("=")
            assert section and equals and re.fullmatch(r"\w+", name), line
            found.setdefault((section, name), []).append(value)
    return found


def analyze(*arguments):
    return subprocess.run([ANALYZE, *map(str, arguments)], capture_output=True, text=True, check=False,
                          timeout=DEADLINE_S, env={**os.environ, "SYSTEMD_COLORS": "0", "SYSTEMD_PAGER": "cat"})


class Unit(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.settings = settings()

    def value(self, name, section="Service"):
        self.assertEqual(1, len(self.settings[section, name]), name)
        return self.settings[section, name][0]

    def command(self):
        """ExecStart of the unit with the files of this test instead of those in /etc and of systemd."""
        (self.folder / "token").write_text(TOKEN, encoding="utf-8")
        (self.folder / "token").chmod(0o400)
        words = shlex.split(self.value("ExecStart"))
        self.assertEqual([PROGRAM, "serve"], words[:2])
        places = {"%d/token": self.folder / "token", "/etc/xr3/xr3.toml": FOLDER / "xr3.toml"}
        return [XR3, *(str(places.get(word, word)) for word in words[1:])]

    def test_the_command_line_starts_the_server(self):
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
            manager.bind(str(self.folder / "notify"))
            manager.settimeout(DEADLINE_S)
            environment = {"NOTIFY_SOCKET": str(self.folder / "notify"), "WATCHDOG_USEC": "1000000"}
            with Server(command=self.command(), clock="real", environment=environment) as xr3:
                self.assertEqual(["READY=1", "WATCHDOG=1"], [manager.recv(64).decode() for _ in range(2)])
                with xr3.monitor() as monitor:
                    self.assertEqual("read", monitor.hello["access"])
                    self.assertIn("result", monitor.request("auth", token=TOKEN.strip())["op"])
                self.assertNotIn("warn", xr3.log())

    def test_the_token_and_the_options_are_those_of_the_service(self):
        self.assertEqual("token:/etc/xr3/token", self.value("LoadCredential"))
        self.assertIn("--token-file %d/token", self.value("ExecStart"))
        self.assertIn("--config /etc/xr3/xr3.toml", self.value("ExecStart"))

    def test_the_files_of_the_options_are_in_folders_of_the_service(self):
        """The options that xr3.toml shows in comments, with a folder of this test instead of the root folder."""
        folders = {f"{place}/{self.value(name)}" for name, place in
                   (("StateDirectory", "/var/lib"), ("LogsDirectory", "/var/log"), ("RuntimeDirectory", "/run"))}
        for name in "StateDirectory", "LogsDirectory", "RuntimeDirectory":
            self.assertEqual("0700", self.value(f"{name}Mode"))
        text = (FOLDER / "xr3.toml").read_text(encoding="utf-8")
        shown = dict(re.findall(r'^# ([\w-]+) = "(/.*)"$', text, re.MULTILINE))
        self.assertEqual({"record", "log-file", "port-file"}, set(shown))
        self.assertEqual(folders, {os.path.dirname(path) for path in shown.values()})
        for folder in folders:
            (self.folder / folder[1:]).mkdir(parents=True)
        options = self.folder / "xr3.toml"
        options.write_text(re.sub(r'^# ([\w-]+ = ")/', rf"\1{self.folder}/", text, flags=re.MULTILINE), encoding="utf-8")
        command = [str(options) if word == str(FOLDER / "xr3.toml") else word for word in self.command()]
        with Server(command=command):
            for path in shown.values():
                self.assertTrue((self.folder / path[1:]).exists(), path)

    def test_a_failure_restarts_the_server_and_invalid_options_do_not(self):
        self.assertEqual(("notify", "on-failure"), (self.value("Type"), self.value("Restart")))
        self.assertEqual("2", self.value("RestartPreventExitStatus"))
        invalid = subprocess.run([*self.command(), "--clock", "fast"], capture_output=True, text=True,
                                 timeout=DEADLINE_S, check=False)
        self.assertEqual(2, invalid.returncode, invalid.stderr)

    def test_enough_descriptors_for_every_connection(self):
        limit = int(self.value("LimitNOFILE"))
        self.assertGreaterEqual(limit, DESCRIPTORS)
        command = ["prlimit", f"--nofile={limit}:{limit}", *self.command()]
        with Server(command=command) as xr3:
            self.assertEqual((limit, limit), resource.prlimit(xr3.pid, resource.RLIMIT_NOFILE))
            self.assertNotIn("open files", xr3.log())

    def test_enough_threads(self):
        with Server(command=self.command()) as xr3:
            self.assertLess(xr3.status("Threads"), int(self.value("TasksMax")))

    def test_needs_no_capability(self):
        for name in "CapabilityBoundingSet", "AmbientCapabilities":
            self.assertEqual("", self.value(name))
        self.assertEqual("yes", self.value("DynamicUser"))

    def test_stops_in_time(self):
        """The signal of systemd is SIGTERM; Server.stop() fails if the server takes longer than two seconds."""
        self.assertGreater(int(self.value("TimeoutStopSec")), 2)
        with Server(command=self.command()) as xr3:
            self.assertEqual(0, xr3.stop(signal.SIGTERM))

    @NEEDS_ANALYZE
    def test_systemd_finds_no_error(self):
        unit = self.folder / UNIT.name
        unit.write_text(UNIT.read_text(encoding="utf-8").replace(PROGRAM, XR3), encoding="utf-8")
        done = analyze("verify", "--man=no", "--recursive-errors=no", unit)
        self.assertEqual((0, ""), (done.returncode, done.stderr))

    @NEEDS_ANALYZE
    def test_exposure_is_low(self):
        done = analyze("security", "--offline=true", "--no-pager", UNIT)
        overall = re.search(r"Overall exposure level for xr3\.service: ([\d.]+)", done.stdout)
        self.assertIsNotNone(overall, done.stdout + done.stderr)
        self.assertLess(float(overall[1]), MOST_EXPOSURE, done.stdout)

    @NEEDS_ANALYZE
    def test_unknown_settings_are_found(self):
        """systemd ignores what it does not know, so this shows that the check above sees it."""
        unit = self.folder / UNIT.name
        text = UNIT.read_text(encoding="utf-8").replace(PROGRAM, XR3).replace("ProtectClock=", "ProtectClocks=")
        unit.write_text(text, encoding="utf-8")
        self.assertIn("ProtectClocks", analyze("verify", "--man=no", "--recursive-errors=no", unit).stderr)


if __name__ == "__main__":
    unittest.main()
