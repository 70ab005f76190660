"""Attacks, each with a bound. The attack of an `Attack` runs in this process, on a server of its own; that of a
`Beside` runs in a process of its own, while a well-behaved client measures, and its rounds follow each other on one
server, under the same load."""

import contextlib
import dataclasses
import json
import os
import pathlib
import select
import subprocess
import sys
import time
import typing

from cells import LARGEST, Cell
from serial_ports import NoPort
from support import DEADLINE_S, Server

FOLDER = pathlib.Path(__file__).parent
LATE_MS = 20  # see SECURITY.md
STOP_S = 1.0
MEASURED_S = 0.5  # a round: five hundred inquiries, a hundred pings
MOST_WAIT_S = 90  # more than the patience of the victim
MIB = 1 << 20


@dataclasses.dataclass(frozen=True)
class Measured:
    """The figure that a bound limits, and others for the reader."""
    value: float
    note: str = ""


class Alone:
    """An attack that begins anew for each round."""

    rounds = 1

    def in_force(self):
        """A context manager for a function that measures a round."""
        return contextlib.nullcontext(self.measure)


@dataclasses.dataclass(frozen=True)
class Attack(Alone):
    """`measure()` returns a Measured; its value may be at most `bound`."""
    name: str
    bound: float
    unit: str
    measure: typing.Callable


@dataclasses.dataclass(frozen=True)
class Beside:
    """The processor time of the server's event loop between an inquiry of another line and its reply, which 99 of 100
    keep beside a load. The load goes on when SIGTERM stops the server after the last round. `port`: a serial port of
    the server. `victim`: `line`, or `pty` for a line on the last pseudo-terminal of the server, or `session` for pings
    on the monitor port, where the inquiries of a line go to a device, or `step` for steps of time."""
    name: str
    load: typing.Callable
    cell: str = LARGEST
    clock: str = "real"
    options: tuple = ()
    port: typing.Callable = NoPort
    victim: str = "line"
    bound: float = LATE_MS
    unit: str = "ms"
    rounds = 5

    @contextlib.contextmanager
    def in_force(self):
        """Server, load and victim; then SIGTERM under the load. What must start is started before the load begins."""
        with Cell(self.cell) as options, self.port() as port, \
                Server(*options, *port.options, *self.options, clock=self.clock) as xr3:
            with victim_process(xr3, self.victim) as victim, load_process(self.name, xr3, port) as load:
                yield lambda: measured_beside(xr3, victim, load)
                end = stopped(xr3)
            if end.value > STOP_S:
                raise AssertionError(f"the server worked {end.value:.2f} s after SIGTERM; {end.note}")


def measured_beside(xr3, victim, load):
    """A round."""
    before, started = cpu_s(xr3.pid), time.monotonic()
    figures = ask(victim)
    if load.poll() is not None:
        raise AssertionError(f"the load has ended: {last_line(load)}")
    busy = (cpu_s(xr3.pid) - before) / (time.monotonic() - started)
    peak = xr3.status("VmHWM") / 1024
    waits, work = figures["waits"], figures["work"]
    return Measured(work["p99"], f"max {work['max']:.1f}; by the wall clock p50 {waits['p50']:.2f}, p99 "
                                 f"{waits['p99']:.1f}, max {waits['max']:.1f}; {busy:.0%} of a core, {peak:.0f} MiB")


def stopped(xr3):
    """Sends SIGTERM. The processor time until the server has ended: with the second in which it waits for the last
    replies to be read, it may take two."""
    with open(os.pidfd_open(xr3.pid), "rb") as ended:
        started, before = time.monotonic(), cpu_s(xr3.pid)
        xr3.process.terminate()
        if not select.select([ended], [], [], DEADLINE_S)[0]:
            xr3.process.kill()
        took_s, worked_s = time.monotonic() - started, cpu_s(xr3.pid) - before
    code = xr3.process.wait()
    if code != 0:
        raise AssertionError(f"the server ended with {code} after {took_s:.1f} s")
    return Measured(worked_s, f"by the wall clock {took_s:.2f}")


def cpu_s(pid):
    """Seconds of processor time that a process has used."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def busy_share(xr3):
    """The percentage of a core that all threads of the server need for a second."""
    before, started = cpu_s(xr3.pid), time.monotonic()
    select.select([], [], [], 1.0)
    return 100 * (cpu_s(xr3.pid) - before) / (time.monotonic() - started)


@contextlib.contextmanager
def victim_process(xr3, kind="line"):
    """The well-behaved client, which measures whenever it is asked to, until the end of the block."""
    ports = {"line": xr3.robot_port, "pty": xr3.ptys[-1] if xr3.ptys else None}
    arguments = map(str, (ports.get(kind, xr3.monitor_port), xr3.pid, MEASURED_S, kind))
    process = subprocess.Popen([sys.executable, FOLDER / "victim.py", *arguments],
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    with process:
        try:
            yield process
        finally:
            process.stdin.close()  # ends the victim


def ask(victim):
    """The figures of a round."""
    victim.stdin.write(b"\n")
    victim.stdin.flush()
    if not select.select([victim.stdout], [], [], MOST_WAIT_S)[0]:
        victim.kill()
        raise AssertionError("the well-behaved client is not served")
    figures = victim.stdout.readline()
    if not figures:
        raise AssertionError(f"the well-behaved client has ended: {last_line(victim)}")
    return json.loads(figures)


def last_line(process):
    return process.stderr.read().decode().strip().rpartition("\n")[2]


@contextlib.contextmanager
def load_process(name, xr3, port=NoPort()):
    """Runs the load of an attack until the end of the block."""
    arguments = map(str, (name, xr3.robot_port, xr3.monitor_port, *port.arguments))
    process = subprocess.Popen([sys.executable, FOLDER / "load.py", *arguments], pass_fds=port.descriptors,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    port.hand_over()
    with process:
        try:
            if not select.select([process.stdout], [], [], 3 * DEADLINE_S)[0] or not process.stdout.readline():
                process.kill()
                raise AssertionError(f"the load did not begin: {last_line(process)}")
            yield process
        finally:
            process.kill()
