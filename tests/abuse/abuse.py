#!/usr/bin/python3
"""Attacks a server in every way that we know, and checks that each bound is kept in the worst of five rounds.

Usage: abuse.py [--rounds N] [--list] [NAME...]. A NAME is the beginning of the name of an attack. The environment
has XR3, the executable, and XR3_ROOT, the checkout. The exit code is 0 if every bound is kept. On a machine with more
cores, two are used. A round that exceeds a bound of time is repeated if a bystander, an idle program on each core
that the server does not concern, had to wait for more than half of that bound, too, or the server for a core: the
machine is busy."""

import argparse
import contextlib
import io
import os
import pathlib
import resource
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "integration"))

CORES = 2
ROUNDS = 5
MOST_DISTURBED = 10


def prepare():
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:CORES])
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))


def worst_of(attack, rounds):
    """(the worst of so many rounds, the number of rounds in which the machine was busy with something else); raises the
    failure of a round. A disturbed round is repeated."""
    measured, disturbed = [], 0
    with attack.in_force() as measure:
        while len(measured) < rounds:
            each = measure()
            if not each.is_disturbed(attack.bound):
                measured.append(each)
            elif (disturbed := disturbed + 1) > MOST_DISTURBED:
                raise AssertionError(f"the machine is too busy to judge: {each.note}")
    return max(measured, key=lambda each: each.value), disturbed


def report(attack, rounds):
    """Prints the row of an attack; returns whether its bound is kept."""
    started = time.monotonic()
    try:
        with contextlib.redirect_stdout(io.StringIO()):  # the logs of servers that failed
            worst, disturbed = worst_of(attack, rounds)
        value, is_kept = f"{worst.value:.2f}", worst.value <= attack.bound
        note = worst.note + (f"; {disturbed} rounds were repeated" if disturbed else "")
    except (AssertionError, OSError, EOFError, ValueError, subprocess.SubprocessError) as failure:
        value, note, is_kept = "-", str(failure).splitlines()[0], False
    verdict = "ok" if is_kept else "FAILED"
    took_s = time.monotonic() - started
    print(f"{attack.name:<36} {attack.bound:>7g} {value:>10} {attack.unit:<10} {verdict:<6}  {note} ({took_s:.0f} s)",
          flush=True)
    return is_kept


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="the beginning of an attack's name")
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--list", action="store_true", help="print the names of the attacks")
    options = parser.parse_args()
    import catalogue
    attacks = [attack for attack in catalogue.ATTACKS if attack.name.startswith(tuple(options.names) or "")]
    if options.list:
        print("\n".join(attack.name for attack in attacks))
        return 0
    if not attacks:
        parser.error("no attack has such a name; --list prints them")
    prepare()
    print(f"{'attack':<36} {'bound':>7} {f'worst of {options.rounds}':>10}")
    kept = [report(attack, options.rounds) for attack in attacks]
    print(f"{kept.count(True)} of {len(kept)} bounds are kept")
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
