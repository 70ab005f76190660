"""Compares the server with the model of tests/model (second_opinion.py) on 2,000 random programs with new seeds, each
in both profiles; prints the programs that fail. `soak_second_opinion.py SEED` repeats one and shortens it."""

import concurrent.futures
import os
import sys
import time

from second_opinion import PROFILES, SETUPS, Pair, difference, report, setup_of, shortened

PROGRAMS = 2000
BATCH = 40  # programs of one server
REPORTS = 5


def run(seeds):
    """Runs programs of the same setup in both profiles; returns the reports of those that fail."""
    reports = []
    for profile in PROFILES:
        with Pair(profile, setup_of(seeds[0])) as pair:
            for seed in seeds:
                program = pair.program(seed)
                if message := difference(pair, program):
                    reports.append(report(pair, seed, program, message))
    return reports


def soak():
    first = time.time_ns() // 1000 % 10**9
    stride = len(SETUPS)
    batches = [range(first + start, first + PROGRAMS, stride)[each:each + BATCH]
               for start in range(stride) for each in range(0, PROGRAMS // stride, BATCH)]
    with concurrent.futures.ProcessPoolExecutor(2 * os.cpu_count()) as pool:
        reports = [each for batch in pool.map(run, batches) for each in batch]
    print("\n\n".join(reports[:REPORTS]))
    print(f"{PROGRAMS} programs from seed {first} on, in both profiles: {len(reports)} differ")
    return not reports


def repeat(seed):
    """Runs one program; prints the shortest that fails."""
    is_good = True
    for profile in PROFILES:
        with Pair(profile, setup_of(seed)) as pair:
            program = pair.program(seed)
            if difference(pair, program):
                program = shortened(pair, program)
                print(report(pair, seed, program, difference(pair, program)))
                is_good = False
    print("The server and the model agree." if is_good else "The server and the model differ.")
    return is_good


if __name__ == "__main__":
    sys.exit(0 if (repeat(int(sys.argv[1])) if len(sys.argv) > 1 else soak()) else 1)
