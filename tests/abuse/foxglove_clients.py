"""Loads on the endpoint /foxglove. The cell has as many blocks and pixels as a file may have."""

import itertools
import json
import select
import threading

from attack import Beside
from target import MOST_AT_ONCE, call, get
from websocket import KEY, SMALL_BUFFER, TEXT, frame

CLIENTS = 10
CHANNELS = range(1, 7)
HANDSHAKE = get("/foxglove", "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                f"Sec-WebSocket-Key: {KEY}", "Sec-WebSocket-Protocol: foxglove.sdk.v1")


def request(op, **members):
    return frame(TEXT, json.dumps({"op": op, **members}).encode())


def subscribe(channels):
    return request("subscribe", subscriptions=[{"id": each, "channelId": each} for each in channels])


SUBSCRIBE_ALL = subscribe(CHANNELS)
AGAIN = SUBSCRIBE_ALL + request("unsubscribe", subscriptionIds=list(CHANNELS))


def opened(target, data=b"", **options):
    sock = target.page(**options)
    sock.sendall(HANDSHAKE)
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        head += sock.recv(1)
    sock.sendall(data)
    return sock


def moves(line):
    """Keeps a joint in motion."""
    for sign in itertools.cycle("+-"):
        line.sendall(f"B{sign}90\r".encode())
        select.select([], [], [], 0.5)


def move_blocks(target, monitor):
    """Moves a block to and fro, so that the message of all blocks and the picture are made again."""
    name = target.a_block()
    for z in itertools.cycle((400, 410)):
        monitor.sendall(call("block_move", name=name, xyz_mm=[300, 0, z]))
        monitor.recv(MOST_AT_ONCE)


def follow(target, reads=True, act=None):
    """Clients that follow all channels of a robot in motion."""
    clients = [opened(target, SUBSCRIBE_ALL, **({} if reads else {"buffer_bytes": SMALL_BUFFER})) for _ in range(CLIENTS)]
    threading.Thread(target=act or (lambda: moves(target.line())), daemon=True).start()
    while reads:
        for sock in select.select(clients, [], [])[0]:
            sock.recv(MOST_AT_ONCE)
        target.ready()
    target.hold()


ATTACKS = [
    Beside("foxglove.clients", follow),
    Beside("foxglove.unread", lambda target: follow(target, reads=False)),
    Beside("foxglove.blocks", lambda target: follow(target, act=lambda: move_blocks(target, target.ask()))),
    Beside("foxglove.subscriptions", lambda target: target.flood(lambda: opened(target), AGAIN)),
    Beside("foxglove.errors", lambda target: target.flood(lambda: opened(target), frame(TEXT, b"{}"))),
]
