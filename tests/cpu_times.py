#!/usr/bin/python3
"""Runs the tests of ctest and prints what they cost in seconds of processor time, the dearest first, and the sum.
Usage: tests/cpu_times.py [--preset PRESET] [option of ctest that selects tests...], for example -R integration. PRESET is
quick if it is not given; build it before, and let nothing else run: other programs make the same work cost more.

The sum counts every process that a test starts, and those that they start, such as the processes of Chromium: each test
has a parent of its own that adopts them when their parents end (a subreaper, see prctl(2)), and waits for all."""

import collections
import ctypes
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
DEAREST = 40
LINGER_S = 5
PR_SET_CHILD_SUBREAPER = 36

Cost = collections.namedtuple("Cost", "seconds wall_s preset name status")


def environment_of(preset):
    """The environment that the preset of the tests sets, with that of the presets that it inherits."""
    presets = {each["name"]: each for each in json.loads((ROOT / "CMakePresets.json").read_text())["testPresets"]}
    own = presets[preset]
    inherited = environment_of(own["inherits"]) if "inherits" in own else {}
    return {**inherited, **own.get("environment", {})}


def tests_of(preset, options):
    """The tests of a preset, as ctest describes them."""
    listed = subprocess.run(["ctest", "--preset", preset, "--show-only=json-v1", *options], cwd=ROOT,
                            capture_output=True, text=True, check=True)
    return json.loads(listed.stdout)["tests"]


def kill_children(*_):
    """Ends what the test has left running. (The next parent adopts the children of those: the alarm comes again.)"""
    signal.alarm(1)
    for pid in pathlib.Path("/proc/thread-self/children").read_text().split():
        os.kill(int(pid), signal.SIGKILL)


def reap(command, **options):
    """Runs a command and waits for all its descendants; returns its exit code."""
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    child = subprocess.Popen(command, **options)
    code = None
    while True:
        try:
            pid, status = os.wait()
        except ChildProcessError:
            return code
        if pid == child.pid:
            code = os.waitstatus_to_exitcode(status)
            signal.signal(signal.SIGALRM, kill_children)
            signal.alarm(LINGER_S)


def measure(preset, test, output):
    """The cost of a test, which writes to the file `output`."""
    settings = {each["name"]: each["value"] for each in test.get("properties", [])}
    added = dict(each.split("=", 1) for each in settings.get("ENVIRONMENT", []))
    started = time.monotonic()
    reaper = os.fork()
    if not reaper:
        code = reap(test["command"], cwd=settings.get("WORKING_DIRECTORY"), stdin=subprocess.DEVNULL, stdout=output,
                    stderr=output, env={**os.environ, **environment_of(preset), **added})
        os._exit(code if 0 <= code < 128 else 1)
    _, status, usage = os.wait4(reaper, 0)
    return Cost(usage.ru_utime + usage.ru_stime, time.monotonic() - started, preset, test["name"],
                os.waitstatus_to_exitcode(status))


def run(preset, test):
    """Runs a test; prints its row, and its output if it fails."""
    with tempfile.TemporaryFile() as output:
        cost = measure(preset, test, output)
        if cost.status:
            output.seek(0)
            print(f"{preset} {test['name']} FAILED\n{output.read().decode(errors='replace')}", flush=True)
    print(row(cost), file=sys.stderr)
    return cost


def row(cost):
    failed = "  FAILED" if cost.status else ""
    return f"{cost.seconds:8.2f} {cost.wall_s:8.2f}  {cost.preset:8} {cost.name}{failed}"


def print_sums(costs):
    """The sums of the kinds of tests: the word before the point in a name."""
    kinds = collections.defaultdict(list)
    for each in costs:
        kinds[each.preset, each.name.partition(".")[0]].append(each.seconds)
    print(f"\n{'processor':>9} {'tests':>7}")
    for (preset, kind), values in sorted(kinds.items(), key=lambda item: -sum(item[1])):
        print(f"{sum(values):8.2f} {len(values):8}  {preset:8} {kind}")


def main(options):
    preset = "quick"
    if options[:1] == ["--preset"]:
        preset, options = options[1], options[2:]
    costs = sorted((run(preset, test) for test in tests_of(preset, options)), reverse=True)
    print(f"{'processor':>9} {'seconds':>7}")
    print("\n".join(map(row, costs[:DEAREST])))
    print_sums(costs)
    total = sum(each.seconds for each in costs)
    print(f"{total:8.2f} {len(costs):8}  in all: {total / 60:.1f} minutes of processor time")
    return 1 if any(each.status for each in costs) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
