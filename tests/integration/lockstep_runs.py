"""A program on the robot port and a tester on the monitor port in lockstep: the same hundred steps give
the same states, on a machine that is busy with other things, also where the bytes of the program take
their time on the way. Used by test_lockstep_runs.py and, at length, by soak_lockstep.py."""

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
    """As many processes that do nothing but run as there are processors."""
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count())]
    try:
        yield
    finally:
        for process in busy:
            process.kill()
            process.wait()


def commands(seed=1989):
    """What the program writes before each step; and how many ticks the step takes."""
    chance = random.Random(seed)
    for _ in range(STEPS):
        moves = [f"{chance.choice('FEDCBA')}{chance.randint(-20, 20):+d}\r" for _ in range(chance.randint(1, 3))]
        yield "".join(moves) + chance.choice(["", "E?", "I", "LM", "P2R2", "EX"]), chance.randint(1, 150)


def run(line, monitor, with_after):
    """One run from the start on; returns its hash."""
    digest = hashlib.sha256()
    for data, ticks in commands():
        line.send(data)
        state = monitor.step(ticks, after=line if with_after else None)
        digest.update(json.dumps(machine(state), sort_keys=True).encode())
    return digest.hexdigest()


def runs(count):
    """Hashes of so many runs on one server, each from a reset on."""
    with Server("--log-level", "warn") as xr3, xr3.monitor() as monitor:
        return [fresh_run(xr3.robot_port, monitor, number, with_after=False) for number in range(1, count + 1)]


def delayed_runs(count):
    """The same, the robot's bytes being late, and the steps waiting for them."""
    with Server("--log-level", "warn") as xr3, xr3.monitor() as monitor, Proxy(xr3.robot_port, DELAY_S) as proxy:
        return [fresh_run(proxy.port, monitor, number, with_after=True) for number in range(1, count + 1)]


def fresh_run(port, monitor, number, with_after):
    monitor.call("reset")
    with Line(connect(port), number) as line:
        if with_after:  # a line that is still on its way has no number yet
            line.ask("E?")
        return run(line, monitor, with_after)
