"""A class that lasts a term: recordings by student and day, their retention, and robots that go on from the end of their
last recordings after a stop or a crash (--continue)."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

from support import DEADLINE_S, XR3, LOCALHOST, MonitorError, Server, counts, machine, run_xr3
from test_cells import cell_ports, get, line_to
from test_line_websocket import LineWebsocket

DAY_S = 86400
NAMES = "ada", "bob", "eve"


def newest(folder, name):
    return max(pathlib.Path(folder, name).iterdir(), key=lambda path: (path.name[:20], len(path.name), path.name))


class Class:
    """A server of this class, and the same again later."""

    def __init__(self, test, names=NAMES):
        home = tempfile.TemporaryDirectory()
        test.addCleanup(home.cleanup)
        self.test = test
        self.names = names
        self.folder = pathlib.Path(home.name)
        self.lessons = self.folder / "lessons"
        self.roster = self.folder / "class.csv"
        self.roster.write_text("name\n" + "".join(f"{name}\n" for name in names), encoding="utf-8")

    def server(self, *options, **others):
        return Server("--roster", self.roster, "--record", self.lessons, "--continue", *options, **others)

    def wait_until_written(self, monitor):
        """Waits until each recording repeats to the state of its robot: a tenth of a second."""
        for name in self.names:
            state = monitor.look("state", cell=name)
            deadline = time.monotonic() + DEADLINE_S
            while True:
                done = run_xr3("replay", newest(self.lessons, name), "--print", "state")
                if done.returncode == 0 and without_numbers(json.loads(done.stdout)) == without_numbers(state):
                    break
                self.test.assertLess(time.monotonic(), deadline, f"{name}: {done.stdout}{done.stderr}")

    def kill(self, xr3):
        xr3.process.send_signal(signal.SIGKILL)
        xr3.process.wait()


def without_numbers(state):
    return {key: value for key, value in state.items() if key not in ("seq", "id")}


def state_of(monitor, name):
    state = monitor.look("state", cell=name)
    return {key: value for key, value in state.items() if key not in ("seq", "id")}


class Continue(unittest.TestCase):
    def test_a_crash_in_the_middle_of_a_lesson(self):
        lesson = Class(self)
        with lesson.server() as xr3, xr3.monitor() as monitor:
            ports = cell_ports(monitor)
            with line_to(ports["ada"]) as ada, line_to(ports["ada"]) as second, \
                    LineWebsocket(xr3, "/line?cell=bob") as bob:
                ada.ask("E?")
                ada.send("E+40\rC-5\r")
                self.assertEqual(32 + 40, ada.ask("E?"))
                second.ask("A?")
                bob.send(b"F+20\rF?")
                bob.read(1)
                monitor.request("call", cell="bob", fn="send", args={"text": "D+3\r"})
                monitor.request("call", cell="bob", fn="block_remove", args={"name": monitor.look("state", cell="bob")["blocks"][0]["name"]})
                monitor.request("call", cell="bob", fn="snapshot_save", args={"name": "mine"})
                monitor.request("call", cell="bob", fn="fault_set", args={"fault": {"name": "jam", "kind": "motor_stuck", "joint": "D", "at_tick": 9000}})
                monitor.request("call", cell="eve", fn="reset")
                for name in lesson.names:
                    monitor.request("call", cell=name, fn="step", args={"ticks": 150})
                lesson.wait_until_written(monitor)
                before = {name: state_of(monitor, name) for name in lesson.names}
                lesson.kill(xr3)
        self.assertEqual([0, 0, 1], [before[name]["epoch"] for name in lesson.names])
        self.assertNotEqual(before["eve"]["joints"], before["ada"]["joints"])
        with lesson.server() as xr3:
            ports = None
            with xr3.monitor() as monitor:
                ports = cell_ports(monitor)
                with line_to(ports["ada"]) as ada:
                    left = ada.ask("E?")
                self.assertGreater(left, 32)
                for name in lesson.names:
                    self.assertEqual(before[name], state_of(monitor, name), name)
                monitor.request("call", cell="bob", fn="snapshot_load", args={"name": "mine"})
                continued = [each for each in monitor.recall("event", cell="ada", since=0) if each["code"] == "continued"]
                self.assertEqual(1, len(continued))
                for name in lesson.names:
                    monitor.request("call", cell=name, fn="step", args={"ticks": 5000})
                lesson.wait_until_written(monitor)
                moved = {name: state_of(monitor, name) for name in lesson.names}
                lesson.kill(xr3)
        for name in lesson.names:  # each recording repeats alone
            for file in (lesson.lessons / name).iterdir():
                done = run_xr3("replay", file)
                self.assertEqual(0, done.returncode, done.stderr)
        with lesson.server() as xr3, xr3.monitor() as monitor:
            self.assertEqual(moved, {name: state_of(monitor, name) for name in lesson.names})


if __name__ == "__main__":
    unittest.main()
