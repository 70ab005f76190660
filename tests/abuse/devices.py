"""Loads on the way to a physical controller (`--serial`): lines that flood it, and a device that floods, is slow, does
not answer, or comes and goes. The load plays the device."""

import dataclasses
import json
import os
import select
import threading
import time
import typing

from attack import LATE_MS, Alone, Beside, Measured, load_process
from lines import GARBAGE, MOVES
from logs import Logged
from memory import peak_mib, settle
from serial_ports import Device, OwnDevice, plug_in
from support import DEADLINE_S, Server
from target import json_line
from victim import processor_clock, quantiles

LINES = 4
MOST_READ = 1 << 16
SLOW_BYTES, SLOW_S = 10, 0.01  # about 9600 baud
SWITCH = b"A@"
INQUIRIES = b"E?F?D?C?"
NOT_FOR_IT = bytes(range(128, 255)) + b"ETA.6.A$"
LOADED_S = 2.0
STOP = b"AXBXCXDXEXFXGXHX"


# --- The device.


def play(target, handle):
    """A thread that handles what arrives at the device's end, piece by piece."""
    def run():
        while True:
            handle(os.read(target.device, MOST_READ))
    threading.Thread(target=run, daemon=True).start()


def drain(target):
    play(target, lambda data: None)


def answer(target):
    play(target, lambda data: os.write(target.device, b" " * data.count(b"?")))


def answer_late(target):
    """About 9600 baud in both directions."""
    def run():
        while True:
            data = os.read(target.device, SLOW_BYTES)
            select.select([], [], [], SLOW_S)
            os.write(target.device, b" " * data.count(b"?"))
    threading.Thread(target=run, daemon=True).start()


def read_nothing(_):
    pass


def come_and_go(target):
    """The device vanishes as soon as the first bytes have arrived, and sends some of its own before."""
    def run():
        while True:
            os.read(target.device, 1)
            os.write(target.device, b"E?" * 100)
            os.close(target.device)
            target.device, slave = plug_in(target.path)
            select.select([target.device], [], [], DEADLINE_S)
            os.close(slave)
    threading.Thread(target=run, daemon=True).start()


# --- The lines.


def engage(target):
    """Disables the simulator, so that the commands of the lines go to the device."""
    target.line().sendall(SWITCH)
    with target.page() as sock, sock.makefile("rb") as messages:
        enabled = True
        while enabled:
            sock.sendall(json_line("get", channel="state", fields=["enabled"]))
            enabled = json.loads(messages.readline()).get("enabled", True)


def flood(data, device=drain, count=LINES):
    def load(target):
        device(target)
        engage(target)
        target.flood(target.line, data, count)
    return load


def flood_unasked(target):
    """The device sends as fast as the server reads, while the simulator is enabled."""
    while True:
        os.write(target.device, GARBAGE[:MOST_READ])
        target.ready()


def flood_unasked_and_asked(target):
    """The device sends as fast as the server reads, while lines ask it."""
    drain(target)
    engage(target)
    threading.Thread(target=target.flood, args=(target.line, INQUIRIES, LINES), daemon=True).start()
    flood_unasked(target)


# --- Measurements.


@dataclasses.dataclass(frozen=True)
class Grown(Alone):
    """The growth of the peak of memory under a load, in MiB."""
    name: str
    load: typing.Callable
    options: tuple = ()
    bound: float = 4
    unit: str = "MiB"

    def measure(self):
        with Device() as port, Server("--log-level", "warn", *port.options, *self.options, clock="real") as xr3:
            settle(xr3)
            before = peak_mib(xr3)
            with load_process(self.name, xr3, port):
                select.select([], [], [], LOADED_S)
                return Measured(peak_mib(xr3) - before, f"{before:.0f} MiB before")


@dataclasses.dataclass(frozen=True)
class Stopped(Alone):
    """The processor time of the server's event loop from the call device_stop to the arrival of its bytes at the device,
    which 99 of 100 calls keep, while lines flood the device. This process reads the device's end, so that the load's
    device must be read_nothing()."""
    name: str
    load: typing.Callable
    stops: int = 200
    bound: float = LATE_MS
    unit: str = "ms"
    rounds = 5

    def measure(self):
        with OwnDevice() as device, Server("--log-level", "warn", *device.options, clock="real") as xr3, \
                xr3.monitor() as monitor, load_process(self.name, xr3, device):
            worked = processor_clock(xr3.pid)
            work, waits = map(quantiles, zip(*(stop_ns(monitor, device.end, worked) for _ in range(self.stops))))
        return Measured(work["p99"], f"max {work['max']:.1f}; by the wall clock p50 {waits['p50']:.2f}, p99 "
                                     f"{waits['p99']:.1f}, max {waits['max']:.1f}")


def stop_ns(monitor, end, worked):
    """The server's processor time for one stop, amid bytes of the lines, and the wall time until its effect."""
    read_end(end)
    started, before = time.monotonic_ns(), worked()
    monitor.send(json_line("call", id=1, fn="device_stop", args={}))
    seen = b""
    while STOP not in seen:
        seen = seen[-len(STOP):] + read_end(end)
    took, work = time.monotonic_ns() - started, worked() - before
    if not monitor.read()["ok"]:
        raise AssertionError("device_stop is refused")
    return work, took


def read_end(end):
    if not select.select([end], [], [], DEADLINE_S)[0]:
        raise AssertionError("nothing arrives at the device")
    return os.read(end, MOST_READ)


def beside(name, load, **more):
    """The victim pings the monitor port, since the inquiries of a line go to the device."""
    return Beside(f"device.{name}", load, port=Device, **{"victim": "session", **more})


ATTACKS = [
    beside("unasked", flood_unasked, victim="line"),
    beside("unasked-and-asked", flood_unasked_and_asked),
    beside("moves", flood(MOVES)),
    beside("moves-mirrored", flood(MOVES, answer), options=("--mirror",)),
    beside("moves-unread", flood(MOVES, read_nothing)),
    beside("inquiries", flood(INQUIRIES, answer)),
    beside("inquiries-late", flood(INQUIRIES + MOVES, answer_late)),
    beside("inquiries-unanswered", flood(INQUIRIES + MOVES)),
    beside("garbage", flood(GARBAGE.replace(b"@", b"z"), answer, count=1)),
    beside("not-for-it", flood(NOT_FOR_IT, count=1)),
    beside("switches", flood(b"E+5F?" + SWITCH, answer, count=1)),
    beside("comes-and-goes", flood(MOVES, come_and_go)),
    Stopped("device.stop", flood(MOVES, read_nothing)),
    Stopped("device.stop-unanswered", flood(MOVES + INQUIRIES, read_nothing), stops=5),
    Grown("memory.device-unasked", flood_unasked),
    Grown("memory.device-moves", flood(MOVES)),
    Grown("memory.device-unread", flood(MOVES, read_nothing)),
    Grown("memory.device-unanswered", flood(INQUIRIES + MOVES)),
    Grown("memory.device-mirrored", flood(MOVES, answer), options=("--mirror",)),
    Logged("log.device-unasked", flood_unasked, port=Device),
    Logged("log.device-unanswered", flood(INQUIRIES + MOVES), port=Device),
    Logged("log.device-not-for-it", flood(NOT_FOR_IT), port=Device),
    Logged("log.device-switches", flood(b"E+5F?" + SWITCH, answer), port=Device),
    Logged("log.device-comes-and-goes", flood(MOVES, come_and_go), port=Device),
]
