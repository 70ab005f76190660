"""Loads on the monitor port by WebSocket."""

import base64
import struct

from attack import Beside
from target import get, json_line

KEY = base64.b64encode(bytes(range(16))).decode()
HANDSHAKE = get("/ws", "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                f"Sec-WebSocket-Key: {KEY}")
CONTINUATION, TEXT, PING, PONG = 0, 1, 9, 10
SMALL_BUFFER = 4096


def frame(opcode, data=b"", is_last=True):
    """A masked frame; the mask is zero."""
    first = (0x80 if is_last else 0) | opcode
    if len(data) < 126:
        return struct.pack("!BB", first, 0x80 | len(data)) + bytes(4) + data
    if len(data) < 65536:
        return struct.pack("!BBH", first, 0x80 | 126, len(data)) + bytes(4) + data
    return struct.pack("!BBQ", first, 0x80 | 127, len(data)) + bytes(4) + data


def fragments(message, size):
    """The frames of a message in pieces of this size."""
    pieces = [message[start:start + size] for start in range(0, len(message), size)]
    last = len(pieces) - 1
    return b"".join(frame(TEXT if number == 0 else CONTINUATION, piece, number == last)
                    for number, piece in enumerate(pieces))


def opened(target, **options):
    sock = target.page(**options)
    sock.sendall(HANDSHAKE)
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        head += sock.recv(1)
    return sock


def flood(data, count=1):
    return lambda target: target.flood(lambda: opened(target), data, count=count)


def unread(data):
    return lambda target: target.flood(lambda: opened(target, buffer_bytes=SMALL_BUFFER), data, reads=False)


def text(op, **members):
    return frame(TEXT, json_line(op, **members).strip())


PING_REQUEST = b'{"op":"ping","id":1}'
ENDLESS = frame(TEXT, b"{", False) + frame(CONTINUATION, b" ", False) * 100_000

ATTACKS = [
    Beside("websocket.bytes", flood(fragments(PING_REQUEST, 1))),
    Beside("websocket.pings", flood(frame(PING, b"x" * 125))),
    Beside("websocket.pings-unread", unread(frame(PING, b"x" * 125))),
    Beside("websocket.pongs", flood(frame(PONG))),
    Beside("websocket.fragments", flood(fragments(b'{"op":"ping","more":"' + b"x" * 250_000 + b'"}', 1))),
    Beside("websocket.empty-frames", flood(frame(TEXT, b"", False) + frame(CONTINUATION, b"", False) * 10_000
                                           + frame(CONTINUATION, PING_REQUEST))),
    Beside("websocket.unfinished", flood(ENDLESS)),
    Beside("websocket.large", flood(frame(TEXT, b'{"op":"ping","more":"' + b"x" * 250_000 + b'"}'))),
    Beside("websocket.requests", flood(frame(TEXT, PING_REQUEST))),
    Beside("websocket.states", flood(text("get", channel="state"))),
    Beside("websocket.images", flood(text("get", channel="image"))),
    Beside("websocket.events", flood(text("get", channel="event", since=1))),
    Beside("websocket.errors", flood(frame(TEXT, b"{}"))),
    Beside("websocket.handshakes", lambda target: target.flood(target.page, HANDSHAKE, count=20)),
]
