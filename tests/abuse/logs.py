"""The log: at most a megabyte a second, whatever clients do, and also in a file."""

import contextlib
import dataclasses
import pathlib
import select
import tempfile
import time
import typing

import http_requests
import json_requests
import lines
from attack import Measured, load_process
from serial_ports import NoPort
from support import Server
from target import call

MEASURED_S = 1.0
MEGABYTE = 1_000_000


@dataclasses.dataclass(frozen=True)
class Logged:
    """The megabytes that a load makes the server log in a second."""
    name: str
    load: typing.Callable
    clock: str = "real"
    options: tuple = ()
    bound: float = 1.0
    unit: str = "MB/s"
    port: typing.Callable = NoPort
    rounds = 1

    @contextlib.contextmanager
    def in_force(self):
        with tempfile.TemporaryDirectory() as folder, self.port() as port:
            path = pathlib.Path(folder, "xr3.log")
            with Server("--log-file", path, *port.options, *self.options, clock=self.clock) as xr3, \
                    load_process(self.name, xr3, port):
                yield lambda: logged(folder)


def logged(folder):
    """A round."""
    before, started = written(folder), time.monotonic()
    select.select([], [], [], MEASURED_S)
    kept, took_s = written(folder), time.monotonic() - started
    return Measured((kept - before) / MEGABYTE / took_s, f"{kept / MEGABYTE:.1f} MB kept")


def written(folder):
    """The bytes of the log and of its older parts."""
    return sum(path.stat().st_size for path in pathlib.Path(folder).iterdir())


def long_names(target):
    """Names of 40 control characters, each of which is logged as four."""
    name = "\x01" * 40
    target.flood(target.ask, call("block_add", name=name, size_mm=[9, 9, 9], xyz_mm=[300, 0, 5], color=1)
                 + call("block_remove", name=name))


TRACE = ("--log-level", "trace")

ATTACKS = [
    Logged("log.storm", lines.storm(b"E?")),
    Logged("log.strangers", lines.storm(b"GET / HTTP/1.1\r\n")),
    Logged("log.warnings-fast", lines.flood(b"zE+500\r"), clock="real:100000"),
    Logged("log.garbage-fast", lines.flood(lines.GARBAGE, reads=False), clock="real:100000"),
    Logged("log.garbage-trace", lines.flood(lines.GARBAGE, reads=False), clock="real:100000", options=TRACE),
    Logged("log.moves-trace", lines.flood(lines.MOVES), clock="real:100000", options=TRACE),
    Logged("log.names", long_names),
    Logged("log.epochs", json_requests.flood(call("reset"))),
    Logged("log.tls", http_requests.storm(bytes.fromhex("16030100c8010000c40303"))),
    Logged("log.http", http_requests.storm(b"GET / HTTP/1.1\r\nHost: \x1b[31m\r\n\r\n")),
    Logged("log.wrong-tokens", json_requests.wrong_tokens, options=("--token", "auto")),
]
