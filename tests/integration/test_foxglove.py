"""The endpoint /foxglove: its channels, received by Foxglove's own client and validated against Foxglove's own schemas; its
times and epochs; access; and clients that do not keep to the protocol."""

import json
import socket
import unittest
import urllib.error
import urllib.request

import fastjsonschema

from foxglove import OLDER, SDK, TOPICS, FoxgloveClient, FoxgloveSocket, needs_packages, published_schemas
from support import NO_QUARANTINE, Server
from test_access import TokenFile
from test_line_websocket import BINARY, UNKNOWN, LineWebsocket

GOING_AWAY, TOO_BIG = 1001, 1009
SCALARS = {"boolean", "string", "number", "integer"}


def unreadable(schema, where="", in_list=False):
    """The parts of a JSON schema that Lichtblick does not read: it knows objects with properties, lists of one type, and
    scalars of one type."""
    kind = schema.get("type")
    if kind == "object":
        if not schema.get("properties"):
            yield f"{where}: an object without properties"
        for name, member in schema.get("properties", {}).items():
            yield from unreadable(member, f"{where}/{name}")
    elif kind == "array":
        yield from unreadable(schema.get("items", {}), where, in_list=True)
    elif not isinstance(kind, str) or kind not in SCALARS:
        yield f"{where}: the type {kind}"
    elif in_list and "contentEncoding" in schema:
        yield f"{where}: contentEncoding in a list"


class Case(unittest.TestCase):
    def server(self, *options, **more):
        return self.enterContext(Server(*options, **more))

    def client(self, xr3, *args, **more):
        needs_packages(self)
        return self.enterContext(FoxgloveClient(xr3, *args, **more))

    def plain(self, xr3, *args, **fields):
        return self.enterContext(FoxgloveSocket(xr3, *args, **fields))


class Channels(Case):
    def test_all_messages_conform_to_the_schemas_of_foxglove(self):
        needs_packages(self)
        published = {f"foxglove.{name}": fastjsonschema.compile(schema) for name, schema in published_schemas().items()}
        for subprotocol in SDK, OLDER:
            with self.subTest(subprotocol), Server("--robot", "rhino-xr3-accessories", clock="real") as xr3:
                client = self.client(xr3, subprotocol)
                client.read_topics(set(TOPICS) - {"/events"})
                xr3.line().send("F+50\r")
                client.read_topics(["/events"])
                client.read_until(lambda each: each.get("topic") == "/state" and not each["message"]["moving"])
                info, = [each for each in client.seen if each["kind"] == "serverInfo"]
                self.assertEqual(subprotocol, info["subprotocol"])
                self.assertEqual((["time"], ["json"]), (info["info"]["capabilities"], info["info"]["supportedEncodings"]))
                channels = {each["topic"]: each for each in next(
                    each for each in client.seen if each["kind"] == "advertise")["channels"]}
                self.assertEqual(TOPICS, list(channels))
                own = {topic: fastjsonschema.compile(json.loads(each["schema"])) for topic, each in channels.items()}
                for topic, channel in channels.items():
                    messages = client.messages(topic)
                    self.assertTrue(messages, topic)
                    self.assertEqual([], list(unreadable(json.loads(channel["schema"]))))
                    for message in messages:
                        own[topic](message)
                        published.get(channel["schemaName"], own[topic])(message)
                self.assertEqual({*published, "xr3.State"} & {each["schemaName"] for each in channels.values()},
                                 {each["schemaName"] for each in channels.values()})

    def test_messages_follow_a_move_each_with_the_time_before_it(self):
        with Server(clock="real") as xr3:
            client = self.client(xr3)
            client.read_topics(["/state"])
            xr3.line().send("F+50\r")
            client.read_until(lambda each: each.get("topic") == "/events" and each["message"]["name"] == "reached")
            time = -1
            for each in client.seen:
                if each["kind"] == "time":
                    self.assertGreater(int(each["time"]), time)
                    time = int(each["time"])
                elif each["kind"] == "message":
                    self.assertEqual(time, int(each["time"]))
                    stamp = each["message"].get("tick", time // 1_000_000)
                    self.assertEqual(time, stamp * 1_000_000)
            counts = [each["joints"]["F"]["count"] for each in client.messages("/state")]
            self.assertEqual(sorted(counts), counts)
            self.assertGreater(len(set(counts)), 5)
            turned = {json.dumps(each["transforms"][0]["rotation"]) for each in client.messages("/tf")}
            self.assertGreater(len(turned), 5)
            self.assertEqual(1, len(client.messages("/scene")))
            self.assertEqual(1, len(client.messages("/blocks")), "no block has moved")
            self.assertIn("move", [each["name"] for each in client.messages("/events")])

    def test_blocks_and_the_picture_are_sent_when_they_change(self):
        with Server() as xr3, xr3.monitor() as monitor:
            client = self.client(xr3)
            client.read_topics(["/blocks", "/camera", "/state"])
            monitor.call("block_move", name="red", xyz_mm=[300, 50, 15])
            client.read_topics(["/blocks", "/camera"])
            red = [[each["cubes"][0]["pose"]["position"] for each in message["entities"] if each["id"] == "red"]
                   for message in client.messages("/blocks")]
            self.assertEqual([{"x": 0.3, "y": 0.05, "z": 0.015}], red[-1])
            self.assertNotEqual(red[0], red[-1])
            self.assertEqual(2, len({each["data"] for each in client.messages("/camera")}))

    def test_a_new_epoch_sends_all_again(self):
        with Server() as xr3, xr3.monitor() as monitor:
            monitor.step(500)
            client = self.client(xr3)
            client.read_topics(["/tf", "/scene", "/blocks", "/camera", "/state"])
            monitor.call("reset")
            later = client.read_topics(["/tf", "/scene", "/blocks", "/camera", "/state", "/events"])
            times = [int(each["time"]) for each in client.seen if each["kind"] == "time"]
            self.assertEqual([500_000_000, 0], times)
            self.assertTrue(all(int(each["time"]) == 0 for each in later if each["kind"] == "message"))
            self.assertEqual((0, 1), (client.messages("/state")[-1]["tick"], client.messages("/state")[-1]["epoch"]))

    def test_a_client_that_comes_later_gets_the_last_messages(self):
        with Server() as xr3, xr3.monitor() as monitor:
            first = self.client(xr3)
            first.read_topics(["/state", "/camera"])
            monitor.step(250)
            first.read_until(lambda each: each["kind"] == "time" and each["time"] == "250000000")
            second = self.client(xr3)
            second.read_topics(["/tf", "/scene", "/blocks", "/camera", "/state"])
            self.assertEqual(["250000000"], [each["time"] for each in second.seen if each["kind"] == "time"])

    def test_a_workcell_without_camera_says_so(self):
        xr3 = self.server("--workcell", "none")
        plain = self.plain(xr3)
        plain.text(), plain.text()
        plain.subscribe(4)
        self.assertEqual("/camera has no messages: this workcell has no camera", plain.text()["message"])


class Access(Case):
    def status(self, xr3, path="/foxglove", **fields):
        with LineWebsocket(xr3, path, **fields) as line:
            size = int(next(each for each in line.head.split("\r\n") if each.startswith("Content-Length")).split()[1]
                       if "Content-Length" in line.head else 0)
            return line.status, (json.loads(line.file.read(size))["error"] if size else None)

    def test_pages_and_desktop_apps(self):
        apps = [{"Origin": "null"}, {"Origin": "file://"}]
        xr3 = self.server()
        for fields in [*apps, {"Origin": "https://page.lab"}]:
            self.assertEqual((403, "wrong_origin"), (lambda s, e: (s, e["code"]))(*self.status(xr3, **fields)))
        own = {"Origin": "http://localhost"}
        self.assertEqual(101, self.status(xr3, **own)[0])
        open_to_apps = self.server("--allow-origin", "desktop,https://page.lab")
        for fields in [*apps, {"Origin": "https://page.lab"}, {}]:
            self.assertEqual(101, self.status(open_to_apps, **fields)[0])
        for path in "/ws", "/line", "/state", "/":
            for fields in apps:
                self.assertEqual(403, self.status(open_to_apps, path, **fields)[0], (path, fields))

    def test_subprotocols(self):
        xr3 = self.server()
        for offered, taken in (SDK, SDK), (OLDER, OLDER), (f"{OLDER}, {SDK}", SDK), (f"x.v1, {OLDER}", OLDER):
            with FoxgloveSocket(xr3, Sec_WebSocket_Protocol=offered) as plain:
                self.assertIn(f"Sec-WebSocket-Protocol: {taken}\r\n", plain.head)
        status, error = self.status(xr3, Sec_WebSocket_Protocol="xr3.v1")
        self.assertEqual((400, f"offer {SDK} or {OLDER}, or none"), (status, error["hint"]))

    def test_private_servers_refuse_with_the_reason(self):
        xr3 = self.server("--token-file", self.enterContext(TokenFile()), "--private")
        status, error = self.status(xr3)
        self.assertEqual((403, "token_required"), (status, error["code"]))
        self.assertIn("Foxglove clients cannot send", error["message"])

    def test_a_token_is_not_needed_to_read(self):
        xr3 = self.server("--token-file", self.enterContext(TokenFile()))
        self.assertEqual("serverInfo", self.plain(xr3).text()["op"])

    def test_cells(self):
        xr3 = self.server("--cells", 2)
        with xr3.monitor() as monitor:
            first, second = monitor.hello["cells"]
        for query, name in ("", first), (f"?cell={second}", second):
            self.assertEqual(f"xr3 {name}", self.plain(xr3, query).text()["name"])
        self.assertEqual((404, "unknown_cell"), (lambda s, e: (s, e["code"]))(*self.status(xr3, "/foxglove?cell=none")))

    def test_http_is_told_to_upgrade(self):
        xr3 = self.server()
        with self.assertRaises(urllib.error.HTTPError) as caught:
            urllib.request.urlopen(f"http://localhost:{xr3.monitor_port}/foxglove")
        with caught.exception as answer:
            self.assertEqual(426, answer.code)


class Hostile(Case):
    def test_wrong_requests_get_a_status_and_the_client_stays(self):
        plain = self.plain(self.server())
        plain.text(), plain.text()
        for request, reason in ((b"garbage", "a message is a JSON object"), (b'{"op":', "a message is a JSON object"),
                                ({"op": "getParameters"}, "read-only"),
                                ({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 77}]}, "no channel 77")):
            plain.say(request)
            status = plain.text()
            self.assertEqual(("status", 1), (status["op"], status["level"]))
            self.assertIn(reason, status["message"])
        plain.say({"op": "subscribe", "subscriptions": [{"id": each, "channelId": each} for each in range(300)]})
        self.assertIn("there is no channel 0", plain.text()["message"])
        self.assertEqual(BINARY, plain.frame()[0])

    def test_binary_and_huge_messages_end_the_connection(self):
        xr3 = self.server()
        plain = self.plain(xr3)
        plain.text(), plain.text()
        plain.send(b"\x01" * 20)
        self.assertEqual(UNKNOWN, plain.end())
        plain = self.plain(xr3)
        plain.text(), plain.text()
        plain.say(b" " * 20_000)
        self.assertEqual(TOO_BIG, plain.end())

    def test_a_client_that_never_reads_delays_no_other(self):
        with Server(clock="real", environment=NO_QUARANTINE) as xr3:
            deaf = self.plain(xr3)
            deaf.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            deaf.subscribe(*range(1, 7))
            plain = self.plain(xr3)
            plain.text(), plain.text()
            plain.subscribe(6)
            line = xr3.line()
            before = xr3.status("VmRSS")
            for _ in range(5):
                line.send("F+50\rF-50\r")
                for _ in range(120):  # 1 s: a time and a state 60 times
                    self.assertEqual(BINARY, plain.frame()[0])
                line.ask("F?")
            self.assertLess(xr3.status("VmRSS") - before, 8 * 1024)

    def test_requests_without_end_of_a_client_that_never_reads(self):
        with Server() as xr3:
            deaf = self.plain(xr3)
            deaf.socket.setblocking(False)
            wrong = b'{"op":"x"}'
            frame = bytes([0x81, 0x80 | len(wrong), 0, 0, 0, 0]) + wrong
            sent = 0
            try:
                while sent < 64 * 1024 * 1024:
                    sent += deaf.socket.send(frame * 1000)
            except BlockingIOError:
                pass  # the server has stopped reading
            self.assertLess(sent, 64 * 1024 * 1024)
            self.assertEqual(0x20, xr3.line().ask("F?"))

    def test_the_end_of_the_server(self):
        xr3 = self.server()
        plain = self.plain(xr3)
        plain.subscribe(1, 2, 3, 4, 5, 6)
        xr3.stop()
        self.assertEqual(GOING_AWAY, plain.end())

    def test_a_cell_that_closes_ends_its_clients(self):
        xr3 = self.server("--cell-per-connection", "--linger", 1)
        line = xr3.line()
        line.ask("F?")
        with xr3.monitor() as monitor:
            name, = monitor.hello["cells"]
        plain = self.plain(xr3, f"?cell={name}")
        plain.text(), plain.text()
        plain.subscribe(6)
        line.close()
        self.assertEqual(GOING_AWAY, plain.end())


if __name__ == "__main__":
    unittest.main()
