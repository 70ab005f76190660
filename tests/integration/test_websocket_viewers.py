"""The monitor port with WebSocket and JSON lines at the same time: the same messages, byte for byte, under the
same rules."""

import asyncio
import contextlib
import json
import unittest
import urllib.request

from support import LOCALHOST, Server, machine
from web_viewer import REFUSED, Viewer, status_of


class Conversation(unittest.IsolatedAsyncioTestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())

    async def test_hosts_and_origins(self):
        good = f"http://{LOCALHOST}:{self.xr3.monitor_port}"
        async with Viewer(self.xr3, origin=good):
            pass
        for origin in "http://evil.example", "null", "https" + good[4:], f"http://{LOCALHOST}:1", "http://localhost":
            with self.subTest(origin), self.assertRaises(REFUSED) as caught:
                async with Viewer(self.xr3, origin=origin):
                    pass
            self.assertEqual(403, status_of(caught.exception))

    async def test_the_same_bytes_as_json_lines(self):
        channels = ["state", "image", "display", "model", "event", "line"]
        async with Viewer(self.xr3) as viewer:
            with self.xr3.monitor() as lines:
                seen = {}
                for channel in channels:
                    await viewer.socket.send(json.dumps({"op": "sub", "channel": channel, "max_hz": 60}))
                    lines.subscribe(channel, max_hz=60)
                self.monitor.call("send", text="E+5\rE?A#")
                self.monitor.step(100)
                self.monitor.call("block_move", name="red", yaw_deg=5)
                while not any(op == "model" and message["rev"] > 1 for (op, _), message in seen.items()):
                    await self.into(viewer, seen)
                both = 0
                for message in lines.read_until(lambda each: each["op"] == "model" and each["rev"] > 1):
                    if (message["op"], message.get("seq")) in seen:
                        self.assertEqual(seen[message["op"], message["seq"]], message)
                        both += 1
                self.assertGreater(both, 5)

    async def test_fifty_viewers_receive_the_final_state(self):
        self.monitor.call("resume")
        async with contextlib.AsyncExitStack() as stack:
            viewers = [await stack.enter_async_context(Viewer(self.xr3)) for _ in range(50)]
            for number, viewer in enumerate(viewers):
                await viewer.socket.send(json.dumps({"op": "sub", "channel": "state", "max_hz": (5, 30, 60)[number % 3]}))
            self.monitor.call("send", text="E255SE+100\rD-40\r")
            last = await asyncio.gather(*map(self.until_rest, viewers))
            with urllib.request.urlopen(f"http://{LOCALHOST}:{self.xr3.monitor_port}/state") as answer:
                shown = machine(json.load(answer))
            for state in last:
                self.assertEqual(shown, machine(state))

    async def until_rest(self, viewer):
        """The state at which a move is done."""
        has_moved = False
        while True:
            message = await viewer.read()
            if message["op"] == "state" and has_moved and not message["moving"]:
                return message
            has_moved = has_moved or message.get("moving", False)

    async def into(self, viewer, seen):
        message = await viewer.read()
        seen[message["op"], message.get("seq")] = message

    async def test_the_line_of_send_closes_with_the_client(self):
        async with Viewer(self.xr3) as viewer:
            await viewer.ask(op="call", fn="send", args={"text": "E?"})
            self.assertEqual(1, len(self.monitor.call("lines")["lines"]))
        self.monitor.subscribe("event", since=0)
        self.monitor.read_until(lambda event: event["event"] == "line_close")


if __name__ == "__main__":
    unittest.main()
