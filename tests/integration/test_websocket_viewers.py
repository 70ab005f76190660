"""The monitor port with WebSocket and JSON lines at the same time: the same messages, byte for byte, under the
same rules; and invalid frames, none of which has an effect."""

import asyncio
import contextlib
import json
import os
import struct
import unittest
import urllib.request

from support import LOCALHOST, Server, connect, machine
from web_viewer import REFUSED, SUBPROTOCOL, UPGRADE, Viewer, extensions_of, status_of

CONTINUATION, TEXT, BINARY, CLOSE, PING, PONG = 0, 1, 2, 8, 9, 10


class Conversation(unittest.IsolatedAsyncioTestCase):
    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())

    async def test_hello_and_replies(self):
        async with Viewer(self.xr3) as viewer:
            self.assertEqual(self.monitor.hello, viewer.hello)
            self.assertEqual((SUBPROTOCOL, []), (viewer.socket.subprotocol, extensions_of(viewer.socket)), "no compression")
            self.assertEqual({"op": "pong", "id": "a"}, await viewer.ask(op="ping", id="a"))
            result = await viewer.ask(op="call", id=1, fn="step", args={"ticks": 70})
            self.assertEqual((True, 70), (result["ok"], result["value"]["tick"]))
            self.assertEqual("unknown_fn", (await viewer.ask(op="call", id=1, fn="fly"))["error"]["code"])
            await viewer.socket.send('{"op":')
            self.assertEqual("bad_json", (await viewer.read())["error"]["code"])
            for text in "", "  \r\n", "help", "[1]", "GET / HTTP/1.1\r\n\r\n":
                await viewer.socket.send(text)
                self.assertEqual("bad_json", (await viewer.read())["error"]["code"])

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


def frame(opcode, payload, is_last=True, is_masked=True):
    """The bytes of a client's frame."""
    head = bytes([(0x80 if is_last else 0) | opcode])
    length = len(payload)
    mark = 0x80 if is_masked else 0
    if length < 126:
        head += bytes([mark | length])
    elif length < 65536:
        head += bytes([mark | 126]) + struct.pack(">H", length)
    else:
        head += bytes([mark | 127]) + struct.pack(">Q", length)
    if not is_masked:
        return head + payload
    mask = os.urandom(4)
    return head + mask + bytes(byte ^ mask[place % 4] for place, byte in enumerate(payload))


class Frames(unittest.TestCase):
    """Frames that no library would send, written to a raw socket."""

    def setUp(self):
        self.xr3 = self.enterContext(Server())
        self.monitor = self.enterContext(self.xr3.monitor())

    def after(self, *frames):
        """All bytes that the server sends after `hello`, up to its close."""
        with connect(self.xr3.monitor_port) as sock:
            sock.sendall(UPGRADE)
            data = b""
            while b"}}" not in data:  # the end of `hello`
                data += sock.recv(65536)
            self.assertTrue(data.startswith(b"HTTP/1.1 101 "))
            rest = b""
            try:
                for each in frames:
                    sock.sendall(each)
                while part := sock.recv(65536):
                    rest += part
            except (ConnectionResetError, BrokenPipeError):
                pass
            return rest

    def close_code(self, *frames):
        answer = self.after(*frames)
        at = answer.rfind(bytes([0x80 | CLOSE]))
        return struct.unpack(">H", answer[at + 2:at + 4])[0] if at >= 0 and len(answer) >= at + 4 else None

    def test_close_codes(self):
        step = b'{"op":"call","fn":"step","args":{"ticks":9}}'
        for code, frames in [
            (1003, [frame(BINARY, step)]),
            (1002, [frame(TEXT, step, is_masked=False)]),
            (1002, [frame(CONTINUATION, step)]),
            (1002, [frame(3, step)]),
            (1002, [frame(TEXT, b"{", is_last=False), frame(TEXT, step)]),
            (1002, [frame(PING, b"x" * 126)]),
        ]:
            with self.subTest(code=code, start=frames[0][:12]):
                self.assertEqual(code, self.close_code(*frames))
        self.assertEqual(0, self.monitor.get("moving")["tick"])

    def test_an_impossible_length_is_refused(self):
        for length in 2**31, 2**62, 2**64 - 1:
            head = bytes([0x80 | TEXT, 0x80 | 127]) + struct.pack(">Q", length) + b"mask" + b"{" * 100
            self.assertIn(self.close_code(head), (1002, 1009, None))
        self.assertEqual("pong", self.monitor.request("ping")["op"])

    def test_pings_are_answered_between_fragments(self):
        answer = self.after(frame(TEXT, b'{"op":', is_last=False), frame(PING, b"here?"),
                            frame(CONTINUATION, b'"ping","id":8}'), frame(CLOSE, struct.pack(">H", 1000)))
        self.assertIn(bytes([0x80 | PONG, 5]) + b"here?", answer)
        self.assertIn(b'{"op":"pong","id":8}', answer)

    def test_an_incomplete_frame_has_no_effect(self):
        for cut in 1, 2, 5, 8, 12:
            with connect(self.xr3.monitor_port) as sock:
                sock.sendall(UPGRADE + frame(TEXT, b'{"op":"call","fn":"step","args":{"ticks":9}}')[:cut])
                self.assertTrue(sock.recv(20))
        self.assertEqual(0, self.monitor.get("moving")["tick"])


if __name__ == "__main__":
    unittest.main()
