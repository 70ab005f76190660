"""Random requests (random_requests.py) for ten minutes, with new seeds; prints the seeds that fail.
`soak_requests.py SEED` repeats one of them."""

import concurrent.futures
import os
import sys
import time
import traceback
import unittest

from random_requests import ask

REQUESTS = 2000
LASTS_S = 600
ROBOTS = [("rhino-xr3", "rhino-xr3"), ("adept-one", "adept-one"), ("intelledex-660", "intelledex-660"),
          ("rhino-xr3", "rhino-hundred")]


def one(seed):
    """Runs one seed; returns an error message, or "" on success."""
    try:
        robot, workcell = ROBOTS[seed % 4]
        ask(unittest.TestCase(), seed, REQUESTS, "--robot", robot, "--workcell", workcell,
            "--compat", ["paper", "mark3"][seed // 4 % 2], clock=["real:20", "manual", "bytes", "manual"][seed // 8 % 4])
    except Exception:  # any kind of exception: the message must contain the seed
        return f"seed {seed}: {traceback.format_exc()[-2000:]}"
    return ""


def soak():
    first, ends = time.time_ns() // 1000 % 10**9, time.monotonic() + LASTS_S
    done = 0
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        while time.monotonic() < ends:
            wrong = [what for what in pool.map(one, range(first + done, first + done + 8 * os.cpu_count())) if what]
            done += 8 * os.cpu_count()
            if wrong:
                print("\n".join(wrong))
                return False
    print(f"{done} seeds from {first} on, {REQUESTS} requests each")
    return True


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(one(int(sys.argv[1])) or "good")
    else:
        sys.exit(0 if soak() else 1)
