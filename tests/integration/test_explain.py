"""Explanations of bytes: the `line` channel explains every byte, and a `warning` event explains the bytes that
had no effect, in one message."""

import unittest

from support import MonitorError, Server, motors

# (input of a student, code of the warning, regular expression for its message)
MISTAKES = [
    ("E+200\r", "number_out_of_range", r"E\+200: .*-128\.\.\.127.*ignored"),
    ("E500S", "speed_out_of_range", r"1\.\.\.255.*ignored"),
    ("E+60S", "unknown_byte", "S sets a speed"),
    ("+5\r", "no_joint_selected", r"letter A\.\.\.H"),
    ("?", "no_joint_selected", r"letter A\.\.\.H"),
    ("E--5\r", "incomplete_command", "sign must be followed by digits"),
    ("z", "unknown_byte", "no command"),
    ("move 5\r", "no_joint_selected", r"letter A\.\.\.H"),
    ("G+5\r", "no_such_joint", "G"),
    ("A!1\r", "incomplete_command", "A!1,1,1!"),
    ("A!0,0,0!", "bad_view_vector", "not all 0"),
    ("A*999*", "bad_camera_argument", r"rows 0\.\.\.191"),
    ("A*3\r", "incomplete_command", "asterisk"),
    ("P9", "number_out_of_range", r"1\.\.\.8"),
    ("A%9", "number_out_of_range", r"0\.\.\.6"),
    ("E+100\rE+100\r", "counter_overflow", "E"),
]


class Warnings(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.viewer = self.enterContext(self.xr3.monitor())
        self.line = self.enterContext(self.xr3.line())
        self.type("")  # the line is open now
        self.viewer.subscribe("event")
        self.assertEqual("line_open", self.viewer.recall("event")[0]["event"])

    def type(self, data, line=None):
        line = line or self.line
        line.send(data)
        with self.xr3.monitor() as other:
            other.step(0, after=line)

    def test_each_mistake_gives_one_warning(self):
        for data, code, sentence in MISTAKES:
            with self.subTest(data), self.xr3.line() as line, self.xr3.monitor() as viewer:
                self.type("", line)
                viewer.subscribe("event")
                self.type(data, line)
                event = viewer.read()
                while event["event"] == "move":  # a part that was executed
                    event = viewer.read()
                self.assertEqual(("warning", code, line.number), (event["event"], event["code"], event["line"]))
                self.assertRegex(event["message"], sentence)
                wrong = bytes.fromhex(event["hex"])
                self.assertEqual(wrong, data.encode()[event["offset"]:event["offset"] + len(wrong)])

    def test_at_most_64_warnings_a_second_and_a_summary(self):
        for number in range(100):
            self.type("z+")  # two alternating codes, which are not combined into one warning
        events = self.events()
        self.assertEqual(64, len(events))
        with self.xr3.monitor() as other:
            other.step(1000)
        suppressed = self.viewer.read()  # at the end of the second, without another byte
        self.assertEqual("suppressed", suppressed["code"])
        counted = sum(event["count"] for event in [*events, suppressed])
        self.assertEqual(200, counted)

    def events(self):
        """The events that have arrived since the last call."""
        newest = self.viewer.recall("event")[-1]["seq"]
        return self.viewer.read_until(lambda message: message["seq"] == newest)


class EveryByte(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())
        self.line = self.enterContext(self.xr3.line())

    def test_no_byte_is_lost(self):
        data = b"E+5\rz\x00\xfe\\E?" + bytes(range(1, 60)) + b"A**"
        self.line.send(data)
        self.monitor.step(0, after=self.line)
        records = self.monitor.recall("line", since=0)
        for direction, count in ("in", self.line.sent), ("out", None):
            offset = 0
            data_of_records = b""
            for record in records:
                if record["dir"] == direction:
                    self.assertEqual(offset, record["offset"])
                    offset += record["bytes"]
                    data_of_records += bytes.fromhex(record["hex"])
            if count is not None:
                self.assertEqual(count, offset)
                self.assertEqual(data, data_of_records)

    def test_several_lines(self):
        other = self.enterContext(self.xr3.line())
        self.line.send("E+1\r")
        self.monitor.step(0, after=self.line)
        other.send("D?")
        self.monitor.step(0, after=other)
        self.assertEqual([(1, "in"), (2, "in"), (2, "out")],
                         [(record["line"], record["dir"]) for record in self.monitor.recall("line", since=0)])

    def test_records_of_send(self):
        """`send` uses a line like those of the robot port."""
        self.monitor.step(0, after=self.line)
        value = self.monitor.call("send", text="E?")
        self.assertEqual(("20", " "), (value["hex"], value["text"]))
        records = self.monitor.recall("line", since=0)
        self.assertEqual([(value["line"], "in", "E?"), (value["line"], "out", " ")],
                         [(record["line"], record["dir"], record["text"]) for record in records])
        opened = [event for event in self.monitor.recall("event", since=0) if event["event"] == "line_open"]
        self.assertEqual(["tcp", "monitor"], [event["kind"] for event in opened])


class Calls(unittest.TestCase):
    """Calls that do not advance time: lines, line_disconnect, send, input."""

    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())

    def test_send(self):
        self.monitor.call("send", text="E+5\r")
        self.monitor.call("send", hex="442b330d")
        state = self.monitor.settle()
        self.assertEqual((5, 3), tuple(motors(state)[label]["count"] for label in "ED"))
        first = self.monitor.call("send", text="E?")
        with self.xr3.monitor() as other:
            self.assertNotEqual(first["line"], other.call("send", text="E?")["line"], "a separate line")
            second = other.call("lines")["lines"]
            self.assertEqual(["monitor", "monitor"], [line["kind"] for line in second])

    def test_an_incomplete_command_stays_on_its_line(self):
        self.monitor.call("send", text="E+")
        self.monitor.call("send", text="7\r")
        self.assertEqual(7, motors(self.monitor.settle())["E"]["count"])

    def test_line_disconnect(self):
        line = self.xr3.line()
        line.send("E+5\r")
        self.monitor.step(0, after=line)
        self.monitor.call("line_disconnect", line=1)
        self.assertEqual(b"", line.read_to_end())
        self.assertEqual([], self.monitor.call("lines")["lines"])
        closed = [event for event in self.monitor.recall("event", since=0) if event["event"] == "line_close"]
        self.assertEqual([("disconnected", 4)], [(event["code"], event["bytes_in"]) for event in closed])
        with self.assertRaises(MonitorError) as caught:
            self.monitor.call("line_disconnect", line=1)
        self.assertEqual("no_such_line", caught.exception.code)

    def test_input(self):
        line = self.xr3.line()
        self.monitor.call("input", input=3, value=True)
        self.monitor.call("input", input=6, value=True)
        self.assertEqual((32 + 4, 32 + 2), (line.ask("K"), line.ask("J")))
        self.assertEqual([False, False, True, False, False, True, False, False], self.monitor.get("io")["io"]["inputs"])


if __name__ == "__main__":
    unittest.main()
