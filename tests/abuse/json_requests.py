"""Loads on the monitor port by JSON lines."""

import contextlib
import itertools
import json
import select

from attack import Beside
from cells import HEAPED, MOST_PIXELS, blocks, workcell
from lines import MANY_LINES, MOVES
from target import call, get, json_line

STATE_FIELDS = ("clock", "joints", "tool", "blocks", "switches", "io", "moving", "stalled", "enabled", "model_rev")


def flood(data, count=1, before=()):
    return lambda target: target.flood(lambda: target.ask(*before), data, count=count)


def scenes(target):
    """Moves a block to and fro, and asks for the image each time."""
    name = target.a_block()
    target.flood(target.ask, b"".join(call("block_move", name=name, yaw_deg=yaw) + json_line("get", channel="image")
                                      for yaw in (1, 2)))


def mixture(target):
    """One client with all that costs much, on many connections of both ports."""
    clients = [
        (target.line, b"A**"), (target.line, MOVES),
        (target.page, get("/view.svg")), (target.page, get("/workcell")), (target.page, get("/camera.png")),
        (target.ask, json_line("get", channel="state")), (target.ask, json_line("get", channel="event", since=1)),
        (target.ask, edits()), (target.ask, INVALID["numbers"])]
    target.flood_each(10 * clients)


def edits():
    new = {"size_mm": [9, 9, 9], "xyz_mm": [300, 0, 5], "color": 1}
    return call("block_add", name="x", **new) + call("block_remove", name="x")


INVALID = {
    "json": b'{"op":"ping"\n' * 20,
    "deep": b'{"op":"ping","more":' + b"[" * 200_000 + b"\n",
    "members": b'{"op":"call","id":1,"fn":"step","args":{' + b",".join(b'"%d":0' % i for i in range(20_000)) + b"}}\n",
    "duplicates": b'{"op":"call","id":1,"fn":"workcell","args":{"workcell":{"a":0' + b',"a":0' * 40_000 + b"}}}\n",
    "blocks": b'{"op":"call","id":1,"fn":"workcell","args":{"workcell":{"blocks":[{}' + b",{}" * 9999 + b"]}}}\n",
    "values": b'{"op":"call","id":1,"fn":"workcell","args":{"workcell":{"blocks":[0' + b",0" * 120_000 + b"]}}}\n",
    "text": b'{"op":"' + b"x" * 250_000 + b'"}\n',
    "escapes": b'{"op":"' + b"\\u0001" * 40_000 + b'"}\n',
    "name": b'{"op":"call","id":1,"fn":"block_remove","args":{"name":"' + b"x" * 250_000 + b'"}}\n',
    "numbers": b'{"op":"ping","more":[' + b"1e-300," * 35_000 + b"0]}\n",
    "pointers": b'{"op":"call","id":1,"fn":"workcell","args":{"workcell":{"' + b"n" * 131_000 + b'":[0'
                + b",0" * 65_000 + b"]}}}\n",
}


def viewers(fields_of, channel="state", count=200):
    """Subscribers of a moving robot; their selections differ."""
    def load(target):
        socks = [target.tell(json_line("sub", channel=channel, max_hz=60, fields=fields_of(number)))
                 for number in range(count)]
        line = target.line()
        target.ready()
        while True:
            line.sendall(MOVES)
            for sock in select.select(socks, [], [], 0.005)[0]:
                sock.recv(1 << 20)
    return load


def permutation(number):
    return list(next(itertools.islice(itertools.permutations(STATE_FIELDS), 17 * number, None)))


def image_fields(number):
    orders = itertools.permutations(("width", "height", "encoding", "rows"))
    return list(next(itertools.islice(orders, number % 24, None)))


def waiting(target):
    """200 calls that wait for bytes of a line, while each of many lines sends a byte at a time."""
    lines = [target.line() for _ in range(MANY_LINES)]
    after = {"line": 1, "bytes_in": 10**9, "within_ms": 60_000}
    waiters = [target.tell(call("step", ticks=0, fields=[], after=after)) for _ in range(200)]
    while waiters:  # always
        for line in lines:
            line.send(b"\r")
            target.ready()


def churn(target):
    channels = ("state", "image", "display", "model", "event", "line")
    data = b"".join(json_line(op, channel=channel) for channel in channels for op in ("sub", "unsub"))
    target.flood(target.ask, data)


def wrong_tokens(target):
    target.flood(target.ask, json_line("auth", token="x" * 100), count=200)


def many_lines(request):
    def load(target):
        with contextlib.ExitStack() as lines:
            for _ in range(MANY_LINES):
                lines.enter_context(target.line())
            target.flood(target.ask, request)
    return load


def inline_snapshots(target):
    """Loads a snapshot of as many blocks as a workcell can have, again and again."""
    sock = target.ask(LARGEST_WORKCELL)
    sock.sendall(call("snapshot_save", inline=True))
    answer = json.loads(sock.makefile("rb").readline())
    target.flood(target.ask, call("snapshot_load", snapshot=answer["value"]["snapshot"]))


LARGEST_WORKCELL = call("workcell", workcell=workcell(blocks(), MOST_PIXELS))
EVENTS = json_line("get", channel="event", since=1)
SAVED = call("snapshot_save", name="a")
LOADED = call("snapshot_load", name="a")
RUN = call("send", text=MOVES.decode()) + call("run_until", idle=True, max_ticks=2**53 - 1)
STEP = call("send", text="E-100\r") + call("step", ticks=10**12)

ATTACKS = [
    Beside("json.pings", flood(json_line("ping"))),
    Beside("json.events", flood(EVENTS, before=[call("home")] * 5)),
    Beside("json.lines", flood(json_line("get", channel="line", since=1))),
    Beside("json.states", flood(json_line("get", channel="state"))),
    Beside("json.selected-states", flood(b"".join(
        json_line("get", channel="state", fields=permutation(number)) for number in range(200)))),
    Beside("json.images", flood(json_line("get", channel="image"))),
    Beside("json.run-lengths", flood(json_line("get", channel="image", encoding="rle"))),
    Beside("json.models", flood(json_line("get", channel="model"))),
    Beside("json.displays", flood(json_line("get", channel="display"))),
    Beside("json.keys", flood(call("key", function="display") + json_line("get", channel="display"))),
    Beside("json.describe", flood(call("describe"))),
    Beside("json.many-lines", many_lines(call("lines"))),
    Beside("json.sent", flood(call("send", text="A**" * 1000))),
    Beside("json.workcells", flood(LARGEST_WORKCELL)),
    Beside("json.edits", flood(edits())),
    Beside("json.scenes", scenes),
    Beside("json.scenes-heaped", scenes, HEAPED),
    Beside("json.homes", flood(call("home") + json_line("get", channel="state"))),
    Beside("json.resets", flood(call("reset"))),
    Beside("json.snapshots-saved", flood(SAVED)),
    Beside("json.snapshots-loaded", flood(LOADED, before=[SAVED])),
    Beside("json.snapshots-inline", inline_snapshots),
    Beside("json.steps", flood(STEP), clock="manual"),
    Beside("json.runs", flood(RUN), clock="manual"),
    Beside("json.rates", flood(call("rate", factor=100_000) + call("send", text=MOVES.decode()))),
    Beside("json.churn", churn),
    Beside("json.viewers", viewers(permutation)),
    Beside("json.image-viewers", viewers(image_fields, "image")),
    Beside("json.waiting", waiting, clock="manual"),
    Beside("json.wrong-tokens", wrong_tokens, options=("--token", "auto")),
    Beside("json.mixture", mixture),
    *(Beside(f"json.invalid-{name}", flood(data)) for name, data in INVALID.items()),
]
