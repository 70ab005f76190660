"""Loads on a pseudo-terminal of the server."""

import contextlib
import os
import select
import termios

from attack import MIB, Attack, Beside, Measured, busy_share
from lines import GARBAGE, MOVES, STEP_MS
from logs import Logged
from memory import peak_mib, settle
from serial_ports import Pty, TwoPtys
from support import DEADLINE_S, Server

CYCLES = 3000
PORTS = 16
TURNS = 5  # rounds of filling the ports, since the server reads meanwhile
PAUSE_S = 0.2
MOST_READ = 1 << 16
LOCAL_MODES = 3  # in the list of tcgetattr
COOKED = termios.ECHO | termios.ICANON


def opened(path):
    return os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)


def write_some(port, data):
    """Writes as much as there is room for; returns the rest."""
    with contextlib.suppress(BlockingIOError):
        return data[os.write(port, data):]
    return data


def read_some(port):
    with contextlib.suppress(BlockingIOError):
        os.read(port, MOST_READ)


def flood(data, reads=True):
    """A program that writes the data again and again as fast as the server takes it."""
    def load(target):
        port, rest = opened(target.path), data
        while True:
            select.select([port] if reads else [], [port], [])
            rest = write_some(port, rest) or data
            if reads:
                read_some(port)
            target.ready()
    return load


def storm(data):
    """Programs that open the port, write and leave, one after the other."""
    def load(target):
        while True:
            port = opened(target.path)
            write_some(port, data)
            os.close(port)
            target.ready()
    return load


def toggle(target):
    """A program that lets the terminal edit lines and echo, and then does not, again and again, while it asks."""
    port = opened(target.path)
    modes = termios.tcgetattr(port)
    while True:
        modes[LOCAL_MODES] ^= COOKED
        termios.tcsetattr(port, termios.TCSANOW, modes)
        write_some(port, b"zE?\n")
        read_some(port)
        target.ready()


def cook_each_line(target):
    """Each program is a line of its own, so that each is warned of its echo."""
    while True:
        port = opened(target.path)
        modes = termios.tcgetattr(port)
        modes[LOCAL_MODES] |= COOKED
        termios.tcsetattr(port, termios.TCSANOW, modes)
        write_some(port, b"zE?\n")
        os.close(port)
        target.ready()


def unanswered():
    """Programs that begin one after the other and ask at once: the number of those that get no reply."""
    missed = 0
    with Pty() as place, Server("--log-level", "warn", *place.options, clock="real") as xr3:
        for _ in range(CYCLES):
            port = os.open(xr3.ptys[0], os.O_RDWR | os.O_NOCTTY)
            os.write(port, b"E?")
            missed += not select.select([port], [], [], DEADLINE_S)[0] or os.read(port, 8) != b" "
            os.close(port)
    return Measured(missed, f"of {CYCLES}")


def left_open():
    """The descriptors and lines that remain after programs which came and went."""
    with Pty() as place, Server("--log-level", "warn", *place.options, clock="real") as xr3, xr3.monitor() as monitor:
        count = lambda: len(os.listdir(f"/proc/{xr3.pid}/fd"))
        before = count()
        for number in range(CYCLES):
            port = os.open(xr3.ptys[0], os.O_RDWR | os.O_NOCTTY)
            os.write(port, (b"", b"E?", b"E+5", b"\xff" * 100)[number % 4])
            os.close(port)
        settle(xr3)
        return Measured(abs(count() - before) + len(monitor.call("lines")["lines"]), f"after {CYCLES} programs")


def idle_share(data):
    """The processor time that a program costs which has written as much as is taken, and reads nothing."""
    def measure():
        with Pty() as place, Server("--log-level", "warn", *place.options, clock="real") as xr3:
            program = opened(xr3.ptys[0])
            fill([program], data)
            select.select([], [], [], 1.0)  # for what the server has to do first
            return Measured(busy_share(xr3), "after a second of its own")
    return measure


def left_unread():
    """The processor time after a program has left that had read none of its replies."""
    with Pty() as place, Server("--log-level", "warn", *place.options, clock="real") as xr3:
        program = opened(xr3.ptys[0])
        fill([program], b"E?")
        os.close(program)
        settle(xr3)
        return Measured(busy_share(xr3))


def greedy(data):
    """The peak of memory for each of several ports whose programs write what is taken, and read nothing."""
    def measure():
        with contextlib.ExitStack() as stack:
            places = [stack.enter_context(Pty()) for _ in range(PORTS)]
            options = [option for place in places for option in place.options]
            xr3 = stack.enter_context(Server("--log-level", "warn", *options, clock="real"))
            programs = [opened(path) for path in xr3.ptys]
            for program in programs:
                stack.callback(os.close, program)
            fill(programs[:1], data)  # allocates what all ports share
            before = peak_mib(xr3)
            fill(programs[1:], data)
            settle(xr3)
            return Measured((peak_mib(xr3) - before) / (PORTS - 1), f"{before:.0f} MiB before")
    return measure


def fill(programs, data):
    """Each program writes as much as the server takes."""
    for _ in range(TURNS):
        for program in programs:
            rest = data * (MIB // len(data))
            while rest and len(rest) != len(rest := write_some(program, rest)):
                pass
        select.select([], [], [], PAUSE_S)


def beside(name, load, **more):
    return Beside(f"pty.{name}", load, **{"port": Pty, **more})


def steps_beside(name, load):
    """Steps of time wait for all pseudo-terminals."""
    return beside(f"{name}-steps", load, victim="step", clock="manual", bound=STEP_MS)


ATTACKS = [
    beside("garbage", flood(GARBAGE)),
    beside("garbage-unread", flood(GARBAGE, reads=False)),
    beside("inquiries", flood(b"E?" * 1000)),
    beside("inquiries-other-pty", flood(b"E?" * 1000), port=TwoPtys, victim="pty"),
    steps_beside("inquiries", flood(b"E?" * 1000)),
    beside("inquiries-unread", flood(b"E?" * 1000, reads=False)),
    beside("images-unread", flood(b"A**" * 100, reads=False)),
    beside("moves", flood(MOVES + b"A**")),
    beside("storm", storm(b"E?")),
    steps_beside("storm", storm(b"E?")),
    beside("storm-half", storm(b"E+5")),
    beside("toggles", toggle),
    beside("cooked", cook_each_line),
    Attack("pty.unread-inquiries", 5, "% of a core", idle_share(b"E?")),
    Attack("pty.unread-images", 5, "% of a core", idle_share(b"A**")),
    Attack("pty.unread-left", 5, "% of a core", left_unread),
    Attack("pty.turns", 0, "unanswered", unanswered),
    Attack("pty.left-open", 0, "left", left_open),
    Attack("memory.pty-images", 1, "MiB each", greedy(b"A**")),
    Attack("memory.pty-inquiries", 1, "MiB each", greedy(b"E?")),
    Attack("memory.pty-garbage", 1, "MiB each", greedy(GARBAGE)),
    Logged("log.pty-storm", storm(b"E?"), port=Pty),
    Logged("log.pty-garbage", flood(GARBAGE, reads=False), clock="real:100000", port=Pty),
    Logged("log.pty-cooked", cook_each_line, port=Pty),
]
