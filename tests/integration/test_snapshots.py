"""Snapshots: after loading one, the simulation continues exactly as it did after saving it, whatever happened
in between; by name or from the client's copy, in the same server or in another one."""

import json
import random
import unittest

from support import MonitorError, Server, machine

TICKS = 10_000
COMMANDS = ["E+7\r", "E-9\r", "D+20\r", "D-17\r", "F+3\r", "C-5\r", "B+9\r", "A-30\r", "A+30\r", "EX",
            "E60S", "F255S", "LM", "P3", "R3", "Q", "A$", "A#", "A!1,2,3!", "A%4", "A|", "A.9\r"]


def happen(monitor, seed, ticks=TICKS):
    """Random commands and calls during `ticks`; returns the observed states as JSON, in order."""
    chance = random.Random(seed)
    seen = []
    added = 0
    while ticks > 0:
        what = chance.random()
        if what < 0.5:
            monitor.call("send", text=chance.choice(COMMANDS))
        elif what < 0.55:
            monitor.call("input", input=chance.randint(1, 8), value=chance.random() < 0.5)
        elif what < 0.6:
            added += 1
            tip = monitor.get("tool")["tool"]["xyz_mm"]
            monitor.call("block_add", name=f"{seed}-{added}", size_mm=[20, 24, 30], xyz_mm=[tip[0], tip[1], tip[2]],
                         yaw_deg=chance.randint(-180, 180), color=added % 16)
        elif what < 0.65:
            block = chance.choice(monitor.get("blocks")["blocks"])
            if not block["held"]:
                monitor.call("block_move", name=block["name"], yaw_deg=chance.randint(-90, 90))
        else:
            passing = min(ticks, chance.randint(0, 200))
            state = monitor.step(passing)
            seen.append((monitor.get("moving")["tick"], machine(state)))
            ticks -= passing
    return [json.dumps(each) for each in seen]


class Snapshots(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server("--log-level", "warn"))
        self.monitor = self.enterContext(self.xr3.monitor())

    def refused(self, code, fn, monitor=None, **arguments):
        with self.assertRaises(MonitorError) as caught:
            (monitor or self.monitor).call(fn, **arguments)
        self.assertEqual(code, caught.exception.code)

    def without_revision(self, seen):
        """The states without model_rev, which counts changes since the start of the server, not since a
        snapshot."""
        return [json.dumps([tick, {name: value for name, value in state.items() if name != "model_rev"}])
                for tick, state in map(json.loads, seen)]

    def test_a_loaded_snapshot_continues_identically(self):
        happen(self.monitor, seed=1, ticks=2000)
        saved = self.monitor.call("snapshot_save", name="a")
        inline = self.monitor.call("snapshot_save", inline=True)
        self.assertEqual(saved["hash"], inline["hash"])
        first = self.without_revision(happen(self.monitor, seed=2))
        ended = self.monitor.call("snapshot_save", name="end")
        self.assertNotEqual(saved["hash"], ended["hash"])
        for epoch, source in enumerate([{"name": "a"}, {"snapshot": inline["snapshot"]}, {"name": "a"}], 1):
            happen(self.monitor, seed=epoch + 10, ticks=500)
            loaded = self.monitor.call("snapshot_load", **source)
            self.assertEqual((saved["hash"], saved["tick"], epoch), (loaded["hash"], loaded["tick"], loaded["epoch"]))
            self.assertEqual(first, self.without_revision(happen(self.monitor, seed=2)))
            self.assertEqual(ended["hash"], self.monitor.call("snapshot_save", name="again")["hash"])
        with Server("--log-level", "warn") as other, other.monitor() as monitor:
            monitor.call("snapshot_load", snapshot=inline["snapshot"])
            self.assertEqual(first, self.without_revision(happen(monitor, seed=2)))
            self.assertEqual(ended["hash"], monitor.call("snapshot_save", name="end")["hash"])

    def test_loading_keeps_lines_and_clock(self):
        with self.xr3.line() as line:
            line.send("E+5\rE+")
            self.monitor.step(5, after=line)
            self.monitor.call("snapshot_save", name="then")
            self.monitor.call("resume")
            self.monitor.call("snapshot_load", name="then")
            self.assertEqual("real", self.monitor.get("clock")["clock"]["mode"])
            self.assertEqual([1], [each["line"] for each in self.monitor.call("lines")["lines"]])

    def test_at_most_sixteen_snapshots(self):
        for number in range(16):
            self.monitor.call("snapshot_save", name=f"number {number}")
        self.refused("limit", "snapshot_save", name="one more")
        self.monitor.step(5)
        self.monitor.call("snapshot_save", name="number 3")
        self.assertEqual(5, self.monitor.call("snapshot_load", name="number 3")["tick"])
        self.assertEqual(0, self.monitor.call("snapshot_load", name="number 4")["tick"])
        self.monitor.call("snapshot_save", inline=True)

    def test_a_damaged_snapshot_is_refused(self):
        saved = self.monitor.call("snapshot_save", inline=True)["snapshot"]
        for path in self.leaves(saved):
            broken = json.loads(json.dumps(saved))
            place = broken
            for step in path[:-1]:
                place = place[step]
            place[path[-1]] = {"what": "is this"}
            with self.subTest(path), self.assertRaises(MonitorError) as caught:
                self.monitor.call("snapshot_load", snapshot=broken)
            self.assertIn(caught.exception.code, ("bad_args", "model_mismatch"))
        self.assertEqual(0, self.monitor.get("moving")["epoch"])

    def test_an_inline_snapshot_can_be_loaded(self):
        workcell = self.monitor.look("model")["workcell"]
        block = workcell["blocks"][0]
        workcell["blocks"] = [block | {"name": str(number)} for number in range(256)]
        self.monitor.call("workcell", workcell=workcell)
        self.monitor.call("snapshot_save", name="many")
        workcell["blocks"] = workcell["blocks"][:50]
        self.monitor.call("workcell", workcell=workcell)
        self.monitor.call("snapshot_load", snapshot=self.monitor.call("snapshot_save", inline=True)["snapshot"])
        self.monitor.call("snapshot_load", name="many")
        self.assertEqual(256, len(self.monitor.get("blocks")["blocks"]))

    def test_an_impossible_state_is_refused(self):
        saved = self.monitor.call("snapshot_save", inline=True)["snapshot"]
        saved["state"]["motors"][0]["switch_closed"] = True
        with self.assertRaises(MonitorError) as caught:
            self.monitor.call("snapshot_load", snapshot=saved)
        self.assertEqual("bad_args", caught.exception.code)
        self.assertEqual([("/state/motors/0/switch_closed", "false: at count 0 it is open")],
                         [(each["pointer"], each["allowed"]) for each in caught.exception.details])
        self.assertEqual(0, self.monitor.get("moving")["epoch"])

    def leaves(self, value, path=()):
        """The paths of all values; of each list, only of its first two elements."""
        if isinstance(value, dict):
            for name, each in value.items():
                yield from self.leaves(each, (*path, name))
        elif isinstance(value, list):
            for place, each in enumerate(value[:2]):
                yield from self.leaves(each, (*path, place))
        else:
            yield path

    def test_a_snapshot_of_another_robot_is_refused(self):
        saved = self.monitor.call("snapshot_save", inline=True)["snapshot"]
        for options in ("--robot", "adept-one"), ("--compat", "mark3"):
            with self.subTest(options), Server(*options) as other, other.monitor() as monitor:
                self.refused("model_mismatch", "snapshot_load", monitor=monitor, snapshot=saved)


if __name__ == "__main__":
    unittest.main()
