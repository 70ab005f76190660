#!/usr/bin/python3
"""Attacks a server in every way that we know, and checks that each bound is kept.

Usage: abuse.py [--list] [NAME...]. A NAME is the beginning of the name of an attack. The environment has XR3, the
executable, and XR3_ROOT, the checkout. The exit code is 0 if every bound is kept. On a machine with more cores, two are
used. Delays count in the server's processor time, so that other programs on the machine do not matter."""

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


def prepare():
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:CORES])
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))


def measured(attack, rounds=None):
    """The median of the attack's rounds; raises the failure of a round."""
    with attack.in_force() as measure:
        found = sorted((measure() for _ in range(rounds or attack.rounds)), key=lambda each: each.value)
    return found[len(found) // 2]


def report(attack):
    """Prints the row of an attack; returns whether its bound is kept."""
    started = time.monotonic()
    try:
        with contextlib.redirect_stdout(io.StringIO()):  # the logs of servers that failed
            found = measured(attack)
        value, note, is_kept = f"{found.value:.2f}", found.note, found.value <= attack.bound
    except (AssertionError, OSError, EOFError, ValueError, subprocess.SubprocessError) as failure:
        value, note, is_kept = "-", str(failure).partition("\n")[0], False
    verdict = "ok" if is_kept else "FAILED"
    took_s = time.monotonic() - started
    print(f"{attack.name:<28} {attack.bound:>7g} {value:>10} {attack.unit:<10} {verdict:<6}  {note} ({took_s:.0f} s)",
          flush=True)
    return is_kept


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="the beginning of an attack's name")
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
    print(f"{'attack':<28} {'bound':>7} {'measured':>10}")
    kept = [report(attack) for attack in attacks]
    print(f"{kept.count(True)} of {len(kept)} bounds are kept")
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
