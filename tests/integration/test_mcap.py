"""`xr3 convert RUN.xr3rec RUN.mcap`: Foxglove's own reader reads the file, whose messages are at their times and fit the
schemas of Foxglove."""
# labels: full

import base64
import json
import pathlib
import unittest

import fastjsonschema

from mcap_file import NS_PER_TICK, TOPICS, Converted, McapFile
from support import ROOT, run_xr3


class Recordings(Converted):
    def replayed_state(self, tick, epoch=0):
        done = run_xr3("replay", self.recording, "--until", f"{epoch}:{tick}", "--print", "state")
        self.assertEqual(0, done.returncode, done.stderr)
        return json.loads(done.stdout)

    def test_the_file_says_what_is_in_it(self):
        self.record(lambda xr3, monitor: monitor.step(1000))
        file = self.convert()
        self.assertEqual(TOPICS, {each["topic"]: each["schema"] for each in file.head["channels"]})
        self.assertEqual({("json", "jsonschema")},
                         {(each["messageEncoding"], each["schemaEncoding"]) for each in file.head["channels"]})
        self.assertEqual(["zstd"], file.head["compressions"])
        self.assertEqual(len(file.messages), file.head["messageCount"])
        self.assertRegex(file.head["library"], r"^xr3 \d+\.\d+\.\d+$")

    def test_messages_fit_both_schemas(self):
        def act(xr3, monitor):
            with xr3.line() as line:
                line.ask("E+20\rA+9\rX\rE?")
                monitor.step(500)
            monitor.call("block_add", name="new", size_mm=[20, 20, 20], xyz_mm=[300, 0, 10], color=4)
        self.record(act)
        file = self.convert()
        for channel in file.head["channels"]:
            messages = file.by_topic[channel["topic"]]
            self.assertTrue(messages, channel["topic"])
            for schema in json.loads(channel["text"]), channel.get("official"):
                fits = fastjsonschema.compile(schema) if schema else lambda data: data
                for _, data in messages:
                    fits(data)

    def test_messages_are_at_their_times(self):
        def act(xr3, monitor):
            monitor.step(1234)
            with xr3.line() as line:
                line.ask("F+60\rE-40\rE?")
                monitor.step(3000)
                line.ask("E?")
                monitor.step(50_000)
        self.record(act)
        file = self.convert()
        times = [each["logTime"] for each in file.messages]
        self.assertEqual(times, sorted(times))
        self.assertEqual(54_234 * NS_PER_TICK, file.head["messageEndTime"])
        moving = [data["tick"] for _, data in file.by_topic["/state"] if data["moving"]]
        self.assertEqual([1234, *range(1300, moving[-1] + 1, 100)], moving, "samples of a motion")
        ticks = file.ticks("/state")
        self.assertEqual([data["tick"] for _, data in file.by_topic["/state"]], ticks)
        self.assertEqual([0, 1234], ticks[:2])
        end = ticks[-2]
        self.assertLess(moving[-1], end)
        self.assertFalse(self.replayed_state(end)["moving"])
        self.assertTrue(self.replayed_state(end - 1)["moving"], "the end of a motion")
        for tick in 1234, 1500, 1700, end:
            state = self.replayed_state(tick)
            shown = file.at("/state", tick)
            self.assertEqual([(each["label"], each["value"], each["count"]) for each in state["joints"]],
                             [(label, shown["joints"][label]["value"], shown["joints"][label]["count"]) for label in "FEDCB"])
        said = [(tick, data["message"]) for tick, data in file.by_topic["/wire"]]
        self.assertIn((1234, "> F+60\\rE-40\\rE?  move F +60, counter 60; move E -40, counter -40; asks how far E has still to go"),
                      said)
        self.assertIn((1234, "< H  E: 40 counts to go"), said)
        self.assertEqual({"line 1"}, {data["name"] for _, data in file.by_topic["/wire"]})
        reached = [(tick, data["message"]) for tick, data in file.by_topic["/events"] if data["name"].startswith("reached")]
        self.assertEqual(2, len(reached), file.by_topic["/events"])
        self.assertEqual(end, reached[-1][0])

    def test_every(self):
        def act(xr3, monitor):
            with xr3.line() as line:
                line.ask("F+60\rE?")
            monitor.step(3000)
        self.record(act)
        self.assertLess({20, 40, 60, 80}, set(self.convert("--every", 20).ticks("/tf")) | {0})
        ticks = self.convert("--every", 1000, "--force").ticks("/tf")
        self.assertLessEqual(len(ticks), 4)

    def test_a_robot_at_rest_costs_nothing(self):
        def act(xr3, monitor):
            with xr3.line() as line:
                line.ask("F+9\rE?")
                monitor.call("step", ticks=10**9)
                line.ask("E?")
        self.record(act)
        file = self.convert("--every", 1)
        self.assertLess(len(file.messages), 1000)
        self.assertEqual(10**9 * NS_PER_TICK, file.head["messageEndTime"])

    def test_blocks_and_camera_at_rest(self):
        def act(xr3, monitor):
            monitor.step(500)
            monitor.call("block_add", name="new", size_mm=[30, 30, 20], xyz_mm=[300, 0, 10], color=4)
            monitor.step(500)
        self.record(act)
        file = self.convert()
        self.assertEqual([0, 500], file.ticks("/blocks"))
        self.assertEqual([0, 500], file.ticks("/camera"))
        first, second = (data for _, data in file.by_topic["/camera"])
        self.assertNotEqual(first["data"], second["data"])
        self.assertEqual(b"\x89PNG", base64.b64decode(second["data"], validate=True)[:4])
        self.assertEqual([0], file.ticks("/scene"))

    def test_epochs_follow_each_other(self):
        def act(xr3, monitor):
            with xr3.line() as line:
                line.ask("F+60\rE?")
                monitor.step(700)
                monitor.call("reset")
                line.ask("F+60\rE?")
                monitor.step(700)
        self.record(act)
        file = self.convert()
        by_epoch = {epoch: [(tick, data) for tick, data in file.by_topic["/state"] if data["epoch"] == epoch] for epoch in (0, 1)}
        self.assertFalse(by_epoch[0][-1][1]["moving"])
        self.assertEqual((701, 0), (by_epoch[1][0][0], by_epoch[1][0][1]["tick"]))
        self.assertEqual({701}, {tick - data["tick"] for tick, data in by_epoch[1]})
        self.assertIn(701, file.ticks("/tf"), "the robot is at its start")

    def test_a_byte_clock(self):
        def act(xr3, monitor):
            with xr3.line() as line:
                for _ in range(200):
                    line.ask("F+1\rF?")
        self.record(act, clock="bytes:10")
        file = self.convert()
        moving = [data["tick"] for _, data in file.by_topic["/state"] if data["moving"]]
        self.assertGreater(len(moving), 10)
        self.assertEqual(200, sum(data["message"].startswith("< ") for _, data in file.by_topic["/wire"]))

    def test_a_recording_that_was_cut_off(self):
        self.record(lambda xr3, monitor: monitor.step(1000))
        text = self.recording.read_bytes()
        self.recording.write_bytes(text[:-20])
        done = run_xr3("convert", self.recording, self.file)
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertIn("the recording was cut off: it has no last entry", done.stderr)
        self.assertTrue(McapFile(self.file).messages)

    def test_the_recording_of_the_documentation(self):
        self.recording = pathlib.Path(ROOT, "docs", "find-and-pick.xr3rec")
        file = self.convert()
        held = [data["holding"] for _, data in file.by_topic["/state"]]
        self.assertTrue(any(held))
        self.assertGreater(len(file.ticks("/camera")), 1)


if __name__ == "__main__":
    unittest.main()
