"""Loads on the monitor port by HTTP."""

import itertools
import re

from attack import Beside
from cells import HEAPED
from target import call, get, read_answer

MANY = 1000
SMALL_BUFFER = 4096
LONG_HEAD = get("/healthz", *(f"X-{number:02}: " + "x" * 240 for number in range(60)))


def flood(data, count=1):
    return lambda target: target.flood(target.page, data, count=count)


def unread(data, count=1):
    return lambda target: target.flood(lambda: target.page(buffer_bytes=SMALL_BUFFER), data, count=count, reads=False)


def page_script(target):
    """The page's largest file, by its name in the page."""
    sock = target.page()
    sock.sendall(get("/", "Connection: close"))
    text = b""
    while part := sock.recv(65536):
        text += part
    found = re.search(rb'src="(/assets/[^"]*\.js)"', text)
    if not found:
        raise ValueError("this server was built without the viewer; build it first")
    target.flood(target.page, get(found[1].decode()))


def slowloris(target):
    """A thousand connections, each of which sends a byte of an HTTP head at a time."""
    head = get("/state", "X-Slow: " + "x" * 8000)
    socks = [target.page() for _ in range(MANY)]
    for turn in itertools.count():
        for number, sock in enumerate(socks):
            try:
                sock.send(head[turn % len(head):][:1])
            except OSError:
                sock.close()
                socks[number] = target.page()
        target.ready()


def storm(data):
    return lambda target: target.storm(target.monitor_port, data)


def changing(path):
    """Moves a block before each request, so that nothing that was made for the last one is of use."""
    def load(target):
        name = target.a_block()
        moves = (call("block_move", name=name, yaw_deg=yaw) for yaw in itertools.cycle(range(90)))
        mover, page = target.ask(), target.page()
        for move in moves:
            for sock, data in (mover, move), (page, get(path)):
                sock.sendall(data)
                read_answer(sock)
            target.ready()
    return load


VECTORS = b"".join(get(f"/view.svg?vector={x},{y},{z}") for x in range(1, 10) for y in range(-9, 9) for z in range(9))
ATTACKS = [
    Beside("http.state", flood(get("/state"))),
    Beside("http.camera.png", flood(get("/camera.png"))),
    Beside("http.camera.pbm", flood(get("/camera.pbm"))),
    Beside("http.camera.pbm-unread", unread(get("/camera.pbm"), 100)),
    Beside("http.view.svg", flood(get("/view.svg?vector=1,1,1"))),
    Beside("http.view.svg-heaped", flood(get("/view.svg?vector=1,1,1")), HEAPED),
    Beside("http.vectors", flood(VECTORS)),
    Beside("http.view.svg-changing", changing("/view.svg")),
    Beside("http.workcell-changing", changing("/workcell")),
    Beside("http.state-changing", changing("/state")),
    Beside("http.camera.pbm-changing", changing("/camera.pbm")),
    Beside("http.camera.png-changing", changing("/camera.png")),
    Beside("http.metrics", flood(get("/metrics"))),
    Beside("http.robot", flood(get("/robot"))),
    Beside("http.workcell", flood(get("/workcell"))),
    Beside("http.schema", flood(get("/schema/v1.json"))),
    Beside("http.page", flood(get("/"))),
    Beside("http.script", page_script),
    Beside("http.ready", flood(get("/readyz"), 20)),
    Beside("http.not-found", flood(get("/nothing/here"))),
    Beside("http.foreign", flood(b"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n")),
    Beside("http.malformed", flood(b"GET / HTTP/1.1\r\nA B: c\r\n\r\n")),
    Beside("http.long-heads", flood(LONG_HEAD)),
    Beside("http.slowloris", slowloris),
    Beside("http.storm", storm(get("/healthz"))),
    Beside("http.storm-images", storm(get("/camera.png"))),
    Beside("http.storm-json", storm(b'{"op":"get","channel":"state"}\n')),
    Beside("http.storm-tls", storm(bytes.fromhex("16030100c8010000c40303"))),
    Beside("http.bursts", lambda target: target.bursts(target.monitor_port, get("/healthz"), MANY)),
    Beside("http.many-pictures", flood(get("/view.svg"), 100)),
    Beside("http.many-png", flood(get("/camera.png"), 100)),
]
