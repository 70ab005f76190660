"""WebSocket (/ws) with an independent client, python3-websockets, and with hand-made bytes that this client
cannot send: the handshake, valid and invalid messages, and the close."""

import asyncio
import base64
import json
import struct
import unittest

import websockets

import monitor_schema
from support import DEADLINE_S, LOCALHOST, Server, connect
from web_viewer import REFUSED, extensions_of, status_of

KEY = base64.b64encode(bytes(range(16))).decode()
HANDSHAKE = ("GET /ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
             f"Sec-WebSocket-Key: {KEY}\r\nSec-WebSocket-Version: 13\r\n")
TEXT, BINARY, CLOSE, PING, PONG, CONTINUATION = 1, 2, 8, 9, 10, 0
LONGEST = 256 * 1024
STEP = b'{"op":"call","fn":"step","args":{"ticks":9}}'


def frame(opcode, data=b"", last=True):
    """A masked frame; the mask is zero."""
    first = (0x80 if last else 0) | opcode
    if len(data) < 126:
        return struct.pack("!BB", first, 0x80 | len(data)) + bytes(4) + data
    if len(data) < 65536:
        return struct.pack("!BBH", first, 0x80 | 126, len(data)) + bytes(4) + data
    return struct.pack("!BBQ", first, 0x80 | 127, len(data)) + bytes(4) + data


def checked(text):
    """A message of the server, checked against the schema."""
    return monitor_schema.check(json.loads(text), is_whole=False)


class Raw:
    """A minimal WebSocket client. It relies on the server not to fragment messages."""

    def __init__(self, port, fields=""):
        self.socket = connect(port)
        self.socket.sendall((HANDSHAKE + fields + "\r\n").encode())
        self.file = self.socket.makefile("rb")
        self.head = b"".join(iter(self.file.readline, b"\r\n")).decode()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()
        self.socket.close()

    def send(self, *arguments, **options):
        self.socket.sendall(frame(*arguments, **options))

    def read(self):
        """(opcode, data) of the next frame; None at the end of the stream."""
        start = self.file.read(2)
        if len(start) < 2:
            return None
        size = start[1]
        if size == 126:
            size, = struct.unpack("!H", self.file.read(2))
        elif size == 127:
            size, = struct.unpack("!Q", self.file.read(8))
        return start[0] & 15, self.file.read(size)

    def text(self):
        opcode, data = self.read()
        assert opcode == TEXT, (opcode, data)
        return checked(data)

    def close_code(self):
        """The code of the next close frame; skips messages before it. None without a close frame."""
        while (got := self.read()) is not None:
            if got[0] == CLOSE:
                return struct.unpack("!H", got[1][:2])[0]
        return None


class Library(unittest.TestCase):
    def run_with(self, port, work, query="", **options):
        async def run():
            options.setdefault("subprotocols", ["xr3.v1"])
            async with websockets.connect(f"ws://{LOCALHOST}:{port}/ws{query}", **options) as socket:
                await asyncio.wait_for(work(socket), DEADLINE_S)
        asyncio.run(run())

    def test_messages_equal_those_of_json_lines(self):
        async def work(socket):
            self.assertEqual("xr3.v1", socket.subprotocol)
            self.assertEqual([], extensions_of(socket))
            hello = checked(await socket.recv())
            self.assertEqual(self.hello, hello)
            await socket.send(json.dumps({"op": "call", "id": 1, "fn": "step", "args": {"ticks": 5, "fields": []}}))
            self.assertEqual(5, checked(await socket.recv())["value"]["tick"])
            await socket.send(json.dumps({"op": "get", "id": 2, "channel": "state"}))
            by_socket = checked(await socket.recv())
            self.assertEqual({**self.monitor.get(), "id": 2}, by_socket)

        with Server() as xr3, xr3.monitor() as self.monitor:
            self.hello = self.monitor.hello
            self.run_with(xr3.monitor_port, work)

    def test_fragments_and_pings(self):
        async def work(socket):
            await socket.recv()
            await (await socket.ping(b"hello"))
            await socket.send(iter(['{"op":"pi', 'ng","id":', '"fragments"}']))
            self.assertEqual({"op": "pong", "id": "fragments"}, checked(await socket.recv()))

        with Server() as xr3:
            self.run_with(xr3.monitor_port, work)

    def test_only_the_known_subprotocol_is_accepted(self):
        async def work(socket):
            self.assertIsNone(socket.subprotocol)
            self.assertEqual("hello", checked(await socket.recv())["op"])

        with Server() as xr3:
            self.run_with(xr3.monitor_port, work, subprotocols=None)
            with self.assertRaises(REFUSED) as refused:
                self.run_with(xr3.monitor_port, work, subprotocols=["soap"])
            self.assertEqual(400, status_of(refused.exception))
            with self.assertRaises(REFUSED) as refused:
                self.run_with(xr3.monitor_port, work, origin="http://evil.example")
            self.assertEqual(403, status_of(refused.exception))

    def test_the_query_chooses_the_cell_of_requests_that_name_none(self):
        async def work(socket):
            self.assertEqual("2", checked(await socket.recv())["cell"])
            await socket.send(json.dumps({"op": "call", "id": 1, "fn": "step", "args": {"ticks": 5, "fields": []}}))
            self.assertTrue(checked(await socket.recv())["ok"])

        with Server("--cells", 2) as xr3, xr3.monitor() as monitor:
            self.run_with(xr3.monitor_port, work, query="?cell=2")
            self.assertEqual([0, 5], [monitor.request("get", cell=cell, channel="state")["tick"] for cell in "12"])

    def test_an_unknown_cell_in_the_query_is_refused(self):
        with Server() as xr3:
            for query in "?cell=2", "?cell=", "?cell=%":
                with self.subTest(query), self.assertRaises(REFUSED) as refused:
                    self.run_with(xr3.monitor_port, None, query=query)
                self.assertEqual(404, status_of(refused.exception))

    def test_without_the_token_nobody_learns_which_cells_there_are(self):
        async def work(socket):
            self.assertNotIn("cells", checked(await socket.recv()))
            await socket.send(json.dumps({"op": "auth", "id": 1, "token": "sixteen letters!"}))
            self.assertTrue(checked(await socket.recv())["ok"])
            self.assertIsNone(checked(await socket.recv())["cell"])
            await socket.send(json.dumps({"op": "get", "id": 2, "channel": "state"}))
            self.assertEqual("unknown_cell", checked(await socket.recv())["error"]["code"])

        with Server("--private", environment={"XR3_TOKEN": "sixteen letters!"}) as xr3:
            self.run_with(xr3.monitor_port, work, query="?cell=2")

    def test_shutdown_closes_with_going_away(self):
        async def work(socket):
            await socket.recv()
            self.xr3.process.terminate()
            self.assertEqual("shutdown", checked(await socket.recv())["why"])
            with self.assertRaises(websockets.ConnectionClosed):
                await socket.recv()
            self.assertEqual(1001, socket.close_code)

        with Server() as self.xr3:
            self.run_with(self.xr3.monitor_port, work)
            self.assertEqual(0, self.xr3.process.wait(DEADLINE_S))

    def test_five_wrong_tokens_close_the_connection(self):
        async def work(socket):
            self.assertEqual("read", checked(await socket.recv())["access"])
            for _ in range(5):
                await socket.send(json.dumps({"op": "auth", "token": "wrong"}))
                self.assertEqual("bad_token", checked(await socket.recv())["error"]["code"])
            self.assertEqual("bad_token", checked(await socket.recv())["why"])
            with self.assertRaises(websockets.ConnectionClosed):
                await socket.recv()
            self.assertEqual(1008, socket.close_code)

        with Server(environment={"XR3_TOKEN": "sixteen letters!"}) as xr3:
            self.run_with(xr3.monitor_port, work)


class Bytes(unittest.TestCase):
    def test_close_codes(self):
        cases = [("binary", frame(BINARY, STEP), 1003),
                 ("bad UTF-8", frame(TEXT, b'{"op":"\xff"}'), 1007),
                 ("bad UTF-8 over fragments", frame(TEXT, b"\xe2\x82", last=False) + frame(CONTINUATION, b"{"), 1007),
                 ("half a character before an empty last frame",
                  frame(TEXT, b"{\xe2\x82", last=False) + frame(CONTINUATION, b""), 1007),
                 ("too big", frame(TEXT, b" " * (LONGEST + 1)), 1009),
                 ("too big in fragments",
                  frame(TEXT, b" " * LONGEST, last=False) + frame(CONTINUATION, b" "), 1009),
                 ("no mask", b"\x81\x02{}", 1002),
                 ("a continuation of nothing", frame(CONTINUATION, STEP), 1002),
                 ("an unknown kind", frame(3, STEP), 1002),
                 ("a message in another one", frame(TEXT, b"{", last=False) + frame(TEXT, STEP), 1002),
                 ("a long ping", frame(PING, b"x" * 126), 1002),
                 ("a close", frame(CLOSE, struct.pack("!H", 1000)), 1000)]
        with Server() as xr3, Raw(xr3.monitor_port) as good:
            good.text()
            for name, data, code in cases:
                with self.subTest(name), Raw(xr3.monitor_port) as client:
                    self.assertEqual("hello", client.text()["op"])
                    client.socket.sendall(data)
                    self.assertEqual(code, client.close_code())
                    self.assertIsNone(client.read())
            good.send(TEXT, b'{"op":"get","id":1,"channel":"state","fields":[]}')
            self.assertEqual(0, good.text()["tick"], "nothing has acted")

    def test_an_impossible_length_is_refused(self):
        with Server() as xr3:
            for length in 2**31, 2**62, 2**64 - 1:
                with self.subTest(length), Raw(xr3.monitor_port) as client:
                    client.text()
                    client.socket.sendall(struct.pack("!BBQ", 0x80 | TEXT, 0x80 | 127, length) + b"mask" + b"{" * 100)
                    self.assertIn(client.close_code(), (1002, 1009, None))
            with Raw(xr3.monitor_port) as good:
                self.assertEqual("hello", good.text()["op"])

    def test_pings_are_answered_between_fragments(self):
        with Server() as xr3, Raw(xr3.monitor_port) as client:
            client.text()
            client.send(TEXT, b'{"op":', last=False)
            client.send(PING, b"here?")
            client.send(CONTINUATION, b'"ping","id":8}')
            self.assertEqual((PONG, b"here?"), client.read())
            self.assertEqual({"op": "pong", "id": 8}, client.text())

    def test_an_incomplete_frame_has_no_effect(self):
        with Server() as xr3, xr3.monitor() as monitor:
            for cut in 1, 2, 5, 8, 12:
                with Raw(xr3.monitor_port) as client:
                    client.socket.sendall(frame(TEXT, STEP)[:cut])
                    client.text()
            self.assertEqual(0, monitor.get("moving")["tick"])

    def test_invalid_requests_do_not_close(self):
        with Server() as xr3, Raw(xr3.monitor_port) as client:
            client.text()
            for message, code in [(b"", "bad_json"), (b"[1]", "bad_json"), (b'{"op":', "bad_json"),
                                  (b"[" * 1000, "bad_json"), (b"  \r\n", "bad_json"), (b"help", "bad_json"),
                                  (b"GET / HTTP/1.1\r\n\r\n", "bad_json"), (b'{"op":"fly"}', "unknown_op")]:
                client.send(TEXT, message)
                answer = client.text()
                self.assertFalse(answer["ok"], answer)
                self.assertIn(answer["error"]["code"], (code, "too_deep"))
            longest = b'{"op":"ping","id":7,"x":"' + b"x" * (LONGEST - 27) + b'"}'
            self.assertEqual(LONGEST, len(longest))
            client.send(TEXT, longest)
            self.assertEqual({"op": "pong", "id": 7}, client.text())
            client.send(PING, b"there?")
            self.assertEqual((PONG, b"there?"), client.read())

    def test_the_handshake(self):
        with Server() as xr3:
            with Raw(xr3.monitor_port, "Sec-WebSocket-Protocol: a, xr3.v1\r\n") as client:
                self.assertTrue(client.head.startswith("HTTP/1.1 101 "), client.head)
                self.assertIn("Sec-WebSocket-Protocol: xr3.v1\r\n", client.head)
                self.assertIn("X-Content-Type-Options: nosniff\r\n", client.head)
                self.assertNotIn("Extensions", client.head)
            compressing = "Sec-WebSocket-Extensions: permessage-deflate\r\n"
            with Raw(xr3.monitor_port, compressing) as client:
                self.assertNotIn("Extensions", client.head)
            with Raw(xr3.monitor_port, "Host: localhost\r\n") as client:
                self.assertTrue(client.head.startswith("HTTP/1.1 400 "), client.head)
            with connect(xr3.monitor_port) as early:  # a frame before 101 is an error
                early.sendall((HANDSHAKE + "\r\n").encode() + frame(TEXT, b'{"op":"call","fn":"reset"}'))
                self.assertTrue(early.recv(100).startswith(b"HTTP/1.1 400 "))
            with xr3.monitor() as monitor:
                self.assertEqual(0, monitor.get()["epoch"])


if __name__ == "__main__":
    unittest.main()
