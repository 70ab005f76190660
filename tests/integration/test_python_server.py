"""xr3.Server and xr3.judge() of the Python package: the start and the end of the program, and why it does not start."""

import json
import os
import pathlib
import select
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import unittest.mock

from support import DEADLINE_S, ROOT, XR3, run_xr3

CLIENT = pathlib.Path(ROOT, "clients", "python")
sys.path.insert(0, str(CLIENT))

import xr3  # noqa: E402
from xr3.program import program_file  # noqa: E402

TWO_SERVERS = """
import sys, xr3
servers = [xr3.Server(record=name, clock="bytes") for name in sys.argv[1:]]
for server in servers:
    with server.robot() as robot:
        robot.move("E", 20)
        robot.wait("E")
print(*[server._process.pid for server in servers], flush=True)
sys.stdin.read()
"""
GOALS = {"goals": [{"kind": "joint", "label": "E", "count": 20}, {"kind": "joint", "label": "F", "count": 3}]}
PROGRAM = "import xr3\nwith xr3.Robot() as robot:\n    robot.move('E', 20)\n    robot.wait('E')\nprint('hello')\n"


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        variables = {"XR3": XR3, "XR3_ROBOT": "none of the server's", "PYTHONPATH": str(CLIENT)}
        self.enterContext(unittest.mock.patch.dict(os.environ, variables))
        os.environ.pop("XR3_POLL_MS", None)
        program_file.__globals__["_check_version"].cache_clear()

    def script(self, text, name="xr3"):
        """A program of this text."""
        path = self.folder / name
        path.write_text("#!/bin/sh\n" + text, encoding="ascii")
        path.chmod(0o700)
        return path


def ended(pid):
    """Waits until the process has ended, or for the deadline; returns whether it has."""
    try:
        descriptor = os.pidfd_open(pid)
    except ProcessLookupError:
        return True
    try:
        return bool(select.select([descriptor], [], [], DEADLINE_S)[0])
    finally:
        os.close(descriptor)


class Start(Case):
    def test_robots_of_two_servers_are_apart(self):
        with xr3.Server(clock="bytes") as one, xr3.Server(clock="bytes", robot="adept-one", pty=True) as other:
            self.assertEqual(4, len({one.port, one.monitor_port, other.port, other.monitor_port}))
            with one.robot() as robot, other.monitor() as monitor:
                robot.move("E", 20)
                self.assertEqual(0, robot.wait("E"))
                self.assertEqual(0, monitor.counts()["E"])
            self.assertIsNone(one.pty)
            with xr3.Server(pty=[self.folder / "a b", self.folder / "c"]) as third:
                self.assertEqual(str(self.folder / "a b"), third.pty)
            self.assertTrue(os.path.exists(other.pty))
        self.assertFalse(os.path.lexists(other.pty))

    def test_a_robot_has_arm_and_camera_of_the_server(self):
        for path in sorted(pathlib.Path(ROOT, "data", "robots").glob("*.json")):
            with self.subTest(path), xr3.Server(robot=path, workcell="none") as server, server.robot() as robot:
                self.assertEqual(xr3.Arm.load(path), robot.arm)
        workcell = json.loads(pathlib.Path(ROOT, "data/workcells/rhino-xr3.json").read_text(encoding="utf-8"))
        workcell["camera"]["pixels"] = [60, 60]
        (self.folder / "small.json").write_text(json.dumps(workcell), encoding="ascii")
        with xr3.Server(workcell=self.folder / "small.json") as server, server.robot() as robot:
            self.assertEqual((60, 60), (robot.camera.columns, robot.camera.rows))
            self.assertTrue(robot.look().patches())

    def test_wires_are_decoded_and_equal_inquiries_folded(self):
        with xr3.Server(clock="bytes") as server:
            with server.robot() as robot:
                robot.move("E", 20)
                robot.wait("E")
                robot.stop("D")
            self.assertEqual(["5 ms line 1 E+20\\r move E +20, counter 20",
                              "28 ms line 1 E? 8 times asks how far E has still to go: E: 18 counts to go … E: 0 counts to go",
                              "195 ms line 1 DX stop D, counter 0"],
                             [" ".join(each.split()) for each in server.wires()])
            self.assertEqual(server.wires()[-1:], server.wires(1))

    def test_a_token_is_known_and_not_shown(self):
        with xr3.Server(token="auto", private=True) as server:
            with server.monitor() as monitor:
                self.assertEqual("control", monitor.hello["access"])
            self.assertEqual([], server.wires())
            self.assertNotIn("token", repr(server))
        self.refused(r"token=…", program=self.script(f'case $1 in serve) echo "/#token=secret"; exit 3;; esac; exec {XR3} "$@"'))

    def test_the_server_does_not_fill_its_pipes(self):
        with xr3.Server(log_level="trace", clock="bytes") as server, server.robot() as robot:
            for _ in range(1000):
                robot.send("z!" * 50)
                robot.ask("E?")

    def refused(self, pattern, **options):
        with self.assertRaisesRegex(xr3.ServerError, pattern) as caught:
            xr3.Server(**options)
        self.assertNotIn("secret", str(caught.exception))

    def test_says_why_it_does_not_start(self):
        self.refused("there is no robot named r2d2; use one of: adept-one", robot="r2d2")
        self.refused("no option --robt", robt="adept-one")
        self.refused("^/absent/xr3 cannot be started: No such file", program="/absent/xr3")
        self.refused("cannot be started: Permission denied", program=self.folder)
        self.refused("^/bin/true is not the program xr3: --version prints ", program="/bin/true")
        self.refused("has the version 0.0.1, and the Python package", program=self.script("echo xr3 0.0.1 of old"))
        self.refused("did not listen within 0.5 s\nbusy",
                     program=self.script(f'case $1 in serve) echo busy >&2; exec sleep 60;; esac; exec {XR3} "$@"', "slow"), timeout_s=0.5)

    def test_finds_the_program_beside_python_else_on_path(self):
        del os.environ["XR3"]
        python = self.folder / "python3"
        python.symlink_to(sys.executable)
        self.script(f'exec {XR3} "$@"')
        ask = "import xr3; print(xr3.Server(robot_port=0))"
        for where, command, path in [("beside", python, "/usr/bin:/bin"), ("PATH", sys.executable, f"{self.folder}:/usr/bin:/bin")]:
            with self.subTest(where):
                done = subprocess.run([command, "-c", ask], env={**os.environ, "PATH": path}, capture_output=True, text=True,
                                      timeout=DEADLINE_S, check=False)
                self.assertRegex(done.stdout, "^<xr3.Server at 127", done.stderr)
        os.environ["PATH"] = "/absent"
        self.refused("there is no program xr3: the variable XR3 is not set, and neither .* nor a folder of PATH has it")


class End(Case):
    def test_close_ends_it_in_order_and_again_does_nothing(self):
        server = xr3.Server(record=self.folder / "run.xr3rec")
        with server:
            pass
        server.close()
        self.assertEqual(0, server._process.returncode)
        self.assertEqual(0, run_xr3("replay", self.folder / "run.xr3rec").returncode)
        with self.assertRaises(ConnectionError):
            server.wires()

    def test_ends_with_a_process_that_is_killed(self):
        records = [self.folder / "a.xr3rec", self.folder / "b.xr3rec"]
        with subprocess.Popen([sys.executable, "-c", TWO_SERVERS, *records], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            pids = list(map(int, process.stdout.readline().split()))
            process.kill()
        self.assertEqual(2, len(pids))
        self.assertTrue(all(map(ended, pids)))
        for record in records:
            self.assertEqual(0, run_xr3("replay", record).returncode)

    def test_a_script_that_starts_it_is_no_obstacle(self):
        script = self.script(f'exec 3<&0; {XR3} "$@" <&3 & echo $! >{self.folder}/pid; wait')
        server = xr3.Server(program=script)
        server.close()
        self.assertTrue(ended(int((self.folder / "pid").read_text(encoding="ascii"))))

    def test_interruption_of_the_group_does_not_reach_it(self):
        with xr3.Server() as server:
            self.assertNotEqual(os.getpgrp(), os.getpgid(server._process.pid))

    def test_an_interrupted_start_leaves_nothing(self):
        script = self.script(f'case $1 in serve) echo $$ >{self.folder}/pid; kill -INT $PPID; exec cat;; esac; exec {XR3} "$@"')
        self.assertIs(threading.current_thread(), threading.main_thread())
        with self.assertRaises(KeyboardInterrupt):
            xr3.Server(program=script)
        self.assertTrue(ended(int((self.folder / "pid").read_text(encoding="ascii"))))


class Judge(Case):
    def setUp(self):
        super().setUp()
        self.goals, self.program = self.folder / "goals.json", self.folder / "program.py"
        self.goals.write_text(json.dumps(GOALS), encoding="ascii")
        self.program.write_text(PROGRAM, encoding="ascii")

    def test_the_verdict_has_what_exec_writes(self):
        verdict = xr3.judge(self.program, goals=self.goals)
        self.assertEqual((False, 5), (verdict.passed, verdict.code))
        (run,) = verdict.runs
        self.assertEqual(("finished", 1, 2, [True, False]),
                         (run["outcome"], run["points"], run["max_points"], [goal["met"] for goal in run["goals"]]))
        self.assertRegex(str(verdict), r"\Ahello\n✓ joint E at 20 counts.*\n✗ joint F at 3 counts")

    def test_a_verdict_is_also_of_a_program_that_fails(self):
        for code, outcome, program, options in [(0, "finished", [sys.executable, self.program], {}),
                                                (6, "failed", "/absent", {}), (6, "failed", "false", {}), (6, "failed", ["false"], {}),
                                                (7, "time_up", ["sleep", "60"], {"max_seconds": 0.5})]:
            with self.subTest(program):
                verdict = xr3.judge(program, clock="bytes:100", **options)
                self.assertEqual((code, code == 0), (verdict.code, verdict.passed), verdict)
                self.assertEqual(1, len(verdict.runs))

    def test_repeated_runs_and_files_of_ones_own(self):
        verdict = xr3.judge(self.program, repeat=2, json=self.folder / "verdict.json", record=self.folder / "run.xr3rec")
        self.assertEqual(2, len(verdict.runs))
        self.assertEqual(verdict.runs, list(map(json.loads, (self.folder / "verdict.json").read_text(encoding="utf-8").splitlines())))

    def test_without_a_verdict_it_says_why(self):
        for pattern, options in [("/absent: cannot be read", {"goals": "/absent"}), ("no option --gools", {"gools": "x"}),
                                 ("/absent/xr3 cannot be started", {"xr3_program": "/absent/xr3"})]:
            with self.subTest(pattern), self.assertRaisesRegex(xr3.ServerError, pattern):
                xr3.judge(self.program, **options)


if __name__ == "__main__":
    unittest.main()
