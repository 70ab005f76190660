"""Calls that change the workcell: single blocks or the entire workcell. Invalid workcells are rejected
with all findings and change nothing, and the workcell in a `model` message is a valid data file."""

import json
import pathlib
import tempfile
import unittest

from support import MonitorError, Server, machine, motors, run_xr3

SMALL = {"size_mm": [20, 20, 20], "yaw_deg": 0, "color": 4}


class Case(unittest.TestCase):
    OPTIONS = ()

    def setUp(self):
        self.xr3 = self.enterContext(Server(*self.OPTIONS))
        self.monitor = self.enterContext(self.xr3.monitor())

    def names(self):
        return [block["name"] for block in self.monitor.get("blocks")["blocks"]]

    def block(self, name):
        found, = (block for block in self.monitor.get("blocks")["blocks"] if block["name"] == name)
        return found

    def refused(self, code, fn, **arguments):
        """Checks that the call fails with this code and changes nothing; returns the error."""
        before = machine(self.monitor.get())
        with self.assertRaises(MonitorError) as caught:
            self.monitor.call(fn, **arguments)
        self.assertEqual(code, caught.exception.code, caught.exception)
        self.assertEqual(before, machine(self.monitor.get()))
        return caught.exception

    def hold(self, name):
        """Adds a block between the open jaws and closes them."""
        tool = self.monitor.get("tool")["tool"]
        self.monitor.call("block_add", name=name, **SMALL | {"xyz_mm": tool["xyz_mm"], "yaw_deg": tool["net_roll_deg"]})
        while not (state := self.monitor.settle())["tool"]["blocked"]:
            self.monitor.call("send", text="A+60\r")
        self.assertEqual(name, state["tool"]["holding"])


class Blocks(Case):
    def test_add_move_remove(self):
        self.monitor.call("block_add", name="small", xyz_mm=[400, 0, 10], **SMALL)
        self.assertEqual({"name": "small", "xyz_mm": [400.0, 0.0, 10.0], "yaw_deg": 0.0, "held": False},
                         self.block("small"))
        self.monitor.call("block_move", name="small", xyz_mm=[300, 10, 10])
        self.assertEqual(([300.0, 10.0, 10.0], 0.0), (self.block("small")["xyz_mm"], self.block("small")["yaw_deg"]))
        self.monitor.call("block_move", name="small", yaw_deg=45.5)
        self.assertEqual(([300.0, 10.0, 10.0], 45.5), (self.block("small")["xyz_mm"], self.block("small")["yaw_deg"]))
        self.monitor.call("block_remove", name="small")
        self.assertNotIn("small", self.names())

    def test_the_image_changes(self):
        before = self.monitor.look("image")["rows"]
        self.monitor.call("block_remove", name="red")
        after = self.monitor.look("image")["rows"]
        self.assertLess("".join(after).count("1"), "".join(before).count("1"))

    def test_each_call_sends_an_event(self):
        before = self.monitor.get("model_rev")["model_rev"]
        self.monitor.call("block_add", name="small", xyz_mm=[400, 0, 10], **SMALL)
        self.monitor.call("block_move", name="small", yaw_deg=1)
        self.monitor.call("block_remove", name="small")
        events = [event for event in self.monitor.recall("event", since=0) if event["event"] == "model"]
        self.assertEqual(["block_add", "block_move", "block_remove"], [event["code"] for event in events])
        revisions = [event["model_rev"] for event in events]
        self.assertEqual(sorted(set(revisions)), revisions)
        self.assertGreater(revisions[0], before)
        self.assertEqual(revisions[-1], self.monitor.get("model_rev")["model_rev"])

    def test_a_held_block_cannot_be_changed(self):
        self.hold("small")
        self.refused("block_held", "block_move", name="small", yaw_deg=1)
        self.refused("block_held", "block_remove", name="small")
        self.monitor.call("block_move", name="red", yaw_deg=1)
        self.monitor.call("send", text="AXA-60\r")
        self.assertIsNone(self.monitor.settle()["tool"]["holding"])
        self.monitor.call("block_remove", name="small")


class ReplacedWorkcell(Case):
    def workcell(self):
        return self.monitor.look("model")["workcell"]

    def test_replaces_the_workcell(self):
        workcell = self.workcell()
        workcell["blocks"] = [block | {"name": block["name"] + "2"} for block in workcell["blocks"][:2]]
        self.monitor.call("send", text="E+10\r")
        moved = motors(self.monitor.settle())
        self.monitor.call("workcell", workcell=workcell)
        self.assertEqual(["red2", "green2"], self.names())
        self.assertEqual(moved, motors(self.monitor.get()), "the robot stays where it is")
        self.assertEqual(workcell, self.workcell())

    def test_replacing_the_workcell_removes_a_held_block(self):
        self.hold("small")
        workcell = self.workcell()
        self.monitor.call("workcell", workcell=workcell | {"blocks": workcell["blocks"][:1]})
        self.assertEqual((["red"], None), (self.names(), self.monitor.get("tool")["tool"]["holding"]))

    def test_reset_keeps_a_replaced_workcell(self):
        workcell = self.workcell()
        workcell["blocks"] = workcell["blocks"][:2]
        self.monitor.call("workcell", workcell=workcell)
        self.monitor.call("block_move", name="red", xyz_mm=[400, 0, 20])
        self.monitor.call("send", text="E+10\r")
        self.monitor.call("reset")
        self.assertEqual((["red", "green"], [262.0, 0.0, 20.0]), (self.names(), self.block("red")["xyz_mm"]))


class WorkcellFile(Case):
    """Robot and workcell of a `model` message, written to files, pass `xr3 check` and start the same cell."""

    def check_files(self):
        model, state = self.monitor.look("model"), machine(self.monitor.get())
        with tempfile.TemporaryDirectory() as folder:
            paths = {}
            for kind in "robot", "workcell":
                paths[kind] = pathlib.Path(folder, f"{kind}.json")
                paths[kind].write_text(json.dumps(model[kind]), encoding="utf-8")
            done = run_xr3("check", paths["robot"], paths["workcell"], "--robot", paths["robot"])
            self.assertEqual(0, done.returncode, done.stdout + done.stderr)
            with Server("--robot", paths["robot"], "--workcell", paths["workcell"]) as again, again.monitor() as monitor:
                self.assertEqual(state["blocks"], monitor.get("blocks")["blocks"])
                loaded = monitor.look("model")
                self.assertEqual((model["robot"], model["workcell"]), (loaded["robot"], loaded["workcell"]))
                return state, machine(monitor.get())

    def test_shipped_workcell(self):
        before, after = self.check_files()
        self.assertEqual(before, after)

    def test_workcell_with_moved_blocks(self):
        self.monitor.call("block_move", name="red", xyz_mm=[261.125, -1.5, 20], yaw_deg=12.5)
        self.monitor.call("block_add", name="small", xyz_mm=[400, 0, 10], **SMALL)
        self.monitor.call("block_remove", name="green")
        before, after = self.check_files()
        self.assertEqual(before["tool"], after["tool"])


class WorkcellFileAdept(WorkcellFile):
    OPTIONS = ("--robot", "adept-one")

    def test_workcell_with_moved_blocks(self):
        self.monitor.call("block_move", name=self.names()[0], yaw_deg=12.5)
        self.check_files()


class WorkcellFileIntelledex(WorkcellFileAdept):
    OPTIONS = ("--robot", "intelledex-660")


if __name__ == "__main__":
    unittest.main()
