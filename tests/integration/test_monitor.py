"""The monitor port with JSON lines: `hello`, the state, time and calls, in the documented form."""

import time
import unittest

from monitor_schema import load
from support import Server, connect, counts, machine, motors

STATE = set(load("monitor-v1")["$defs"]["state"]["properties"]) - {"id", "device", "past"}  # the whole state
MOTOR = {"label", "count", "error", "value", "unit", "speed", "switch", "moving", "blocked"}
TOOL = MOTOR | {"opening_mm", "xyz_mm", "rotation", "configuration", "net_roll_deg", "holding"}


class Greeting(unittest.TestCase):
    def test_hello(self):
        with Server() as xr3, xr3.monitor() as monitor:
            hello = monitor.hello
        for member, value in {"op": "hello", "proto": 1, "cell": "main", "cells": ["main"], "epoch": 0,
                              "tick": 0, "tick_hz": 1000, "clock": {"mode": "manual", "rate": 1.0},
                              "compat": "paper", "access": "control"}.items():
            self.assertEqual(value, hello[member], member)
        self.assertRegex(hello["server"], r"^xr3 \d+\.\d+\.\d+$")
        self.assertEqual({"name": "Rhino XR-3", "joints": list("FEDCB"), "tool": "A"}, hello["robot"])
        self.assertIn("state", hello["channels"])
        self.assertLessEqual({"pause", "resume", "rate", "step", "run_until", "reset", "home"},
                             set(hello["calls"]))
        self.assertEqual((262144, 32), (hello["limits"]["message_bytes"], hello["limits"]["depth"]))

    def test_tls_is_closed(self):
        with Server() as xr3:
            for _ in range(2):
                with connect(xr3.monitor_port) as sock:
                    sock.sendall(bytes.fromhex("16030100c8010000c40303"))
                    self.assertIn(receive_all(sock), (b"",))
            xr3.wait_log("TLS")
            xr3.monitor().close()
        self.assertEqual(1, xr3.log().count("TLS"), "logged once")


def receive_all(sock):
    data = b""
    try:
        while part := sock.recv(65536):
            data += part
    except ConnectionResetError:
        pass
    return data


class State(unittest.TestCase):
    def test_all_members(self):
        with Server() as xr3, xr3.monitor() as monitor:
            state = monitor.get()
        self.assertEqual(STATE | {"id"}, set(state))
        self.assertEqual(["F", "E", "D", "C", "B"], [joint["label"] for joint in state["joints"]])
        for joint in state["joints"]:
            self.assertEqual(MOTOR, set(joint))
        self.assertEqual(TOOL, set(state["tool"]))
        self.assertEqual({"inputs": [False] * 8, "outputs": [False] * 8, "aux": [False] * 2}, state["io"])
        self.assertEqual((None, False, True), (state["stalled"], state["moving"], state["enabled"]))
        self.assertEqual({"I": 0, "J": 0}, state["switches"])
        self.assertEqual(["red", "green", "blue", "yellow", "magenta"],
                         [block["name"] for block in state["blocks"]])
        self.assertEqual({"name", "xyz_mm", "yaw_deg", "held"}, set(state["blocks"][0]))
        self.assertEqual({"name": "red", "xyz_mm": [262.0, 0.0, 20.0], "yaw_deg": 90.0, "held": False},
                         state["blocks"][0])
        self.assertEqual([0, 1, 0, 1, 0, 0, 0, 0, -1], state["tool"]["rotation"])

    def test_selected_members(self):
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertEqual({"op", "id", "cell", "epoch", "seq", "tick", "stalled", "moving"},
                             set(monitor.get("stalled", "moving")))
            self.assertEqual({"moving"}, set(monitor.step(1, fields=["moving"])))
            self.assertEqual(STATE - {"op", "cell", "epoch", "seq", "tick"}, set(monitor.step(1)))

    def test_commands_of_lines_change_the_state(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("LP3P8E-60\rD55S")
            state = monitor.step(500, after=line)
            self.assertEqual([True, False], state["io"]["aux"])
            self.assertEqual([False, False, True, False, False, False, False, True], state["io"]["outputs"])
            e, d = motors(state)["E"], motors(state)["D"]
            self.assertEqual((-55, -5, True, True), (e["count"], e["error"], e["switch"], e["moving"]))
            self.assertEqual(55, d["speed"])
            self.assertEqual(({"I": 4, "J": 0}, True), (state["switches"], state["moving"]))

    def test_switches_of_mark3_are_true_if_closed(self):
        """`switch` is true for closed in every profile; `switches` has the values of the line's replies."""
        with Server("--compat", "mark3") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("F+30\r")
            state = monitor.settle(after=line)
            self.assertEqual((True, False), tuple(motors(state)[label]["switch"] for label in "FE"))
            self.assertEqual({"I": 63 - 8, "J": 48}, state["switches"])
            self.assertEqual(state["switches"]["I"], line.ask("I") - 32)
            self.assertEqual("mark3", monitor.hello["compat"])


class LongAnswers(unittest.TestCase):
    """Another client changes what they show."""

    def test_of_a_large_workcell(self):
        with Server("--workcell", "rhino-hundred") as xr3, xr3.monitor() as monitor, xr3.monitor() as other:
            for turn in range(20):
                monitor.send({"op": "call", "id": turn, "fn": "step", "args": {"ticks": 1, "fields": ["blocks"]}})
                other.call("block_move", name="b00", yaw_deg=turn)
            values = [monitor.read(is_whole=False)["value"] for _ in range(20)]
            self.assertEqual([turn + 1 for turn in range(20)], [value["tick"] for value in values])
            yaws = [value["state"]["blocks"][0]["yaw_deg"] for value in values]
            self.assertEqual(sorted(yaws), yaws, "in the order of the requests")
            saved = monitor.call("snapshot_save", name="a")["hash"]
            self.assertEqual(saved, other.call("snapshot_load", name="a")["hash"])

    def test_of_many_lines(self):
        with Server("--max-lines", 80) as xr3, xr3.monitor() as monitor:
            for number in range(1, 81):
                self.assertEqual(32, xr3.line().ask("E?"), number)
            self.assertEqual([(number, 2, 1, "E?") for number in range(1, 81)],
                             [(line["line"], line["bytes_in"], line["bytes_out"], line["last"])
                              for line in monitor.call("lines")["lines"]])


class Time(unittest.TestCase):
    def test_step(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+5\r")
            self.assertEqual((0, 9, "E0"), self.tick_of(monitor, 9, line))
            value = monitor.call("step", ticks=1)
            self.assertEqual((0, 10, "E1"), (value["epoch"], value["tick"], "E1"))
            self.assertEqual("E1", counts(value["state"]))

    def tick_of(self, monitor, ticks, line):
        value = monitor.call("step", ticks=ticks, after={"line": line.number, "bytes_in": line.sent})
        return value["epoch"], value["tick"], counts(value["state"]) or "E0"

    def test_run_until(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+5\r")
            for arguments, reached, ran in [
                (dict(after={"line": 1, "bytes_in": 4}, tick=20, max_ticks=1000), True, 20),
                (dict(idle=True, max_ticks=10), False, 10),
                (dict(idle=True, max_ticks=60000), True, 16),  # ceil(5000 / 110) - 30
                (dict(idle=True, max_ticks=60000), True, 0),
                (dict(tick=100, max_ticks=10), False, 10),
                (dict(tick=100, max_ticks=10**6), True, 44),
                (dict(tick=50, max_ticks=10), True, 0),
            ]:
                with self.subTest(arguments):
                    value = monitor.call("run_until", **arguments)
                    self.assertEqual((reached, ran), (value["reached"], value["ran_ticks"]))
            self.assertEqual((0, 100, "E5"), (value["epoch"], value["tick"], counts(value["state"])))

    def test_pause_resume_and_rate(self):
        with Server(clock="real:1000") as xr3, xr3.monitor() as monitor:
            self.assertEqual({"mode": "real", "rate": 1000.0}, monitor.hello["clock"])
            paused_at = monitor.call("pause")["tick"]
            self.assertEqual(paused_at, monitor.get("clock")["tick"])
            self.assertEqual({"mode": "manual", "rate": 1000.0}, monitor.get()["clock"])
            self.assertEqual(paused_at + 5, monitor.call("step", ticks=5)["tick"])
            monitor.call("rate", factor=2.5)
            monitor.call("resume")
            self.assertEqual({"mode": "real", "rate": 2.5}, monitor.get()["clock"])
            while monitor.get("moving")["tick"] < paused_at + 20:
                pass

    def test_reset_starts_an_epoch_and_keeps_lines(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            before = machine(monitor.get())
            line.send("E+9\rLP2A#E17S D+5")
            monitor.step(30, after=line)
            value = monitor.call("reset")
            self.assertEqual((1, 0), (value["epoch"], value["tick"]))
            line.send("\r")  # the reset has discarded the incomplete D+5
            monitor.step(0, after=line)
            state = monitor.get()
            self.assertEqual((before, 1, 0), (machine(state), state["epoch"], state["tick"]))
            self.assertEqual(32, line.ask("E?"))

    def test_a_month_at_rest_takes_no_time(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+50\r")
            monitor.step(0, after=line)
            started = time.monotonic()
            monitor.step(10**12)
            self.assertLess(time.monotonic() - started, 0.5)
            self.assertEqual((10**12, "E50"), (monitor.get()["tick"], counts(monitor.get())))
            self.assertEqual(32, line.ask("E?"))


if __name__ == "__main__":
    unittest.main()
