#!/usr/bin/python3
"""Compares the benchmarks of two builds side by side: the CPU time of NEW over that of OLD.

    side_by_side.py OLD NEW [--rounds N] [--seconds S] [--filter REGEX] [--bound RATIO]

OLD and NEW are benchmark executables of release builds, for example of two checkouts. Each round runs every
benchmark that both have once in OLD and once in NEW, one immediately after the other and in the other order in
the next round, so that other work on the machine slows down both. The table has the smallest and the median
time of all rounds; the ratio of the smallest times counts, because other work only ever adds time. The exit code
is 1 if a ratio is above the bound.
"""

import argparse
import json
import statistics
import subprocess
import sys

NANOSECONDS = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}


def names(bench, pattern):
    command = [bench, "--benchmark_list_tests=true", f"--benchmark_filter={pattern}"]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.split("\n")[:-1]


def filter_of(name):
    """The expression that matches this benchmark alone. (Google Benchmark adds the iterations to a name.)"""
    return f"^{name.split('/iterations:')[0]}(/iterations:.*)?$"


def time_ns(bench, name, seconds):
    command = [bench, f"--benchmark_filter={filter_of(name)}", f"--benchmark_min_time={seconds}",
               "--benchmark_format=json"]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    run, = json.loads(output.stdout)["benchmarks"]
    assert not run.get("error_occurred"), run
    return run["cpu_time"] * NANOSECONDS[run["time_unit"]]


def measure(benches, common, rounds, seconds):
    """For each benchmark the times of OLD and those of NEW."""
    times = {name: ([], []) for name in common}
    for number in range(rounds):
        for name in common:
            for which in ((0, 1), (1, 0))[number % 2]:
                times[name][which].append(time_ns(benches[which], name, seconds))
        print(f"\rround {number + 1} of {rounds}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return times


def report(times, bound):
    """Prints the table and returns the names above the bound."""
    width = max(map(len, times))
    print(f"{'benchmark':{width}} {'old ns':>13} {'new ns':>13} {'of minima':>10} {'of medians':>11}")
    above = []
    for name, (old, new) in times.items():
        ratio = min(new) / min(old)
        medians = statistics.median(new) / statistics.median(old)
        mark = "  above" if ratio > bound else ""
        print(f"{name:{width}} {min(old):13,.1f} {min(new):13,.1f} {ratio:10.3f} {medians:11.3f}{mark}")
        if mark:
            above.append(name)
    return above


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--seconds", type=float, default=0.02, help="least time of a run")
    parser.add_argument("--filter", default=".", help="which benchmarks, an expression")
    parser.add_argument("--bound", type=float, default=1.03)
    options = parser.parse_args()
    benches = (options.old, options.new)
    common = [name for name in names(benches[1], options.filter) if name in names(benches[0], ".")]
    if not common:
        parser.error("the two have no benchmark in common")
    above = report(measure(benches, common, options.rounds, options.seconds), options.bound)
    print(f"{len(common)} benchmarks, {len(above)} above {options.bound}")
    return 1 if above else 0


if __name__ == "__main__":
    sys.exit(main())
