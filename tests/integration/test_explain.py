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
DISABLED = ("E+5\r", "disabled", "A@")


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

    def test_disabled(self):
        self.type("A@")
        event = self.viewer.read()
        self.assertEqual(("enabled", "disabled", False), (event["event"], event["code"], event["enabled"]))
        self.type(DISABLED[0])
        event = self.viewer.read()
        self.assertEqual(("warning", "disabled"), (event["event"], event["code"]))
        self.assertRegex(event["message"], DISABLED[2])

    def test_a_run_of_one_code_is_one_warning(self):
        self.type("z" * 40)
        event = self.viewer.read()
        self.assertEqual(("unknown_byte", 40), (event["code"], event["count"]))

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

    def test_limits_and_stalls_are_reported(self):
        with self.xr3.monitor() as other:
            for _ in range(3):
                self.line.send("E-120\r")
                other.settle(after=self.line)
        stalled = [event for event in self.events() if event["event"] == "stalled"]
        self.assertEqual("protected_region", stalled[0]["code"])
        self.assertIn("A$", stalled[0]["message"])


class EveryByte(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())
        self.line = self.enterContext(self.xr3.line())

    def records(self, *pieces):
        """The records of these bytes; each piece is sent after the one before has been executed."""
        known = self.monitor.recall("line", since=0)
        for piece in pieces:
            self.line.send(piece)
            self.monitor.step(0, after=self.line)
        return self.monitor.recall("line", since=known[-1]["seq"] + 1 if known else 0)

    def test_a_move(self):
        record, = self.records("E+5\r")
        self.assertEqual((1, "in", 0, "452b350d", "E+5\\r"),
                         tuple(record[name] for name in ("line", "dir", "offset", "hex", "text")))
        parsed, = record["parsed"]
        self.assertEqual("move", parsed["code"])
        self.assertRegex(parsed["message"], r"E \+5")
        self.assertEqual(0, parsed["from"])
        self.assertIn(parsed["to"], (3, 4))

    def test_an_inquiry_and_its_reply(self):
        self.records("E+5\r")
        asked, replied = self.records("E?")
        self.assertEqual(("in", "E?"), (asked["dir"], asked["text"]))
        self.assertEqual(("out", "25", "%"), (replied["dir"], replied["hex"], replied["text"]))
        self.assertEqual((0, 0, 1), (replied["offset"], replied["parsed"][0]["from"], replied["parsed"][0]["to"]))
        self.assertRegex(replied["parsed"][0]["message"], "5 counts to go")

    def test_an_ignored_command(self):
        record, = self.records("E+200\r")
        self.assertEqual("number_out_of_range", record["parsed"][0]["code"])
        self.assertRegex(record["parsed"][0]["message"], r"-128\.\.\.127")

    def test_a_command_in_pieces(self):
        """The record of the piece that completes a command explains it, from the command's first byte on."""
        records = self.records("E", "+", "5", "\r", "z")
        self.assertEqual(["E", "+", "5", "\\r", "z"], [record["text"] for record in records])
        self.assertEqual([0, 1, 2, 3, 4], [record["offset"] for record in records])
        explained = [(parsed["code"], parsed["from"]) for record in records for parsed in record["parsed"]]
        self.assertIn(("move", 0), explained)
        self.assertIn(("unknown_byte", 4), explained)

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
    """Calls that do not advance time: lines, line_disconnect, send, input, describe."""

    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())

    def refused(self, code, fn, **arguments):
        with self.assertRaises(MonitorError) as caught:
            self.monitor.call(fn, **arguments)
        self.assertEqual(code, caught.exception.code)

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
        for arguments in {}, {"text": "a", "hex": "61"}, {"hex": "6"}, {"hex": "xy"}, {"text": 5}:
            self.refused("bad_args", "send", **arguments)

    def test_an_incomplete_command_stays_on_its_line(self):
        self.monitor.call("send", text="E+")
        self.monitor.call("send", text="7\r")
        self.assertEqual(7, motors(self.monitor.settle())["E"]["count"])

    def test_lines(self):
        line = self.xr3.line()
        line.send("E+5\rz")
        self.monitor.step(3, after=line)
        line.ask("E?")
        listed, = self.monitor.call("lines")["lines"]
        self.assertEqual((1, "tcp", 0, 7, 1, 1), tuple(listed[name] for name in (
            "line", "kind", "opened_tick", "bytes_in", "bytes_out", "warnings")))
        self.assertRegex(listed["peer"], r"^127\.0\.0\.1:\d+$")
        self.assertIn("E?", listed["last"])

    def test_line_disconnect(self):
        line = self.xr3.line()
        line.send("E+5\r")
        self.monitor.step(0, after=line)
        self.monitor.call("line_disconnect", line=1)
        self.assertEqual(b"", line.read_to_end())
        self.assertEqual([], self.monitor.call("lines")["lines"])
        closed = [event for event in self.monitor.recall("event", since=0) if event["event"] == "line_close"]
        self.assertEqual([("disconnected", 4)], [(event["code"], event["bytes_in"]) for event in closed])
        self.refused("no_such_line", "line_disconnect", line=1)

    def test_input(self):
        line = self.xr3.line()
        self.monitor.call("input", input=3, value=True)
        self.monitor.call("input", input=6, value=True)
        self.assertEqual((32 + 4, 32 + 8), (line.ask("K"), line.ask("J")))
        self.assertEqual([False, False, True, False, False, True, False, False], self.monitor.get("io")["io"]["inputs"])
        for arguments in {"input": 0, "value": True}, {"input": 9, "value": True}, {"input": 1, "value": 1}:
            self.refused("bad_args", "input", **arguments)

    def test_describe(self):
        description = self.monitor.call("describe")
        for fn in self.monitor.hello["calls"]:
            self.assertIn(fn, str(description))
            self.assertTrue(self.monitor.call("describe", fn=fn))
        with self.assertRaises(MonitorError):
            self.monitor.call("describe", fn="fly")

    def test_calls_listed_by_hello_exist(self):
        for fn in self.monitor.hello["calls"]:
            with self.subTest(fn), self.assertRaises(MonitorError) as caught:
                self.monitor.call(fn, surely="unknown")
            self.assertEqual("bad_args", caught.exception.code)


if __name__ == "__main__":
    unittest.main()
