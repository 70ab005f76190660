#!/usr/bin/python3
"""Fails if one cell with all its motors running is slower than 10,000 times real time.

    check_speed.py BENCH

BENCH is the benchmarks' executable, of a release build. The best of a few runs counts, so that a
busy machine does not fail; the target, on an idle one, is ten times as much.
"""

import json
import subprocess
import sys

LEAST = 10_000
FILTER = "^six_motors/0"


def main():
    command = [sys.argv[1], f"--benchmark_filter={FILTER}", "--benchmark_min_time=0.2",
               "--benchmark_repetitions=5", "--benchmark_format=json"]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    runs = [run["x_real_time"] for run in json.loads(output.stdout)["benchmarks"]
            if run["run_type"] == "iteration" and not run.get("error_occurred")]
    if not runs:
        print(f"no run of {FILTER}")
        return 1
    best = max(runs)
    print(f"all motors running: {best:,.0f} times real time (at least {LEAST:,})")
    return 0 if best >= LEAST else 1


if __name__ == "__main__":
    sys.exit(main())
