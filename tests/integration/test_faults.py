"""Faults on demand: for every kind, a correct client notices the fault, which is an event with its name; and two
runs with the same file and the same bytes have the same transcript."""

import json
import os
import pathlib
import tempfile
import unittest

from support import ROOT, Server, run_xr3

# --- Clients of the robot port. Each returns what it has seen there, and nothing else.

def talk(line, _):
    """Moves and asks, closes its sending side, and reads to the end."""
    line.send("E+5\rE?D+7\rD?C-3\rC?B+9\rB?F+1\rF?I")
    line.finish_sending()
    return line.read_to_end()


def ask_after_a_move(line, monitor):
    """Half a second after E+5, which takes 46 ms."""
    line.send("E+5\r")
    monitor.step(500, after=line)
    return line.ask("E?")


def ask_during_a_move(line, monitor):
    line.send("E+50\r")
    monitor.step(200, after=line)
    return line.ask("E?")


def find_the_switch(line, monitor):
    """The counts after which the microswitch of E closes; more than 60 is never."""
    for counts in range(1, 61):
        line.send("E-1\r")
        monitor.step(100, after=line)
        if line.ask("I") - 32 & 4:
            return counts
    return None


def watch_the_switch(line, monitor):
    """The readings of the switch in the 30 ms after it has closed."""
    line.send("E-40\r")
    monitor.step(364, after=line)
    seen = []
    for _ in range(30):
        seen.append(line.ask("EV"))
        monitor.step(1)
    return seen


def hold_a_block(line, monitor):
    """The counts that the jaws have to go after a block was lifted. They stay the same while it is held."""
    tip = monitor.get("tool")["tool"]["xyz_mm"]
    monitor.call("block_move", name="red", xyz_mm=tip, yaw_deg=90)
    line.send("A+60\r")
    monitor.step(2000, after=line)
    line.send("F+20\r")
    monitor.step(2000, after=line)
    return line.ask("A?")


def take_images(line, monitor):
    images = []
    for _ in range(2):
        line.send("A**")
        images.append(line.read(192 * 32))
        monitor.step(1)
    return images


def take_one_image(line, _):
    line.send("A**")
    return line.read(192 * 32)


def wait_for_a_reply(line, monitor):
    """The reply 10 ms after an inquiry, and all replies a second later."""
    monitor.step(1)
    line.send("E?")
    monitor.step(10, after=line)
    monitor.step(0)
    early = line.unread()
    monitor.step(1000)
    line.finish_sending()
    return early, line.read_to_end()


# The members of a fault of each kind, and the client that notices it.
CASES = {
    "byte_dropped": ({"after_bytes": 2}, talk),
    "byte_flipped": ({"after_bytes": 2, "bit": 1}, talk),
    "byte_doubled": ({"after_bytes": 5}, talk),
    "stray_byte": ({"byte": 88, "direction": "out", "from_tick": 0}, talk),
    "parity_error": ({"direction": "out", "after_bytes": 1}, talk),
    "wrong_baud": ({"line": 1, "from_tick": 0}, talk),
    "wrong_parity": ({"line": "any", "from_tick": 0}, talk),
    "reply_lost": ({"line": 1, "after_bytes": 2, "count": 1}, talk),
    "reply_delayed": ({"delay_ms": 200, "from_tick": 0}, wait_for_a_reply),
    "reply_batched": ({"period_ms": 500, "from_tick": 0}, wait_for_a_reply),
    "xoff_stall": ({"from_tick": 0, "ticks": 300}, wait_for_a_reply),
    "line_disconnected": ({"after_bytes": 9}, talk),
    "power_cycle": ({"at_tick": 100}, ask_during_a_move),
    "motor_stuck": ({"joint": "E", "at_tick": 20}, ask_after_a_move),
    "motor_slow": ({"joint": "E", "percent": 5, "from_tick": 0}, ask_after_a_move),
    "encoder_slip": ({"joint": "E", "probability": 0.2}, find_the_switch),
    "grip_slip": ({"from_tick": 0}, hold_a_block),
    "switch_stuck_open": ({"joint": "E", "at_tick": 5}, find_the_switch),
    "switch_stuck_closed": ({"joint": "E", "at_tick": 5}, find_the_switch),
    "switch_bouncing": ({"joint": "E", "from_tick": 0}, watch_the_switch),
    "camera_noise": ({"probability": 0.01}, take_images),
    "camera_dead_row": ({"row": 96, "from_tick": 0}, take_one_image),
    "camera_offset": ({"columns": 7, "from_tick": 0}, take_one_image),
}


class Faults(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, *faults, seed=7):
        path = self.folder / "faults.json"
        path.write_text(json.dumps({"seed": seed, "faults": faults}), encoding="utf-8")
        return path

    def observe(self, client, *options):
        """The bytes that the client receives on the robot port, and the events of faults, without line numbers."""
        with Server("--log-level", "warn", *options) as xr3, xr3.monitor() as monitor:
            seen = client(xr3.line(), monitor)
            monitor.step(0)
            return seen, [event for event in monitor.recall("event", since=0) if event["event"] == "fault"]

    def test_a_client_notices_every_kind(self):
        known = json.loads(pathlib.Path(ROOT, "data/schema/fault.schema.json").read_text(encoding="utf-8"))
        self.assertEqual(set(CASES), set(known["definitions"]["fault"]["properties"]["kind"]["enum"]))
        without = {}
        for kind, (members, client) in CASES.items():
            with self.subTest(kind):
                if client not in without:
                    without[client], events = self.observe(client)
                    self.assertEqual([], events)
                path = self.file({"name": "bad-day", "kind": kind, **members})
                seen, events = self.observe(client, "--fault", path)
                self.assertNotEqual(without[client], seen)
                self.assertTrue(events)
                self.assertEqual({("bad-day", kind)}, {(event["fault"], event["code"]) for event in events})
                self.assertEqual((seen, events), self.observe(client, "--fault", path))

    def test_what_is_seen_of_some(self):
        def seen(kind, **members):
            return self.observe(CASES[kind][1], "--fault", self.file({"name": "x", "kind": kind, **members}))[0]

        plain = self.observe(talk)[0]
        self.assertEqual(b"%'#)! ", plain)
        self.assertEqual(b"%'" + plain[3:], seen("reply_lost", line=1, after_bytes=2, count=1))
        self.assertEqual(b"X" + plain, seen("stray_byte", byte=88, direction="out", from_tick=0))
        self.assertEqual(b"%\0" + plain[2:], seen("parity_error", direction="out", after_bytes=1))
        self.assertEqual(b"%", seen("line_disconnected", after_bytes=9))
        self.assertEqual(b"%%" + plain[1:], seen("byte_doubled", after_bytes=5))
        self.assertEqual((b"", b" "), seen("xoff_stall", from_tick=0, ticks=300))
        self.assertEqual(None, seen("switch_stuck_open", joint="E", at_tick=5))
        self.assertEqual(1, seen("switch_stuck_closed", joint="E", at_tick=5))

    def test_another_seed_is_another_run(self):
        fault = {"name": "noise", "kind": "byte_flipped", "probability": 0.3}
        runs = [self.observe(talk, "--fault", self.file(fault, seed=seed)) for seed in (1, 2)]
        self.assertNotEqual(runs[0], runs[1])

    def test_a_line_that_is_not_named_has_no_fault(self):
        path = self.file({"name": "x", "kind": "wrong_baud", "line": 2, "from_tick": 0})
        with Server("--log-level", "warn", "--fault", path) as xr3:
            first, second = xr3.line(), xr3.line()
            self.assertEqual(32, first.ask("E?"))
            second.send("E?")
            self.assertEqual(32, first.ask("E?"))
            second.finish_sending()
            self.assertNotEqual(b" ", second.read_to_end())

    def test_the_monitor_has_no_faults(self):
        path = self.file({"name": "x", "kind": "reply_lost", "from_tick": 0})
        with Server("--log-level", "warn", "--fault", path) as xr3, xr3.monitor() as monitor:
            self.assertEqual(" ", monitor.call("send", text="E?")["text"])

    def test_a_line_is_cut_at_a_tick(self):
        path = self.file({"name": "x", "kind": "line_disconnected", "at_tick": 100})
        with Server("--log-level", "warn", "--fault", path) as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            self.assertEqual(32, line.ask("E?"))
            monitor.step(100)
            self.assertEqual(b"", line.read_to_end())
            closed = [event for event in monitor.recall("event", since=0) if event["event"] == "line_close"]
            self.assertEqual(["fault"], [event["code"] for event in closed])
            self.assertEqual(32, xr3.line().ask("E?"), "the next line is a good one")

    def test_a_fault_of_a_line_comes_in_real_time_without_any_input(self):
        path = self.file({"name": "x", "kind": "line_disconnected", "at_tick": 300})
        with Server("--log-level", "warn", "--fault", path, clock="real") as xr3:
            self.assertEqual(b"", xr3.line().read_to_end())

    def test_an_rfc_2217_client_is_told_of_a_parity_error(self):
        path = self.file({"name": "x", "kind": "parity_error", "direction": "out", "from_tick": 0})
        with Server("--log-level", "warn", "--fault", path) as xr3:
            line = xr3.line()
            line.send(b"\xff\xfb\x2c")
            self.assertEqual(b"\xff\xfd\x2c\xff\xfa\x2c\x6b\xb0\xff\xf0", line.read(10))
            line.send(b"E?")
            self.assertEqual(b"\xff\xfa\x2c\x6a\x04\xff\xf0\0", line.read(8))


class Calls(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server("--log-level", "warn"))
        self.monitor = self.enterContext(self.xr3.monitor())

    def set(self, name, kind, **members):
        return self.monitor.call("fault_set", fault={"name": name, "kind": kind, **members})

    def test_a_fault_is_set_listed_and_cleared(self):
        self.monitor.step(1000)
        listed = self.set("jam", "motor_stuck", joint="E", at_tick=0, ticks=2000)
        self.assertEqual([{"name": "jam", "kind": "motor_stuck", "joint": "E", "at_tick": 1000, "ticks": 2000,
                           "effects": 0, "active": True}], listed["faults"])
        line = self.xr3.line()
        line.send("E+5\r")
        self.monitor.step(500, after=line)
        self.assertEqual(37, line.ask("E?"))
        self.assertEqual([], self.monitor.call("fault_clear", name="jam")["faults"])
        self.monitor.step(500)
        self.assertEqual(32, line.ask("E?"))
        events = [event for event in self.monitor.recall("event", since=0) if event["event"] == "fault"]
        self.assertEqual(["set", "began", "cleared"], [event["phase"] for event in events])


class Files(unittest.TestCase):
    def test_a_reset_returns_to_the_faults_of_the_file(self):
        with Server("--log-level", "warn", "--fault", "worn-arm") as xr3, xr3.monitor() as monitor:
            initial = monitor.call("fault_list")["faults"]
            self.assertEqual(4, len(initial))
            monitor.call("fault_clear")
            monitor.call("reset")
            self.assertEqual(initial, monitor.call("fault_list")["faults"])

    def test_check_knows_fault_files(self):
        path = os.path.join(ROOT, "data", "faults", "worn-arm.json")
        done = run_xr3("check", path)
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        self.assertIn("4 faults, seed 1\n", done.stdout)
        self.assertIn("  slip: encoder_slip\n", done.stdout)

    def test_a_bad_file_ends_the_start_with_all_findings(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump({"faults": [{"name": "x", "kind": "motor_stuck", "joint": "H", "at_tick": 0},
                                  {"name": "x", "kind": "gremlin"}]}, file)
            file.flush()
            done = run_xr3("serve", "--robot-port", "0", "--monitor-port", "0", "--fault", file.name)
        self.assertEqual(2, done.returncode)
        self.assertIn("/faults/0/joint: found \"H\"; allowed: a joint of the robot", done.stderr)
        self.assertIn("/faults/1/kind: found \"gremlin\"", done.stderr)

    def test_a_device_is_no_place_for_faults(self):
        done = run_xr3("serve", "--fault", "worn-arm", "--serial", "/dev/null")
        self.assertEqual(2, done.returncode)
        self.assertIn("faults are for the simulation", done.stderr)

    def test_a_fault_file_is_not_converted(self):
        done = run_xr3("convert", os.path.join(ROOT, "data", "faults", "worn-arm.json"), "/tmp/none.txt")
        self.assertEqual(2, done.returncode)
        self.assertIn("only robots and workcells have two forms", done.stderr)


if __name__ == "__main__":
    unittest.main()
