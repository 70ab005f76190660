"""A lesson with several robots: freezing them, notices, the goals of an exercise while programs work on it, and what the
overview shows of a program that needs help."""

import time
import unittest

from support import DEADLINE_S, Line, MonitorError, Server, connect

TOKEN = "sixteen letters!"


def cells_of(monitor):
    return {cell["name"]: cell for cell in monitor.call("cells")["cells"]}


class At:
    """Calls of a monitor client on one cell."""

    def __init__(self, monitor, cell):
        self.monitor, self.cell = monitor, cell

    def call(self, fn, **arguments):
        return self.monitor.request("call", cell=self.cell, fn=fn, args=arguments)["value"]


def line_of(monitor, cell):
    return Line(connect(cells_of(monitor)[cell]["robot_port"]), 1)


class Freeze(unittest.TestCase):
    def test_a_reply_leaves_late_and_unchanged(self):
        for clock in "real", "bytes":
            with self.subTest(clock), Server("--cells", 2, clock=clock) as xr3, xr3.monitor() as monitor:
                one = At(monitor, "1")
                with line_of(monitor, "1") as frozen, line_of(monitor, "2") as free:
                    one.call("freeze")
                    start = time.monotonic()
                    frozen.send("E+50\rE?E?")
                    self.assertEqual(32, free.ask("E?"), "the other robot goes on")
                    self.assertLess(time.monotonic() - start, 3)
                    self.assertEqual(b"RR", frozen.read(2))
                    self.assertGreater(time.monotonic() - start, 3.9)
                    self.assertTrue(one.monitor.request("get", cell="1", channel="state")["clock"]["frozen"])

    def test_replies_that_wait_leave_when_time_passes_again(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor, line_of(monitor, "1") as line:
            one = At(monitor, "1")
            one.call("freeze")
            line.send("E?")
            self.assertTrue(cells_of(monitor)["1"]["frozen"])
            for call in "resume", "step":
                with self.assertRaises(MonitorError) as caught:
                    one.call(call, **({"ticks": 1} if call == "step" else {}))
                self.assertEqual("frozen", caught.exception.code)
            start = time.monotonic()
            one.call("unfreeze")
            self.assertEqual(b" ", line.read(1))
            self.assertLess(time.monotonic() - start, 3)
            self.assertFalse(cells_of(monitor)["1"]["frozen"])

    def test_needs_the_servers_token(self):
        with Server("--cells", 2, "--private", environment={"XR3_TOKEN": TOKEN}) as xr3, \
                xr3.monitor() as teacher, xr3.monitor() as student:
            teacher.request("auth", token=TOKEN)
            teacher.read()
            token = cells_of(teacher)["1"]["token"]
            student.request("auth", token=token)
            student.read()
            for fn, arguments in ("freeze", {}), ("unfreeze", {}), ("notice", {"text": "hello"}):
                with self.assertRaises(MonitorError) as caught:
                    At(student, "1").call(fn, **arguments)
                self.assertEqual("not_yours", caught.exception.code)
                At(teacher, "1").call(fn, **arguments)


class Notice(unittest.TestCase):
    def test_is_an_event_of_the_robot(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor, xr3.monitor() as page:
            page.request("sub", cell="1", channel="event")
            page._subscribed = True
            At(monitor, "2").call("notice", text="for the other one")
            At(monitor, "1").call("notice", text="Save your work")
            event = page.read_until(lambda message: message["op"] == "event")[-1]
            self.assertEqual(("1", "notice", "Save your work"), (event["cell"], event["code"], event["message"]))
            with self.assertRaises(MonitorError):
                At(monitor, "1").call("notice", text="")


class Help(unittest.TestCase):
    def test_the_goals_tick_while_a_program_works(self):
        with Server("--cells", 2, "--exercise", "01-hello", clock="real:1000") as xr3, xr3.monitor() as monitor:
            exercise = monitor.call("cells")["exercise"]
            self.assertEqual("Say hello", exercise["title"])
            before = cells_of(monitor)["1"]
            self.assertEqual([False] * len(exercise["goals"]), before["goals"])
            self.assertEqual(0, before["points"][0])
            with line_of(monitor, "1") as line:
                for move in "E+50\r", "E+90\r":
                    line.send(move)
                    while line.ask("E?") != 32:
                        pass
            deadline = time.monotonic() + DEADLINE_S
            while not all(cells_of(monitor)["1"]["goals"]):
                self.assertLess(time.monotonic(), deadline, cells_of(monitor)["1"])
            self.assertEqual(*cells_of(monitor)["1"]["points"])
            self.assertEqual(before["goals"], cells_of(monitor)["2"]["goals"])
            At(monitor, "1").call("reset")
            self.assertEqual(before["goals"], cells_of(monitor)["1"]["goals"], "a reset begins anew")

    def test_the_overview_shows_the_last_command_and_warning(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor, line_of(monitor, "1") as line:
            for _ in range(3):
                line.ask("E?")
            cell = cells_of(monitor)["1"]
            self.assertEqual({"text": "E?", "count": 3, "has_reply": True}, cell["last_command"])
            self.assertAlmostEqual(time.time() * 1000, cell["last_input_at"], delta=60_000)
            self.assertIsNone(cell["last_warning"])
            line.send("%%")
            line.ask("E?")
            warning = cells_of(monitor)["1"]["last_warning"]
            self.assertEqual(2, warning["count"])
            self.assertIsNone(cells_of(monitor)["2"]["last_command"])

    def test_viewers_are_counted(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor, xr3.monitor() as watcher:
            watcher.subscribe("overview")
            with xr3.monitor() as page:
                page.request("sub", cell="1", channel="event")
                self.assertEqual(1, cells_of(monitor)["1"]["viewers"])
                page.request("unsub", cell="1", channel="event")
                self.assertEqual(0, cells_of(monitor)["1"]["viewers"])


if __name__ == "__main__":
    unittest.main()
