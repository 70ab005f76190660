"""A thousand runs of an unmodified camera pick-and-place program in each of two languages with the byte clock, half
of them beside full load, must have one transcript for each language (byte_clock_runs.py). As many runs of two clients
in one cell with the manual clock must have one, too. Many servers run in parallel, because the programs mostly pause.

    soak_byte_clock.py [RUNS]
"""

import collections
import hashlib
import json
import sys
import time

from byte_clock_runs import build, counted
from lockstep_runs import commands, full_load
from support import Server, machine

RUNS = 1000
RUNS_A_SERVER = 10
WORKERS = 20
TWO_CLIENTS = "two clients, manual clock"


def two_clients(count):
    """The digests of the replies and states of `count` runs of two lines that act at the same ticks, in changing order,
    while a test steps time."""
    digests = collections.Counter()
    with Server("--log-level", "warn") as xr3, xr3.monitor() as monitor:
        for number in range(count):
            monitor.call("reset")
            digest = hashlib.sha256()
            with xr3.line() as first, xr3.line() as second:
                for step, (data, ticks) in enumerate(commands()):
                    sends = [(first, data + "I"), (second, "P3R3J")]
                    for line, text in sends if (step + number) % 2 else sends[::-1]:
                        line.send(text)
                        line.ask("K")
                    digest.update(json.dumps(machine(monitor.step(ticks)), sort_keys=True).encode())
            digests[digest.hexdigest()] += 1
    return digests


def soak(runs):
    started = time.monotonic()
    build()
    half = max(runs // 2 // RUNS_A_SERVER, 1) * RUNS_A_SERVER
    found = counted(half, RUNS_A_SERVER, WORKERS)
    found[TWO_CLIENTS] = two_clients(half)
    with full_load():
        for language, digests in counted(half, RUNS_A_SERVER, WORKERS).items():
            found[language] += digests
        found[TWO_CLIENTS] += two_clients(half)
    for kind, digests in found.items():
        for digest, count in digests.most_common():
            print(f"{count:6} runs  {kind}  {digest}")
    print(f"{time.monotonic() - started:6.0f} s")
    return all(len(digests) == 1 for digests in found.values())


if __name__ == "__main__":
    sys.exit(0 if soak(int(sys.argv[1]) if len(sys.argv) > 1 else RUNS) else 1)
