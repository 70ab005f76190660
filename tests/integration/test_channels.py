"""The channels of the monitor port: the messages of a subscription, their timing, and that all subscribers
receive the same messages."""

import json
import pathlib
import time
import unittest
import urllib.request

from support import LOCALHOST, ROOT, MonitorError, Server, counts, machine

LATEST = ["state", "image", "display", "model"]
RINGS = ["event", "line"]
ALWAYS = {"op", "cell", "epoch", "seq", "tick"}
SOME_FIELDS = {"state": ["stalled", "moving"], "image": ["height", "rows"], "display": ["on"], "model": ["rev", "hash"],
               "event": ["message"], "line": ["hex", "line"]}
# At a quarter of real time this move takes two seconds, with more than one count per frame.
SLOW_MOVE = "E255SE+127\r"


def get_json(xr3, path):
    with urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}{path}") as answer:
        return json.load(answer)


def rest(monitor):
    """All messages that the server had queued: those before the answers to two pings, because an answer
    may overtake queued messages, but a second one cannot overtake the same messages."""
    messages = []
    for _ in range(2):
        monitor.send({"op": "ping", "id": "rest"})
        messages += monitor.read_until(lambda message: message == {"op": "pong", "id": "rest"})[:-1]
    return messages


def expanded(row):
    """Converts run lengths, of which the first counts zeros, to a string of pixels."""
    return "".join("01"[place % 2] * length for place, length in enumerate(row))


class Subscriptions(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())
        self.line = self.enterContext(self.xr3.line())

    def act(self, data, ticks=1000):
        self.line.send(data)
        self.monitor.step(ticks, after=self.line)

    def test_the_first_message_is_complete_and_immediate(self):
        for channel in LATEST:
            with self.xr3.monitor() as viewer:
                held = viewer.subscribe(channel)
                self.assertEqual(("main", channel), (held["cell"], held["channel"]))
                first = viewer.read()
                shown = self.monitor.look(channel)
                del shown["id"]
                self.assertEqual(shown, first)

    def test_sub_returns_its_settings(self):
        with self.xr3.monitor() as viewer:
            held = viewer.subscribe("state", max_hz=12.5, on_change=False, fields=["io", "moving"])
            self.assertEqual((12.5, False, ["io", "moving"]), (held["max_hz"], held["on_change"], held["fields"]))
            held = viewer.subscribe("state")
            self.assertEqual((30, True), (held["max_hz"], held["on_change"]))
            self.assertEqual("rle", viewer.subscribe("image", encoding="rle")["encoding"])

    def test_a_second_subscription_replaces_the_first(self):
        with self.xr3.monitor() as viewer:
            viewer.subscribe("state", fields=["io"])
            viewer.subscribe("state", fields=["enabled"])
            self.act("A@")
            messages = viewer.read_until(lambda message: message.get("enabled") is False)
            self.act("A@P3")
            messages += viewer.read_until(lambda message: message.get("enabled") is True)
            self.assertEqual([ALWAYS | {"io"}] + [ALWAYS | {"enabled"}] * 3, [set(each) for each in messages])

    def test_unsub(self):
        with self.xr3.monitor() as viewer, self.xr3.monitor() as witness:
            for channel in LATEST + RINGS:
                viewer.subscribe(channel)
                viewer.unsubscribe(channel)
            rest(viewer)
            witness.subscribe("state", max_hz=60)
            self.monitor.call("block_move", name="red", xyz_mm=[400, 0, 20])
            self.act("E+5\rLA#")
            witness.read_until(lambda message: counts(message) == "E5")
            self.assertEqual([], rest(viewer))

    def test_unsub_without_a_subscription(self):
        self.assertEqual({}, self.monitor.unsubscribe("image"))

    def test_fields(self):
        self.act("E+5\r")
        for channel, fields in SOME_FIELDS.items():
            with self.subTest(channel), self.xr3.monitor() as viewer:
                if channel in LATEST:
                    self.assertEqual(ALWAYS | {"id", *fields}, set(viewer.look(channel, fields=fields)))
                    viewer.subscribe(channel, fields=fields)
                    self.assertEqual(ALWAYS | set(fields), set(viewer.read()))
                else:
                    for message in viewer.recall(channel, fields=fields):
                        self.assertEqual(ALWAYS | set(fields), set(message) - {"id"})
                    viewer.subscribe(channel, fields=fields, since=0)
                    self.assertEqual(ALWAYS | set(fields), set(viewer.read()))
                with self.assertRaises(MonitorError) as caught:
                    viewer.subscribe(channel, fields=["taste"])
                self.assertEqual("bad_args", caught.exception.code)

    def test_since(self):
        for _ in range(5):
            self.act("E+1\r")
        for channel in RINGS:
            with self.subTest(channel), self.xr3.monitor() as viewer:
                received = viewer.recall(channel)
                self.assertGreaterEqual(len(received), 5)
                numbers = [message["seq"] for message in received]
                self.assertEqual(list(range(numbers[0], numbers[0] + len(received))), numbers)
                self.assertEqual(numbers[2:], [message["seq"] for message in viewer.recall(channel, since=numbers[2])])
                viewer.subscribe(channel, since=numbers[1])
                self.assertEqual(numbers[1:], [viewer.read()["seq"] for _ in numbers[1:]])
                viewer.subscribe(channel)
                self.assertEqual([], rest(viewer), "from now on")
                self.act("E-1\r")
                self.assertEqual(numbers[-1] + 1, viewer.read()["seq"])
                viewer.subscribe(channel, since=numbers[-1] + 1000)
                self.assertEqual([], [message for message in rest(viewer) if message["seq"] <= numbers[-1]])

    def test_get_returns_the_last_256_messages(self):
        self.line.send("E+1\rE-1\r" * 300)
        self.monitor.step(0, after=self.line)
        received = self.monitor.recall("event")
        self.assertEqual((256, "E -1: counter 0"), (len(received), received[-1]["message"]))
        self.assertGreater(len(self.monitor.recall("event", since=0)), 600)

    def test_images(self):
        with self.xr3.monitor() as rows, self.xr3.monitor() as runs:
            rows.subscribe("image", max_hz=60)
            runs.subscribe("image", max_hz=60, encoding="rle")
            for y_mm in None, 40, 80:
                if y_mm:
                    self.monitor.call("block_move", name="red", xyz_mm=[262, y_mm, 20])
                by_rows, by_runs = rows.read(), runs.read()
                self.assertEqual(("rows", "rle"), (by_rows["encoding"], by_runs["encoding"]))
                self.assertEqual(by_rows["rows"], [expanded(row) for row in by_runs["rows"]])
                self.assertEqual(by_rows["seq"], by_runs["seq"])
                self.assertEqual((by_rows["height"], {by_rows["width"]}),
                                 (len(by_rows["rows"]), set(map(len, by_rows["rows"]))))
                self.line.send("A**")
                self.assertEqual(on_the_line(by_rows["rows"]), self.line.read(192 * 32))

    def test_without_a_camera(self):
        workcell = self.monitor.look("model")["workcell"]
        del workcell["camera"]
        self.monitor.call("workcell", workcell=workcell)
        for ask in self.monitor.look, self.monitor.subscribe:
            with self.assertRaises(MonitorError) as caught:
                ask("image")
            self.assertEqual("no_camera", caught.exception.code)

    def test_display_follows_its_settings(self):
        with self.xr3.monitor() as viewer:
            viewer.subscribe("display", fields=["on", "view", "erase", "period_ticks", "function_keys", "status"])
            viewer.read()
            for data, member, value in [("A#", "on", True), ("A!1,-2,3!", "view", [1, -2, 3]), ("A|", "erase", False),
                                        ("A.4\r", "period_ticks", 2000)]:
                self.act(data, ticks=6000)
                viewer.read_until(lambda message: message[member] == value)
            self.act("A%3", ticks=6000)
            status = viewer.read_until(lambda message: message["status"]["option"] == 3)[-1]["status"]
            self.assertIn("E", status["text"])

    def test_model_follows_the_workcell(self):
        with self.xr3.monitor() as viewer:
            viewer.subscribe("model")
            first = viewer.read()
            self.monitor.call("block_remove", name="red")
            second = viewer.read()
            self.assertLess(first["rev"], second["rev"])
            self.assertNotEqual(first["hash"], second["hash"])
            self.assertEqual(first["robot"], second["robot"])
            names = [[block["name"] for block in model["workcell"]["blocks"]] for model in (first, second)]
            self.assertEqual(names[0], ["red", *names[1]])

    def test_two_clients_receive_the_same_bytes(self):
        with self.xr3.monitor() as one, self.xr3.monitor() as other:
            for viewer in one, other:
                for channel in LATEST + RINGS:
                    viewer.subscribe(channel, max_hz=60)
            for number in range(20):
                self.act("E+7\rE?D-3\rL" if number % 2 else "E-7\rA#M", ticks=number)
                self.monitor.call("block_move", name="blue", yaw_deg=number)
            self.monitor.call("block_remove", name="green")
            seen = []
            for viewer in one, other:
                found = viewer.read_until(lambda message: message["op"] == "model" and message["rev"] > 20)
                found += rest(viewer)
                seen.append({(each["op"], each["seq"]): each for each in found if "seq" in each})
            for channel in LATEST + RINGS:
                both = [key for key in seen[0] if key[0] == channel and key in seen[1]]
                self.assertTrue(both, channel)
                for key in both:
                    self.assertEqual(seen[0][key], seen[1][key])


def on_the_line(rows):
    """The reply to A**: six pixels per byte, the leftmost in the highest bit, each byte + 32."""
    data = b""
    for row in rows:
        row = row.ljust(-len(row) // 6 * -6, "0")
        data += bytes(32 + int(row[at:at + 6], 2) for at in range(0, len(row), 6))
    return data


class OfAHundredBlocks(unittest.TestCase):
    """A cell whose messages are long."""

    def setUp(self):
        self.xr3 = self.enterContext(Server("--workcell", "rhino-hundred"))
        self.monitor = self.enterContext(self.xr3.monitor())
        self.line = self.enterContext(self.xr3.line())

    def test_the_first_message_is_complete(self):
        for channel in LATEST:
            with self.xr3.monitor() as viewer:
                viewer.subscribe(channel)
                first = viewer.read()
                shown = self.monitor.look(channel)
                del shown["id"]
                self.assertEqual(shown, first)

    def test_all_viewers_receive_the_final_state(self):
        selections = [None, ["joints"], ["joints", "stalled"], ["blocks", "joints"]] * 8
        viewers = [self.enterContext(self.xr3.monitor()) for _ in selections]
        for viewer, fields in zip(viewers, selections):
            viewer.subscribe("state", **({"fields": fields} if fields else {}))
        self.line.send("E+20\r")
        final = self.monitor.step(5000, after=self.line)
        is_final = lambda message: message.get("joints") == final["joints"]
        shown = [viewer.read_until(is_final)[-1] for viewer in viewers]
        self.assertEqual({self.monitor.look("state")["seq"]}, {message["seq"] for message in shown})
        self.assertEqual([len(final["blocks"])] * 16,
                         [len(message["blocks"]) for message in shown if "blocks" in message])

    def test_answers_come_in_the_order_of_the_requests(self):
        wanted = ["state", "display", "model", "state", "display"]
        for number, channel in enumerate(wanted):
            self.monitor.send({"op": "get", "id": 2 * number, "channel": channel})
            self.monitor.send({"op": "ping", "id": 2 * number + 1})
        answers = [self.monitor.read() for _ in range(2 * len(wanted))]
        self.assertEqual(list(range(2 * len(wanted))), [answer["id"] for answer in answers])
        self.assertEqual(wanted, [answer["op"] for answer in answers[::2]])

    def test_a_viewer_follows_a_change_to_a_small_workcell_and_back(self):
        small, large = (json.loads(pathlib.Path(ROOT, f"data/workcells/{name}.json").read_text(encoding="utf-8"))
                        for name in ("rhino-xr3", "rhino-hundred"))
        with self.xr3.monitor() as viewer:
            viewer.subscribe("model")
            for workcell in (small, large, small):
                self.monitor.call("workcell", workcell=workcell)
                viewer.read_until(lambda message: len(message["workcell"]["blocks"]) == len(workcell["blocks"]))


class InRealTime(unittest.TestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server(clock="real:0.25"))
        self.line = self.enterContext(self.xr3.line())

    def viewer(self, channel, **options):
        viewer = self.enterContext(self.xr3.monitor())
        viewer.subscribe(channel, **options)
        return viewer

    @staticmethod
    def until_rest(viewer):
        """The states up to the one at which a move is done."""
        has_moved = []

        def is_over(message):
            has_moved.append(message["moving"])
            return any(has_moved) and not message["moving"]
        return viewer.read_until(is_over)

    def test_fifty_viewers_receive_the_final_state(self):
        viewers = [self.viewer("state", max_hz=max_hz) for max_hz in (60, 30, 30, 10, 2) * 10]
        started = time.monotonic()
        self.line.send(SLOW_MOVE + "D-60\r")
        came = [self.until_rest(viewer) for viewer in viewers]
        took_s = time.monotonic() - started
        shown = get_json(self.xr3, "/state")
        self.assertEqual("E127 D-60", counts(shown))
        for states in came:
            self.assertEqual(machine(shown), machine(states[-1]))
        at_60, _, _, at_10, at_2 = map(len, came[:5])
        for number, max_hz in (at_60, 60), (at_10, 10), (at_2, 2):
            self.assertLessEqual(number, took_s * max_hz + 3)
        self.assertGreater(at_60, 2 * at_10)
        self.assertGreater(at_10, 2 * at_2)


if __name__ == "__main__":
    unittest.main()
