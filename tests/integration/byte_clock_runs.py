"""An unmodified camera pick-and-place program of clients/, again and again with the byte clock: how many runs have
which transcript. Used by test_byte_clock_runs.py and, with more runs, by soak_byte_clock.py."""

import collections
import concurrent.futures
import os
import subprocess
import sys
import time

from support import DEADLINE_S, ROOT, Server, counts

CLIENTS = os.path.join(ROOT, "clients")
COMMANDS = {
    "python": [sys.executable, os.path.join(CLIENTS, "python", "6_find_and_pick.py")],
    "c": [os.path.join(CLIENTS, "c", "build", "6_find_and_pick")],
}
# The programs pause between two inquiries: the more time an inquiry takes, the fewer they need.
CLOCK = "bytes:500"
RUN_S = 120
PLACE = [392.0, 60.0]  # place of the red block, in mm


def build():
    """Builds the program in C."""
    subprocess.run(["make", "build/6_find_and_pick"], cwd=os.path.join(CLIENTS, "c"), check=True,
                   stdout=subprocess.DEVNULL)


def fresh_run(xr3, monitor, command):
    """Resets the cell and runs the program; returns what its transcript tells."""
    monitor.call("reset")
    environment = {**os.environ, "XR3_HOST": "127.0.0.1", "XR3_PORT": str(xr3.robot_port)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=RUN_S, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    end = time.monotonic() + DEADLINE_S
    while monitor.call("lines")["lines"]:  # the end of the line has not been read yet
        assert time.monotonic() < end, "its line does not close"
        time.sleep(0.005)
    state = monitor.get()
    red, = (block for block in state["blocks"] if block["name"] == "red")
    assert max(abs(a - b) for a, b in zip(red["xyz_mm"], PLACE)) < 2, red
    assert counts(state) == "", counts(state)
    transcript = monitor.call("transcript")
    assert transcript["marks"] == [] and transcript["lines"] == 1, transcript
    return transcript["sha256"]


def runs(language, count):
    """The digests of `count` runs on one server."""
    with Server("--log-level", "warn", clock=CLOCK) as xr3, xr3.monitor() as monitor:
        return [fresh_run(xr3, monitor, COMMANDS[language]) for _ in range(count)]


def counted(count, a_server, workers):
    """For each language how many of `count` runs have which digest; `a_server` runs on each server."""
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        jobs = {language: [pool.submit(runs, language, a_server) for _ in range(count // a_server)]
                for language in COMMANDS}
        return {language: collections.Counter(digest for job in those for digest in job.result())
                for language, those in jobs.items()}
