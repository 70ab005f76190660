"""Loads on the robot port."""

import ctypes
import itertools
import os
import select
import signal
import socket

from attack import beside, crowd
from cells import HUNDRED, LARGEST, SHIPPED
from target import MOST_AT_ONCE, PING, call, json_line

MANY_LINES = 60  # of 64
STEPPERS = 500
PR_SET_PDEATHSIG = 1
SMALL_BUFFER = 4096
PING_MS, STEP_MS, CROWDED_STEP_MS = 20, 250, 1500
MOVES = b"".join(b"%c%+d\r" % (label, sign) for label in b"ABCDEF" for sign in (1, -1))
ROWS = b"".join(b"A*%d*A*%d,7*" % (row, row) for row in range(192))
GARBAGE = bytes(number * 7 % 256 for number in range(65536)).replace(b"A", b"z").replace(b"\xff", b"z")
TELNET = b"".join(b"\xff\xfd%c\xff\xfb%c" % (option, option) for option in range(1, 200))
COM_PORT = b"\xff\xfb,\xff\xfc,\xff\xfb," + b"\xff\xfa,\x07\xff\xf0\xff\xfa,\x00\xff\xf0" * 50
SUSPENDED = b"\xff\xfb,\xff\xfa,\x08\xff\xf0" + b"E?A*0*" * 50 + b"\xff\xfa,\x0c\x01\xff\xf0"
NEGOTIATION = b"\xff\xfa\x18" + b"x" * 600 + b"\xff\xf0"


def flood(data, reads=True):
    if reads:
        return lambda target: target.flood(target.line, data)
    return lambda target: target.flood(lambda: target.line(buffer_bytes=SMALL_BUFFER), data, reads=False)


def trickle(data):
    """Many lines, each of which sends a byte at a time, again and again, and reads the replies."""
    def load(target):
        socks = [target.line() for _ in range(MANY_LINES)]
        for turn in itertools.count():
            if turn == 1:
                target.ready()
            for number, sock in enumerate(socks):
                try:
                    sock.send(data[turn % len(data):][:1])
                    if turn % 100 == 99:
                        sock.recv(4096, socket.MSG_DONTWAIT)
                except BlockingIOError:
                    pass
                except OSError:  # closed by the server: too many unread replies
                    socks[number] = target.line()
    return load


def storm(data):
    return lambda target: target.storm(target.robot_port, data)


def watched(data, *requests):
    """A flood on a line while a monitor session of the same client has made these requests, and reads."""
    def load(target):
        session = target.ask(*requests)
        clients = [(target.line, data), (lambda: session, PING)]
        target.flood_each(clients)
    return load


def stepped(data, count=1):
    """Floods on lines while a monitor session makes one step of time after another."""
    def load(target):
        clients = [(target.line, data)] * count + [(target.page, STEP)]
        target.flood_each(clients)
    return load


def many_steps(target):
    """A flood beside many monitor sessions, each of which makes one step of time after another. The flood is a process
    of its own, since the answers would delay it."""
    if os.fork() == 0:
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        line = target.line()
        while True:
            line.sendall(MOVES * 1000)
    sessions = [target.tell(STEP) for _ in range(STEPPERS)]
    target.ready()
    while True:
        for sock in select.select(sessions, [], [])[0]:
            sock.recv(MOST_AT_ONCE)
            sock.sendall(STEP)


STEP = call("step", ticks=1, fields=[])
PATH = call("key", function="path")
DISPLAY = json_line("sub", channel="display", max_hz=60)
STATE = json_line("sub", channel="state", max_hz=60)
IMAGE = json_line("sub", channel="image", max_hz=60)
EVENT = json_line("sub", channel="event")

ATTACKS = [
    *beside("nothing", lambda target: target.hold(), SHIPPED, LARGEST),  # for comparison
    *beside("lines.images", flood(b"A**\n"), SHIPPED, HUNDRED, LARGEST),
    *beside("lines.images-unread", flood(b"A**", reads=False), SHIPPED, LARGEST),
    *beside("lines.pixels-unread", flood(b"A*0,0*", reads=False), SHIPPED, LARGEST),
    *beside("lines.rows", flood(ROWS), SHIPPED, LARGEST),
    *beside("lines.moves", flood(MOVES + b"A**"), SHIPPED, LARGEST),
    *beside("lines.inquiries", flood(b"E?" + b"?" * 100), SHIPPED),
    *beside("lines.homes", flood(b"A$A**"), SHIPPED, LARGEST),
    *beside("lines.path", watched(b"A|" + MOVES, DISPLAY), SHIPPED, clock="real:1000"),
    *beside("lines.long-path", watched(MOVES, PATH, DISPLAY), SHIPPED, clock="real:100000"),
    *beside("lines.watched", watched(MOVES + b"A$", STATE, IMAGE, DISPLAY, EVENT), SHIPPED, LARGEST),
    *beside("lines.moves-fast", flood(b"A255SB255SC255SD255SE255SF255S" + MOVES), SHIPPED, clock="real:100000"),
    *beside("lines.stepped", stepped(MOVES), SHIPPED, LARGEST, clock="manual"),
    *beside("lines.stepped-images", stepped(b"A**"), SHIPPED, LARGEST, clock="manual"),
    *crowd("lines.stepped-crowd", stepped(MOVES, MANY_LINES), clock="manual"),
    *beside("lines.many-steps", many_steps, SHIPPED, clock="manual"),
    *beside("lines.many-steps-pings", many_steps, SHIPPED, clock="manual", victim="session", own_bound=PING_MS),
    *beside("lines.steps", flood(MOVES), SHIPPED, clock="manual", victim="step", own_bound=STEP_MS),
    *beside("lines.steps-images", flood(b"A**"), SHIPPED, LARGEST, clock="manual", victim="step", own_bound=STEP_MS),
    *beside("lines.steps-garbage", flood(GARBAGE), SHIPPED, clock="manual", victim="step", own_bound=STEP_MS),
    *beside("lines.steps-crowd", lambda target: target.flood(target.line, MOVES, count=MANY_LINES), SHIPPED,
            clock="manual", victim="step", own_bound=CROWDED_STEP_MS),
    *beside("lines.garbage", flood(GARBAGE, reads=False), SHIPPED),
    *beside("lines.warnings-fast", flood(b"zE+500\r"), SHIPPED, clock="real:100000"),
    *beside("lines.telnet", flood(TELNET), SHIPPED),
    *beside("lines.telnet-unread", flood(TELNET, reads=False), SHIPPED),
    *beside("lines.com-port", flood(COM_PORT), SHIPPED),
    *beside("lines.com-port-unread", flood(COM_PORT, reads=False), SHIPPED),
    *beside("lines.suspended", flood(SUSPENDED), SHIPPED),
    *beside("lines.negotiation", flood(NEGOTIATION), SHIPPED),
    *crowd("lines.trickle", trickle(b"\r")),
    *crowd("lines.trickle-inquiries", trickle(b"E?")),
    *crowd("lines.trickle-images", trickle(b"A**")),
    *beside("lines.storm", storm(b"E?"), SHIPPED),
    *beside("lines.storm-held", storm(b"GET"), SHIPPED),
    *beside("lines.storm-strangers", storm(b"GET / HTTP/1.1\r\n"), SHIPPED),
    *crowd("lines.bursts", lambda target: target.bursts(target.robot_port, b"E?")),
    *crowd("lines.refused", lambda target: target.flood(target.untried_line, b"A**", count=MANY_LINES)),
    *beside("lines.many-images", lambda target: target.flood(target.line, b"A**", count=MANY_LINES), SHIPPED, LARGEST),
]
