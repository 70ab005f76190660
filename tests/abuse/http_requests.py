"""Loads on the monitor port by HTTP."""

import itertools
import re

from attack import beside
from cells import HUNDRED, LARGEST, SHIPPED
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
ALL = (SHIPPED, LARGEST)
ATTACKS = [
    *beside("http.state", flood(get("/state")), *ALL),
    *beside("http.camera.png", flood(get("/camera.png")), *ALL),
    *beside("http.camera.pbm", flood(get("/camera.pbm")), *ALL),
    *beside("http.camera.pbm-unread", unread(get("/camera.pbm"), 100), LARGEST),
    *beside("http.view.svg", flood(get("/view.svg?vector=1,1,1")), SHIPPED, HUNDRED, LARGEST),
    *beside("http.vectors", flood(VECTORS), *ALL),
    *beside("http.view.svg-changing", changing("/view.svg"), *ALL),
    *beside("http.workcell-changing", changing("/workcell"), *ALL),
    *beside("http.state-changing", changing("/state"), *ALL),
    *beside("http.camera.pbm-changing", changing("/camera.pbm"), *ALL),
    *beside("http.camera.png-changing", changing("/camera.png"), *ALL),
    *beside("http.metrics", flood(get("/metrics")), SHIPPED),
    *beside("http.robot", flood(get("/robot")), SHIPPED),
    *beside("http.workcell", flood(get("/workcell")), *ALL),
    *beside("http.schema", flood(get("/schema/v1.json")), SHIPPED),
    *beside("http.page", flood(get("/")), SHIPPED),
    *beside("http.script", page_script, SHIPPED),
    *beside("http.ready", flood(get("/readyz"), 20), SHIPPED),
    *beside("http.not-found", flood(get("/nothing/here")), SHIPPED),
    *beside("http.foreign", flood(b"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"), SHIPPED),
    *beside("http.malformed", flood(b"GET / HTTP/1.1\r\nA B: c\r\n\r\n"), SHIPPED),
    *beside("http.long-heads", flood(LONG_HEAD), SHIPPED),
    *beside("http.slowloris", slowloris, SHIPPED),
    *beside("http.storm", storm(get("/healthz")), SHIPPED),
    *beside("http.storm-images", storm(get("/camera.png")), SHIPPED, LARGEST),
    *beside("http.storm-json", storm(b'{"op":"get","channel":"state"}\n'), *ALL),
    *beside("http.storm-tls", storm(bytes.fromhex("16030100c8010000c40303")), SHIPPED),
    *beside("http.bursts", lambda target: target.bursts(target.monitor_port, get("/healthz")), SHIPPED),
    *beside("http.many-pictures", flood(get("/view.svg"), 100), *ALL),
    *beside("http.many-png", flood(get("/camera.png"), 100), *ALL),
]
