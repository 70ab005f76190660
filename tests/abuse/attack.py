"""Attacks, each with a bound and with rounds, each of which measures anew. The attack of an `Attack` runs in this
process, and each of its rounds has a server of its own; that of a `Beside` runs in a process of its own, while a
well-behaved client measures, and its rounds follow each other on one server, under the same load."""

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

from cells import BOUND_MS, SHIPPED, Cell
from serial_ports import NoPort
from support import DEADLINE_S, SHUTDOWN_S, Server
from target import LOCALHOST
from victim import process_clock

FOLDER = pathlib.Path(__file__).parent
MEASURED_S = {"line": 1.0, "pty": 1.0, "session": 2.0, "step": 2.0}  # a thousand inquiries, four hundred pings
MOST_WAIT_S = 90  # more than the patience of the victim
CROWD_MS = 40
NEIGHBOUR = "127.0.0.2"
MIB = 1 << 20


@dataclasses.dataclass(frozen=True)
class Measured:
    """The figure that a bound limits, others for the reader, the least that it would be on an idle machine, and the
    figure of a bystander, which the server does not concern, or what the server itself had to wait for a core."""
    value: float
    note: str = ""
    least: float | None = None
    bystander: float = 0

    def is_disturbed(self, bound):
        """The bound is exceeded, and the machine was busy with something else."""
        return self.value > bound and self.bystander > bound / 2


class Repeated:
    """An attack that begins again for each round."""

    def in_force(self):
        """A context manager for a function that measures a round."""
        return contextlib.nullcontext(self.measure)


@dataclasses.dataclass(frozen=True)
class Attack(Repeated):
    """`measure()` returns a Measured; its value may be at most `bound`."""
    name: str
    bound: float
    unit: str
    measure: typing.Callable


@dataclasses.dataclass(frozen=True)
class Beside:
    """The wait that 99 of 100 replies of another line keep, beside a load. The load goes on when SIGTERM stops the
    server after the last round, which must take at most two seconds. `port`: a serial port of the server. `victim`:
    `line`, or `pty` for a line on the last pseudo-terminal of the server, or `session` for pings on the monitor port,
    where the inquiries of a line go to a device, or `step` for steps of time. `address`: that of the other line.
    `own_bound`: instead of the usual one."""
    name: str
    load: typing.Callable
    cell: str = SHIPPED
    clock: str = "real"
    options: tuple = ()
    unit: str = "ms"
    port: typing.Callable = NoPort
    victim: str = "line"
    address: str = LOCALHOST
    own_bound: float | None = None

    @property
    def bound(self):
        if self.own_bound is not None:
            return self.own_bound
        return BOUND_MS[self.cell]

    @contextlib.contextmanager
    def in_force(self):
        """Server, load and victim; then SIGTERM under the load. What must start is started before the load begins."""
        with Cell(self.cell) as options, self.port() as port, \
                Server(*options, *port.options, *self.options, clock=self.clock) as xr3:
            with victim_process(xr3, self.victim, self.address) as victim, load_process(self.name, xr3, port) as load:
                yield lambda: measured_beside(xr3, victim, load)
                code = xr3.stop(within_s=SHUTDOWN_S)
            if code != 0:
                raise AssertionError(f"the server ended with {code}")


def measured_beside(xr3, victim, load):
    """A round."""
    before, started = cpu_s(xr3.pid), time.monotonic()
    figures = ask(victim)
    if load.poll() is not None:
        raise AssertionError(f"the load has ended: {last_line(load)}")
    busy = (cpu_s(xr3.pid) - before) / (time.monotonic() - started)
    peak = xr3.status("VmHWM") / 1024
    waits, work, bystander = figures["waits"], figures["work"], figures["bystander"]
    return Measured(waits["p99"], f"p50 {waits['p50']:.2f}, max {waits['max']:.1f}; the server's work p99 "
                                  f"{work['p99']:.2f}, max {work['max']:.1f}; a bystander's "
                                  f"{bystander['p99']:.2f}, max {bystander['max']:.1f}; {busy:.0%} of a core, "
                                  f"{peak:.0f} MiB",
                    work["p99"], bystander["p99"])


def beside(name, load, *cells, **more):
    """An attack for each of these workcells."""
    return [Beside(f"{name}/{cell}", load, cell, **more) for cell in cells or (SHIPPED,)]


def crowd(name, load, **more):
    """The attack of many connections that are busy at once, each as light as the other line. If this comes from another
    address, it takes turns with all of them together. If not, it waits for its turn among them."""
    return [Beside(f"{name}/neighbour", load, address=NEIGHBOUR, **more),
            Beside(f"{name}/same-address", load, own_bound=CROWD_MS, **more)]


def cpu_s(pid):
    """Seconds of processor time that a process has used."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def measure_once(attack):
    """The Measured of one round."""
    with attack.in_force() as measure:
        return measure()


def waited_s(pid):
    """Seconds for which the main thread of a process could have worked, and had to wait for a core."""
    try:
        return int(pathlib.Path(f"/proc/{pid}/schedstat").read_text(encoding="ascii").split()[1]) / 1e9
    except FileNotFoundError:  # a kernel that does not count
        return 0.0


def busy_share(xr3):
    """The percentage of a core that all threads of the server need for a second."""
    worked, started = process_clock(xr3.pid), time.monotonic_ns()
    before = worked()
    select.select([], [], [], 1.0)
    return 100 * (worked() - before) / (time.monotonic_ns() - started)


@contextlib.contextmanager
def victim_process(xr3, kind="line", address=LOCALHOST):
    """The well-behaved client, which measures whenever it is asked to, until the end of the block."""
    ports = {"line": xr3.robot_port, "pty": xr3.ptys[-1] if xr3.ptys else None}
    arguments = map(str, (ports.get(kind, xr3.monitor_port), xr3.pid, MEASURED_S[kind], kind, address))
    bystander = ["pty"] if kind == "pty" or (kind == "step" and xr3.ptys) else []
    process = subprocess.Popen([sys.executable, FOLDER / "victim.py", *arguments, *bystander],
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    with process:
        try:
            yield process
        finally:
            process.stdin.close()  # it ends its bystanders


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
