"""The memory that clients make the server take: a connection at most 1 MiB, beyond the one message made for it alone
if it asks for that; as many of the greediest as there may be at most the cap; a request at most 1 MiB beyond ten
times its bytes; calls that change the workcell nothing that stays, and the past of a cell no more than its limit."""

import contextlib
import select
import time

import websocket
from attack import MIB, Attack, Measured, cpu_s
from cells import LARGEST, SHIPPED, Cell, workcell
from json_requests import INVALID, LARGEST_WORKCELL, permutation
from lines import MANY_LINES, MOVES
from support import DEADLINE_S, Server
from target import Target, call, get, json_line

GREEDY = 64
MANY_PAGES = 1000
CAP_MIB = 512
PAST_MIB = 64  # the history of all cells
USUAL_MIB = 32  # a server without clients
SMALL_BUFFER = 4096
REPEATED = 20
QUIET_S = 0.1
OTHER_CHANNELS = ("image", "display", "model", "event", "line")


def peak_mib(xr3):
    return xr3.status("VmHWM") / 1024


def settle(xr3):
    """Waits until the server works no more."""
    before, ends = -1.0, time.monotonic() + 3 * DEADLINE_S
    while (now := cpu_s(xr3.pid)) != before:
        if time.monotonic() > ends:
            raise AssertionError("the server does not come to rest")
        before = now
        select.select([], [], [], QUIET_S)


def send_greedily(sock, data):
    """Sends as much as the server reads."""
    sock.setblocking(False)
    with contextlib.suppress(BlockingIOError, ConnectionError):
        while data:
            data = data[sock.send(data):]
    return sock


@contextlib.contextmanager
def serving(cell, others=(), **more):
    with Cell(cell) as options, Server("--log-level", "warn", *options, *others, **more) as xr3:
        yield xr3, Target(xr3.robot_port, xr3.monitor_port)


def answer_bytes(target, request):
    with target.ask() as sock, sock.makefile("rb") as answers:
        sock.sendall(request)
        return len(answers.readline())


def greedy(name, opener, data, cell=LARGEST, clock="manual", own=None):
    """The peak of memory for each of many connections that read nothing, without one answer to `own`."""
    def measure():
        with serving(cell, clock=clock) as (xr3, target), contextlib.ExitStack() as stack:
            send = lambda number: send_greedily(stack.enter_context(opener(target, number)), data)
            send(0)  # allocates what all connections share
            settle(xr3)
            own_mib = answer_bytes(target, own) / MIB if own else 0.0
            before = peak_mib(xr3)
            for number in range(1, GREEDY + 1):
                send(number)
            settle(xr3)
            grown = peak_mib(xr3) - before
            return Measured(grown / GREEDY - own_mib, f"{before:.0f} MiB before, {own_mib:.2f} MiB of its own")
    return Attack(f"memory.{name}", 1, "MiB each", measure)


def page(target, _):
    return target.page(buffer_bytes=SMALL_BUFFER)


def line(target, _):
    return target.line(buffer_bytes=SMALL_BUFFER)


def socket(target, _):
    return websocket.opened(target, buffer_bytes=SMALL_BUFFER)


def follower(target, number):
    """A viewer that reads nothing, of a robot that moves; each has another selection of the state's members."""
    sock = page(target, number)
    others = [json_line("sub", channel=channel, max_hz=60) for channel in OTHER_CHANNELS]
    sock.sendall(b"".join([json_line("sub", channel="state", max_hz=60, fields=permutation(number)), *others]))
    if number % 10 == 0:
        with target.line() as mover:
            mover.sendall(MOVES)
    return sock


def crowd(name, *openers):
    """The peak of memory with the greatest number of greedy connections on both ports: triples of a function that opens
    one, of the data, and of their number."""
    def measure():
        with serving(LARGEST, clock="real") as (xr3, target), contextlib.ExitStack() as stack:
            for opener, data, count in openers:
                for number in range(count):
                    send_greedily(stack.enter_context(opener(target, number)), data)
            settle(xr3)
            return Measured(peak_mib(xr3))
    return Attack(f"memory.{name}", CAP_MIB + USUAL_MIB, "MiB", measure)


def calls(name, bound, request, count, cell=LARGEST, options=("--history", 0)):
    """The growth of memory by calls whose answers are read, by default without a past of the cell, which may grow."""
    def measure():
        with serving(cell, options) as (xr3, target):
            with target.ask() as sock, sock.makefile("rb") as answers:
                for turn in range(10 + count):
                    if turn == 10:
                        start = peak_mib(xr3)
                    data = request(turn) if callable(request) else request
                    sock.sendall(data)
                    for _ in range(data.count(b"\n")):
                        answers.readline()
            return Measured(peak_mib(xr3) - start, f"{count} calls")
    return Attack(f"memory.{name}", bound, "MiB", measure)


def request_cost(name, data):
    """The peak of memory for one request, over the ten times its bytes that docs/monitor.md promises."""
    def measure():
        with serving(SHIPPED) as (xr3, target), target.ask(call("describe")) as sock:
            before = peak_mib(xr3)
            sock.sendall(data)
            sock.makefile("rb").readline()
            return Measured(peak_mib(xr3) - before - 10 * len(data) / MIB, f"{len(data)} bytes")
    return Attack(f"memory.request-{name}", 1, "MiB", measure)


def images(request):
    return request * REPEATED


GET_IMAGE = json_line("get", channel="image")
UNFINISHED_HEAD = get("/state", "X: " + "x" * 7000, "Y: " + "y" * 7000)[:-2]
UNFINISHED_TEXT = websocket.frame(websocket.TEXT, b"{" + b"x" * 250_000, False)
WORKCELL = call("workcell", workcell=workcell())
STATE = json_line("get", channel="state")

ATTACKS = [
    greedy("camera.pbm", page, images(get("/camera.pbm"))),
    greedy("camera.png", page, images(get("/camera.png"))),
    greedy("view.svg", page, images(get("/view.svg"))),
    greedy("state", page, images(get("/state"))),
    greedy("workcell", page, images(get("/workcell"))),
    greedy("lines", line, b"A**" * REPEATED),
    greedy("json-images", page, images(GET_IMAGE)),
    greedy("json-states", page, images(STATE)),
    greedy("json-models", page, images(json_line("get", channel="model"))),
    greedy("json-snapshots", page, call("snapshot_save", inline=True) * 3, own=call("snapshot_save", inline=True)),
    greedy("json-events", page, json_line("get", channel="event", since=1) * 300, SHIPPED),
    greedy("json-sends", page, call("send", text="A**" * 1000) * REPEATED, own=call("send", text="A**")),
    greedy("json-unfinished", page, b'{"op":"ping","more":"' + b"x" * 250_000, SHIPPED),
    greedy("json-errors", page, b"{}\n" * 2000, SHIPPED),
    greedy("websocket-images", socket, images(websocket.text("get", channel="image"))),
    greedy("websocket-unfinished", socket, UNFINISHED_TEXT, SHIPPED),
    greedy("websocket-pings", socket, websocket.frame(websocket.PING, b"x" * 125) * 1000, SHIPPED),
    greedy("http-unfinished", page, UNFINISHED_HEAD, SHIPPED),
    greedy("telnet", line, b"\xff\xfd\x01" * 20_000, SHIPPED),
    greedy("suspended", line, b"\xff\xfb,\xff\xfa,\x08\xff\xf0" + b"A**" * REPEATED),
    greedy("suspended-inquiries", line, b"\r\xff\xfb,\xff\xfa,\x08\xff\xf0" + b"I" * 100_000, SHIPPED),
    greedy("followers", follower, b"", clock="real", own=STATE),
    crowd("crowd-images", (line, b"A**" * REPEATED, MANY_LINES), (page, images(get("/camera.pbm")), MANY_PAGES)),
    crowd("crowd-json", (line, b"A*0*" * REPEATED, MANY_LINES), (page, images(GET_IMAGE), MANY_PAGES)),
    crowd("crowd-followers", (follower, b"", MANY_PAGES)),
    calls("workcells", 8, LARGEST_WORKCELL, 300, SHIPPED),
    calls("snapshots", 16, lambda turn: call("snapshot_save", name=str(turn % 16)), 100),
    calls("past-workcells", PAST_MIB + 8, LARGEST_WORKCELL, 1500, SHIPPED, options=()),
    calls("past-models", PAST_MIB + 8, WORKCELL + call("reset"), 4000, SHIPPED, options=()),
    calls("past-snapshots", PAST_MIB + 16, call("snapshot_save", name="a") + call("reset"), 200, options=()),
    *(request_cost(name, data) for name, data in INVALID.items()),
    request_cost("workcell", LARGEST_WORKCELL),
]
