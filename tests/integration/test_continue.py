"""A class that lasts a term: recordings by student and day, their retention, and robots that go on from the end of their
last recordings after a stop or a crash (--continue)."""

import contextlib
import json
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

from support import DEADLINE_S, XR3, MonitorError, Server, counts, machine, run_xr3
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
        served = Server(command=[XR3, "replay", newest(lesson.lessons, "bob"), "--serve"])
        served.options = served.options[:4]
        with served as xr3, xr3.monitor() as monitor:
            self.assertEqual({**moved["bob"], "cell": "main"}, state_of(monitor, "main"))
        with lesson.server() as xr3, xr3.monitor() as monitor:
            self.assertEqual(moved, {name: state_of(monitor, name) for name in lesson.names})

    def test_bytes_that_come_at_once_wait(self):
        """All connect when the server listens; the robot whose recording is longest holds up no other."""
        lesson = Class(self)
        with lesson.server(clock="real") as xr3, xr3.monitor() as monitor:
            ports = cell_ports(monitor)
            with line_to(ports["ada"]) as ada:
                for _ in range(4000):
                    ada.ask("E?")
            for name in ("bob", "eve"):
                with line_to(ports[name]) as line:
                    line.send("E+30\r")
                    while line.ask("E?") != 32:
                        pass
            monitor.request("call", cell="eve", fn="pause")
            self.wait_for_end(lesson)
            lesson.kill(xr3)
        with lesson.server(clock="real") as xr3, contextlib.ExitStack() as stack:
            monitor = stack.enter_context(xr3.monitor())
            page = threading.Thread(target=get, args=(xr3, "/state?cell=eve"))
            page.start()
            ports = cell_ports(monitor)  # needs no robot
            lines = [stack.enter_context(line_to(ports[name])) for name in lesson.names for _ in range(2)]
            for line in lines:
                line.send("E?")
            self.assertEqual(6 * b" ", b"".join(line.read(1) for line in lines))
            page.join()
            self.assertEqual("manual", monitor.look("state", cell="eve")["clock"]["mode"])
            self.assertEqual(["E30", "E30"], [counts(monitor.look("state", cell=name)) for name in ("bob", "eve")])
            self.assertEqual({name: False for name in lesson.names},
                             {cell["name"]: cell["coming_back"] for cell in monitor.call("cells")["cells"]})

    def wait_for_end(self, lesson):
        """Waits until the last inputs are in the files."""
        for name, last in (("ada", '"close":'), ("bob", '"close":'), ("eve", '"call":"pause"')):
            deadline = time.monotonic() + DEADLINE_S
            while last not in newest(lesson.lessons, name).read_text(encoding="ascii"):
                self.assertLess(time.monotonic(), deadline)

    def test_students_stay_alone(self):
        lesson = Class(self)
        token = lesson.folder / "token"
        token.write_text("the teacher's letters", encoding="utf-8")
        token.chmod(0o600)
        options = "--private", "--token-file", token
        with lesson.server(*options) as xr3, xr3.monitor() as monitor:
            monitor.request("auth", token="the teacher's letters")
            monitor.read()  # hello
            tokens = {cell["name"]: cell["token"] for cell in monitor.call("cells")["cells"]}
            lesson.kill(xr3)
        with lesson.server(*options) as xr3, xr3.monitor() as ada:
            ada.request("auth", token=tokens["ada"])
            ada.read()  # hello
            self.assertEqual("ada", ada.look("state", cell="ada")["cell"])
            for name in ("bob", "eve"):
                with self.assertRaises(MonitorError):
                    ada.look("state", cell=name)

    def test_a_recording_that_cannot_be_repeated(self):
        lesson = Class(self)
        with lesson.server() as xr3, xr3.monitor() as monitor:
            for name in lesson.names:
                monitor.request("call", cell=name, fn="send", args={"text": "E+9\r"})
                monitor.request("call", cell=name, fn="step", args={"ticks": 500})
        files = {name: newest(lesson.lessons, name) for name in lesson.names}
        ada = files["ada"].read_bytes()
        files["ada"].write_bytes(ada.replace(b"E+9", b"E+8"))
        files["bob"].write_bytes(b"")
        lesson.roster.write_text("name,robot\nada,\nbob,\neve,adept-one\n", encoding="utf-8")
        with lesson.server() as xr3, xr3.monitor() as monitor:
            for name, why in (("ada", "a line that was changed"), ("bob", "contains no whole line"), ("eve", "of another robot")):
                state = monitor.look("state", cell=name)
                self.assertEqual((0, 0, ""), (state["epoch"], state["tick"], counts(state)))
                event, = (each for each in monitor.recall("event", cell=name, since=0) if each["event"] == "recording")
                self.assertEqual(("not_continued", str(files[name])), (event["code"], event["file"]))
                self.assertIn(why, event["message"])
                xr3.wait_log(f"warning cell {name}: .*{why}")
        self.assertEqual(ada.replace(b"E+9", b"E+8"), files["ada"].read_bytes())
        self.assertNotEqual(files["bob"], newest(lesson.lessons, "bob"))

    def test_another_exercise_begins_anew(self):
        lesson = Class(self, ["ada"])
        for exercise, ticks in ("07-pick", 0), ("07-pick", 500), ("08-vision", 0):
            with self.subTest(exercise), lesson.server("--exercise", exercise) as xr3, xr3.monitor() as monitor:
                self.assertEqual(ticks, monitor.look("state", cell="ada")["tick"])
                if ticks == 0:
                    monitor.request("call", cell="ada", fn="block_remove", args={"name": "red"} if exercise == "07-pick" else {"name": "slab"})
                    monitor.request("call", cell="ada", fn="step", args={"ticks": 500})
                if exercise == "08-vision":
                    xr3.wait_log("began with another workcell or other faults")

    def test_the_byte_clock_goes_on(self):
        lesson = Class(self, ["ada"])
        with lesson.server(clock="bytes:7") as xr3, xr3.line() as line, xr3.monitor() as monitor:
            for _ in range(5):
                line.ask("E+3\rE?")
            before = machine(monitor.look("state", cell="ada")), monitor.get()["tick"]
            lesson.wait_until_written(monitor)
            lesson.kill(xr3)
        with lesson.server(clock="real") as xr3, xr3.monitor() as monitor:
            state = monitor.look("state", cell="ada")
            self.assertEqual("bytes", state["clock"]["mode"])
            self.assertGreaterEqual(state["tick"], before[1])  # the line has closed: the robot has run to rest
            with xr3.line() as line:
                line.ask("E?")
            self.assertGreater(monitor.look("state", cell="ada")["tick"], state["tick"])

    def test_old_recordings_are_deleted(self):
        lesson = Class(self, ["ada", "bob"])
        old = {}
        for name, age in (("ada", 40), ("gone", 40), ("young", 2)):
            folder = lesson.lessons / name
            folder.mkdir(parents=True)
            for file in ("2026-01-02T03-04-05Z.xr3rec", "notes.txt") if name == "young" else ("2026-01-02T03-04-05Z.xr3rec",):
                (folder / file).write_bytes(b"")
                os.utime(folder / file, (time.time() - age * DAY_S,) * 2)
            old[name] = folder / "2026-01-02T03-04-05Z.xr3rec"
        with lesson.server("--record-keep", 30) as xr3:
            xr3.wait_log("[12] recordings older than 30 days are deleted")
            self.assertFalse((lesson.lessons / "gone").exists())
            self.assertTrue(old["young"].exists())
        with lesson.server("--record-keep", 30) as xr3, xr3.monitor() as monitor:
            monitor.look("state", cell="ada")
        self.assertTrue((lesson.lessons / "young" / "notes.txt").exists())


@unittest.skipUnless(os.environ.get("XR3_MEASURE"), "a measurement: set XR3_MEASURE=1")
class Measurement(unittest.TestCase):
    def test_a_class_of_200(self):
        """Prints how long it takes until 200 robots with half an hour of polling each are back."""
        names = [f"student-{k:03}" for k in range(1, 201)]
        lesson = Class(self, names)
        one = Class(self, ["student-001"])
        with one.server(clock="real:100") as xr3, xr3.line() as line:
            begin = time.monotonic()
            while time.monotonic() - begin < 18:
                line.ask("E+20\rE?")
                line.ask("E-20\rE?")
                time.sleep(0.0002)
        made = newest(one.lessons, "student-001")
        for name in names:
            folder = lesson.lessons / name
            folder.mkdir(parents=True)
            os.link(made, folder / made.name)
        begin = time.monotonic()
        with lesson.server(clock="real") as xr3, xr3.monitor() as monitor:
            listening = time.monotonic() - begin
            with line_to(cell_ports(monitor)[names[-1]]) as line:
                line.ask("E?")
            print(f"200 robots with recordings of {made.stat().st_size >> 10} KiB: listening after {listening:.2f} s, first reply after "
                  f"{time.monotonic() - begin:.2f} s", flush=True)
            while any(cell["coming_back"] for cell in monitor.call("cells")["cells"]):
                time.sleep(1)
            print(f"all back after {time.monotonic() - begin:.1f} s")


if __name__ == "__main__":
    unittest.main()
