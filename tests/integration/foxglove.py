"""Foxglove clients for tests: Foxglove's own one, in node, and one of plain frames."""

import json
import os
import shutil
import subprocess
import threading

from support import DEADLINE_S, LOCALHOST, ROOT
from test_line_websocket import BINARY, CLOSE, TEXT, LineWebsocket

PACKAGES = os.path.join(ROOT, "clients", "web", "node_modules")
SDK, OLDER = "foxglove.sdk.v1", "foxglove.websocket.v1"
TOPICS = ["/tf", "/scene", "/blocks", "/camera", "/events", "/state"]


def needs_packages(case):
    case.assertTrue(shutil.which("node"), "node is not installed (scripts/setup test)")
    case.assertTrue(os.path.isdir(os.path.join(PACKAGES, "@foxglove")), "run scripts/viewer first: it fetches Foxglove's packages")


def published_schemas():
    """The JSON schemas of @foxglove/schemas, by name without `foxglove.`"""
    program = 'console.log(JSON.stringify(require("@foxglove/schemas/jsonschema")))'
    run = subprocess.run(["node", "-e", program], cwd=os.path.dirname(PACKAGES), capture_output=True, text=True, check=True)
    return json.loads(run.stdout)


class FoxgloveClient:
    """A context manager for @foxglove/ws-protocol's client, which subscribes to all channels. `seen` are the messages that
    have been read; each is an object with `kind`, see foxglove_client.mjs."""

    def __init__(self, xr3, subprotocol=SDK, query="", origin=None):
        url = f"ws://{LOCALHOST}:{xr3.monitor_port}/foxglove{query}"
        self.command = ["node", os.path.join(ROOT, "tests/integration/foxglove_client.mjs"), url, subprotocol,
                        *([] if origin is None else [origin])]
        self.seen = []

    def __enter__(self):
        self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()

    def read(self):
        watchdog = threading.Timer(DEADLINE_S, self.process.kill)
        watchdog.start()
        line = self.process.stdout.readline()
        watchdog.cancel()
        assert line, f"the client has ended; its last messages: {str(self.seen[-3:])[:1000]}"
        self.seen.append(json.loads(line))
        return self.seen[-1]

    def read_until(self, is_last):
        """The messages up to and including the first for which is_last(message) is true."""
        start = len(self.seen)
        while not is_last(self.read()):
            pass
        return self.seen[start:]

    def read_topics(self, topics):
        """The messages until each of these topics has had one."""
        missing = set(topics)

        def is_last(message):
            missing.discard(message.get("topic"))
            return not missing

        return self.read_until(is_last)

    def messages(self, topic):
        return [each["message"] for each in self.seen if each.get("topic") == topic]


class FoxgloveSocket(LineWebsocket):
    """A client that sends frames as they are."""

    def __init__(self, xr3, query="", **fields):
        super().__init__(xr3, "/foxglove" + query, **{"Sec_WebSocket_Protocol": SDK, **fields})

    def text(self):
        """The next text message, without the messages of channels before it."""
        while True:
            kind, data = self.frame()
            if kind == TEXT:
                return json.loads(data)
            assert kind == BINARY, (kind, data)

    def say(self, message):
        """Sends a text message of less than 64 KiB."""
        data = message if isinstance(message, bytes) else json.dumps(message).encode()
        size = bytes([0x80 | len(data)]) if len(data) < 126 else bytes([0x80 | 126]) + len(data).to_bytes(2, "big")
        self.socket.sendall(bytes([TEXT]) + size + bytes(4) + data)

    def end(self):
        """The code of the close frame, after the messages before it."""
        while (frame := self.frame())[0] != CLOSE:
            pass
        return int.from_bytes(frame[1][:2], "big")

    def subscribe(self, *channels):
        self.say({"op": "subscribe", "subscriptions": [{"id": each, "channelId": each} for each in channels]})
