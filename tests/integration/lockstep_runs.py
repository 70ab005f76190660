"""A robot program and a monitor client in lockstep: the same hundred steps give the same states on a busy
machine, even if the network delays the program's bytes. Used by test_lockstep_runs.py and, with more runs,
by soak_lockstep.py."""

import contextlib
import hashlib
import json
import os
import random
import subprocess
import sys

from proxy import Proxy
from support import Line, Server, connect, machine

STEPS = 100
DELAY_S = 0.050


@contextlib.contextmanager
def full_load():
    """One busy process per processor."""
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count())]
    try:
        yield
    finally:
        for process in busy:
            process.kill()
            process.wait()


def commands(seed=1989):
    """(data, ticks) of each step: the bytes that the program writes before it, and its length."""
    chance = random.Random(seed)
    for _ in range(STEPS):
        moves = [f"{chance.choice('FEDCBA')}{chance.randint(-20, 20):+d}\r" for _ in range(chance.randint(1, 3))]
        yield "".join(moves) + chance.choice(["", "E?", "I", "LM", "P2R2", "EX"]), chance.randint(1, 150)


def run(line, monitor, with_after):
    """One run after a reset; returns the hash of its states."""
    digest = hashlib.sha256()
    for data, ticks in commands():
        line.send(data)
        state = monitor.step(ticks, after=line if with_after else None)
        digest.update(json.dumps(machine(state), sort_keys=True).encode())
    return digest.hexdigest()


def runs(count):
    """The hashes of `count` runs on one server, each after a reset."""
    with Server("--log-level", "warn") as xr3, xr3.monitor() as monitor:
        return [fresh_run(xr3.robot_port, monitor, number, with_after=False) for number in range(1, count + 1)]


def delayed_runs(count):
    """Compares runs with delayed bytes; each step waits for them (`after`)."""
    with Server("--log-level", "warn") as xr3, xr3.monitor() as monitor, Proxy(xr3.robot_port, DELAY_S) as proxy:
        return [fresh_run(proxy.port, monitor, number, with_after=True) for number in range(1, count + 1)]


def fresh_run(port, monitor, number, with_after):
    monitor.call("reset")
    with Line(connect(port), number) as line:
        if with_after:  # the server numbers a line when it accepts the connection
            line.ask("E?")
        return run(line, monitor, with_after)
