"""Loads on the robot port."""

import ctypes
import itertools
import os
import select
import signal
import socket

from attack import Beside
from cells import HEAPED, MOST_PIXELS
from target import MOST_AT_ONCE, PING, call, json_line

MANY_LINES = 60  # the default limit is 64
STEPPERS = 16
PR_SET_PDEATHSIG = 1
SMALL_BUFFER = 4096
STEP_MS, CROWDED_STEP_MS = 250, 1500
MOVES = b"".join(b"%c%+d\r" % (label, sign) for label in b"ABCDEF" for sign in (1, -1))
ROWS = b"".join(b"A*%d*A*%d,7*" % (row, row) for row in range(MOST_PIXELS))
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


def crowd(data):
    return lambda target: target.flood(target.line, data, count=MANY_LINES)


def stepped(data, count=1):
    """Floods on lines while a monitor session makes one step of time after another."""
    return lambda target: target.flood_each([(target.line, data)] * count + [(target.page, STEP)])


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
    Beside("nothing", lambda target: target.hold()),  # for comparison
    Beside("lines.images", flood(b"A**\n")),
    Beside("lines.images-heaped", flood(b"A**\n"), HEAPED),
    Beside("lines.images-unread", flood(b"A**", reads=False)),
    Beside("lines.pixels-unread", flood(b"A*0,0*", reads=False)),
    Beside("lines.rows", flood(ROWS)),
    Beside("lines.rows-heaped", flood(ROWS), HEAPED),
    Beside("lines.moves", flood(MOVES + b"A**")),
    Beside("lines.inquiries", flood(b"E?" + b"?" * 100)),
    Beside("lines.homes", flood(b"A$A**")),
    Beside("lines.path", watched(b"A|" + MOVES, DISPLAY), clock="real:1000"),
    Beside("lines.long-path", watched(MOVES, PATH, DISPLAY), clock="real:100000"),
    Beside("lines.watched", watched(MOVES + b"A$", STATE, IMAGE, DISPLAY, EVENT)),
    Beside("lines.moves-fast", flood(b"A255SB255SC255SD255SE255SF255S" + MOVES), clock="real:100000"),
    Beside("lines.stepped", stepped(MOVES), clock="manual"),
    Beside("lines.stepped-images", stepped(b"A**"), clock="manual"),
    Beside("lines.stepped-crowd", stepped(MOVES, MANY_LINES), clock="manual"),
    Beside("lines.many-steps", many_steps, clock="manual"),
    Beside("lines.many-steps-pings", many_steps, clock="manual", victim="session"),
    Beside("lines.steps", flood(MOVES), clock="manual", victim="step", bound=STEP_MS),
    Beside("lines.steps-images", flood(b"A**"), clock="manual", victim="step", bound=STEP_MS),
    Beside("lines.steps-garbage", flood(GARBAGE), clock="manual", victim="step", bound=STEP_MS),
    Beside("lines.steps-crowd", crowd(MOVES), clock="manual", victim="step", bound=CROWDED_STEP_MS),
    Beside("lines.garbage", flood(GARBAGE, reads=False)),
    Beside("lines.warnings-fast", flood(b"zE+500\r"), clock="real:100000"),
    Beside("lines.telnet", flood(TELNET)),
    Beside("lines.telnet-unread", flood(TELNET, reads=False)),
    Beside("lines.com-port", flood(COM_PORT)),
    Beside("lines.com-port-unread", flood(COM_PORT, reads=False)),
    Beside("lines.suspended", flood(SUSPENDED)),
    Beside("lines.negotiation", flood(NEGOTIATION)),
    Beside("lines.trickle-inquiries", trickle(b"E?")),
    Beside("lines.trickle-images", trickle(b"A**")),
    Beside("lines.storm", storm(b"E?")),
    Beside("lines.storm-held", storm(b"GET")),
    Beside("lines.storm-strangers", storm(b"GET / HTTP/1.1\r\n")),
    Beside("lines.bursts", lambda target: target.bursts(target.robot_port, b"E?", MANY_LINES)),
    Beside("lines.refused", lambda target: target.flood(target.untried_line, b"A**", count=MANY_LINES)),
    Beside("lines.many-images", crowd(b"A**")),
]
