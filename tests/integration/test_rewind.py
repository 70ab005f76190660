"""Rewind over real sockets: what a client sees of the past, and a robot that is taken back."""

import json
import pathlib
import tempfile
import time
import unittest

from support import DEADLINE_S, Line, MonitorError, Server, connect, counts, machine, run_xr3


def seen(state):
    """The members of a state that do not depend on when and by what request it was sent."""
    return {name: value for name, value in machine(state).items() if name != "past"}


def names(monitor):
    return {each["name"] for each in monitor.call("cells")["cells"]}


class Rewind(unittest.TestCase):
    def refused(self, monitor, fn, **args):
        with self.assertRaises(MonitorError) as refused:
            monitor.call(fn, **args)
        return refused.exception

    def look(self, monitor, **args):
        """The frames of a look by channel, and its value."""
        monitor.send({"op": "call", "id": "look", "fn": "look", "args": args})
        *frames, result = monitor.read_until(lambda message: message["op"] == "result")
        for each in frames:
            self.assertEqual(("look", True), (each["id"], each["past"]))
        self.assertTrue(result["ok"], result)
        return {each["op"]: each for each in frames}, result["value"]

    def at(self, monitor, cell, fn, **args):
        """A call on a cell that is not the first."""
        return monitor.request("call", cell=cell, fn=fn, args=args)["value"]

    # --- Looking.

    def test_look_shows_the_past_to_one_client(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.monitor() as other:
            line = xr3.line()
            line.send("E+60\r")
            monitor.step(200, after=line)
            then = monitor.get()
            monitor.step(5000)
            now = monitor.get()
            self.assertNotEqual(counts(then), counts(now))
            frames, value = self.look(monitor, tick=200, channels=["state", "image", "model", "display"])
            self.assertEqual({"epoch": 0, "tick": 200}, value)
            self.assertEqual({"state", "image", "model", "display"}, set(frames))
            self.assertEqual(seen(then), seen(frames["state"]))
            self.assertEqual(seen(now), seen(other.get()))
            self.assertEqual(0, monitor.get()["epoch"])

    def test_frames_of_the_present_come_again_after_live(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.monitor() as other:
            other.call("step", ticks=10)
            monitor.call("input", input=1, value=True)
            monitor.subscribe("state", max_hz=60)
            monitor.read_until(lambda message: message["op"] == "state")
            self.look(monitor, tick=10)
            monitor.subscribe("event")
            other.call("input", input=2, value=True)
            before = monitor.read_until(lambda message: message["op"] == "event")
            self.assertEqual(["event"], [each["op"] for each in before], "events go on, frames do not")
            monitor.call("live")
            state = monitor.read_until(lambda message: message["op"] == "state")[-1]
            self.assertNotIn("past", state)
            self.assertEqual([True, True], state["io"]["inputs"][:2])

    def test_times_that_are_not_kept_are_refused_with_what_is(self):
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertEqual("not_kept", self.refused(monitor, "look", tick=0).code)
            monitor.call("step", ticks=50)
            history = monitor.call("history")
            self.assertEqual([{"epoch": 0, "from": 0, "to": 50}], history["epochs"])
            self.assertFalse(history["past"])
            no = self.refused(monitor, "look", tick=51)
            self.assertEqual("not_kept", no.code)
            self.assertIn("epoch 0 from tick 0 to 50", no.hint)
            self.assertEqual("not_kept", self.refused(monitor, "seek", tick=0, epoch=7).code)

    def test_a_trace_of_the_past(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+60\r")
            monitor.step(300, after=line)
            monitor.call("step", ticks=20_000)
            value = monitor.call("trace", tick=0, every=50)
            states = value["states"]
            self.assertEqual((0, None), (value["epoch"], value["next"]))
            self.assertEqual([0, 50, 100], [state["tick"] for state in states[:3]])
            self.assertEqual(20_300, states[-1]["tick"])
            self.assertLess(len(states), 100)
            self.assertEqual({"tick", "joints", "tool"}, set(states[0]))
            frames, _ = self.look(monitor, tick=100)
            self.assertEqual(frames["state"]["joints"], states[2]["joints"])
            self.assertEqual("not_kept", self.refused(monitor, "trace", tick=30_000).code)

    def test_a_long_trace_takes_several_calls(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            for move in 5 * ("E+100\r", "E-100\r"):
                line.send(move)
                monitor.step(5000, after=line)
            ticks, tick = [], 0
            while tick is not None:
                value = monitor.call("trace", tick=tick, every=10)
                ticks += [state["tick"] for state in value["states"]]
                self.assertTrue(value["next"] is None or value["next"] > tick)
                tick = value["next"]
            self.assertEqual(sorted(set(ticks)), ticks)
            self.assertEqual((0, 50_000), (ticks[0], ticks[-1]))

    def test_without_history(self):
        with Server("--history", "0") as xr3, xr3.monitor() as monitor:
            monitor.call("step", ticks=50)
            for fn, args in (("history", {}), ("look", {"tick": 1}), ("trace", {"tick": 1}), ("seek", {"tick": 1}), ("branch", {"tick": 1})):
                self.assertEqual("no_history", self.refused(monitor, fn, **args).code, fn)

    # --- Going back.

    def test_seek_takes_the_robot_back_until_resume(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+60\r")
            monitor.step(200, after=line)
            then = monitor.get()
            monitor.step(5000)
            self.assertEqual({"epoch": 1, "tick": 200}, monitor.call("seek", tick=200))
            state = monitor.get()
            self.assertEqual({"mode": "manual", "rate": 1.0, "past": True}, state["clock"])
            self.assertEqual(then["joints"], state["joints"])
            self.assertEqual("in_the_past", self.refused(monitor, "step", ticks=5).code)
            self.assertEqual("in_the_past", self.refused(monitor, "send", text="E?").code)
            line.send("E?")  # not read yet
            self.assertEqual({"epoch": 2, "tick": 5200}, monitor.call("seek", tick=5200, epoch=0))
            self.assertEqual({"epoch": 3, "tick": 100}, monitor.call("seek", tick=100, epoch=0))
            history = monitor.call("history")
            self.assertTrue(history["past"])
            self.assertEqual([0, 3], [each["epoch"] for each in history["epochs"]])
            monitor.call("resume")
            self.assertNotIn("past", monitor.get()["clock"])
            self.assertGreater(line.read(1)[0], 32, "E still moves")
            spans = monitor.call("history")["epochs"]
            self.assertEqual({"epoch": 0, "from": 0, "to": 100}, spans[0])
            self.assertEqual((3, 100), (spans[1]["epoch"], spans[1]["from"]))
            self.assertEqual("seek", [each for each in monitor.recall("event") if each["event"] == "epoch"][-1]["code"])

    def test_the_server_looks_alive_while_a_cell_is_in_the_past(self):
        with Server() as xr3, xr3.monitor() as monitor:
            monitor.call("step", ticks=50)
            monitor.call("seek", tick=10)
            done = run_xr3("healthcheck", "--monitor-port", str(xr3.monitor_port))
            self.assertEqual(0, done.returncode, done.stderr)

    def test_a_recording_repeats_what_seek_did(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "session.xr3")
            with Server("--record", file) as xr3, xr3.monitor() as monitor:
                line = xr3.line()
                line.send("E+60\rC+9\r")
                monitor.step(200, after=line)
                monitor.call("block_move", name="red", xyz_mm=[200, 100, 20])
                monitor.step(5000)
                monitor.call("seek", tick=200)
                monitor.call("resume")
                monitor.call("pause")
                monitor.step(3000)
                last = monitor.get()
                line.close()
            done = run_xr3("replay", file, "--print", "state")
            self.assertEqual(0, done.returncode, done.stderr)
            self.assertEqual(last["joints"], json.loads(done.stdout)["joints"])

    # --- Branches.

    def test_a_branch_is_a_robot_of_its_own(self):
        with Server() as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.send("E+60\r")
            monitor.step(200, after=line)
            monitor.step(5000)
            branch = monitor.call("branch", tick=200)
            self.assertEqual("main-b1", branch["cell"])
            self.assertEqual({"main", "main-b1"}, names(monitor))
            with Line(connect(branch["robot_port"])) as program:
                program.send("C+9\r")
                program.ask("E?")
            self.at(monitor, "main-b1", "run_until", idle=True, max_ticks=10**5)
            self.assertEqual("E60 C9", counts(monitor.request("get", cell="main-b1", channel="state")))
            self.assertEqual("E60", counts(monitor.get()))
            self.assertEqual(5200, monitor.get()["tick"])

    def test_a_branch_goes_when_nobody_uses_it(self):
        with Server("--linger", "0.05") as xr3, xr3.monitor() as monitor:
            monitor.call("step", ticks=50)
            name = monitor.call("branch", tick=20)["cell"]
            deadline = time.monotonic() + DEADLINE_S
            while name in names(monitor):
                self.assertLess(time.monotonic(), deadline)

    def test_an_origin_has_at_most_four_branches(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor:
            monitor.call("step", ticks=50)
            made = [monitor.call("branch", tick=20)["cell"] for _ in range(3)]
            self.at(monitor, "1-b1", "step", ticks=50)
            made.append(self.at(monitor, "1-b1", "branch", tick=30)["cell"])
            self.assertEqual(["1-b1", "1-b2", "1-b3", "1-b4"], made)
            for cell in "1", "1-b1", "1-b4":
                with self.subTest(cell), self.assertRaises(MonitorError) as refused:
                    self.at(monitor, cell, "branch", tick=30)
                self.assertEqual("limit", refused.exception.code)
                self.assertEqual("cell 1 has 4 branches already", refused.exception.message)
            self.at(monitor, "2", "step", ticks=50)
            self.assertEqual("2-b1", self.at(monitor, "2", "branch", tick=20)["cell"])

    def test_with_private_a_student_has_at_most_four_branches_each_with_a_token(self):
        environment = {"XR3_TOKEN": "a token of the tests"}
        with tempfile.TemporaryDirectory() as folder, \
                Server("--cells", 2, "--private", "--port-file", f"{folder}/ports.json", environment=environment) as xr3:
            with open(f"{folder}/ports.json", encoding="ascii") as file:
                first, second = (cell["token"] for cell in json.load(file)["cells"])
            with xr3.monitor() as monitor:
                self.unlock(monitor, first)
                self.at(monitor, "1", "step", ticks=50)
                tokens = [self.at(monitor, "1", "branch", tick=20)["token"] for _ in range(4)]
                self.assertEqual(4, len(set(tokens)))
                self.assertEqual("cell 1 has 4 branches already", self.refused(monitor, "branch", tick=20).message)
                self.assertEqual({"1"}, names(monitor), "the branches need their tokens")
                self.unlock(monitor, tokens[0])
                self.assertEqual({"1", "1-b1"}, names(monitor))
            with xr3.monitor() as monitor:
                self.unlock(monitor, second)
                self.at(monitor, "2", "step", ticks=50)
                self.assertEqual("2-b1", self.at(monitor, "2", "branch", tick=20)["cell"])

    @staticmethod
    def unlock(monitor, token):
        monitor.request("auth", token=token)
        monitor.read()  # hello

    def test_branches_count_for_the_limit(self):
        with Server("--max-cells", "2") as xr3, xr3.monitor() as monitor:
            monitor.call("step", ticks=50)
            monitor.call("branch", tick=20)
            no = self.refused(monitor, "branch", tick=20)
            self.assertEqual("limit", no.code)
            self.assertIn("--max-cells", no.hint)


if __name__ == "__main__":
    unittest.main()
