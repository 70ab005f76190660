#!/usr/bin/env python3
"""Runs every example of every language in clients/ against a real server at a high clock rate, in
both profiles, with the command of the language's README, and checks the result at the monitor port:
motor positions, block positions, and that the robot executed every command. The output of the
examples is the same in every language: expected/*.txt, where *-mark3.txt is for this profile only.
Then it checks their error messages: wrong_use.py.

    XR3=build/release/xr3 tests/clients/examples.py [LANGUAGE...]

The last lines list the languages: ok, FAILED, or skipped with the reason. A skipped language is not a
failure.
"""

import argparse
import concurrent.futures
import dataclasses
import itertools
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CLIENTS = ROOT / "clients"
EXPECTED = Path(__file__).resolve().parent / "expected"
sys.path.insert(0, str(CLIENTS / "python" / "tests"))

import wrong_use  # noqa: E402
from context import Server  # noqa: E402
from xr3 import Monitor, Robot  # noqa: E402

EXAMPLES = ("1_hello", "2_move_and_wait", "3_home", "4_two_joints", "5_pick_and_place",
            "6_find_and_pick")
PROFILES = ("paper", "mark3")
CLOCK = "real:50"
DEADLINE_S = 240  # timeout; 3_home takes half a minute, the others one to four seconds, if idle
AT_ONCE = 4
PROGRESS = re.compile(r"^  .*\d+ counts to go$")  # these lines depend on timing

# The requirements of each language: commands that must succeed.
NEEDS = {
    "python": ["python3 --version"],
    "c": ["make --version", "gcc --version"],
    "cpp": ["make --version", "g++ --version"],
    "javascript": ["node --version"],
    "java": ["make --version", "javac -version", "java -version"],
    "rust": ["make --version", "rustc --version"],
    "octave": ["octave-cli --version", "octave-cli --eval 'pkg load instrument-control'"],
    "bash": ["command -v nc", "od --version", "awk 'BEGIN { exit }'"],
}

# The start of 3_home: all joints but the jaws are beyond their switches (where these are open again in
# mark3), and the arm is folded back above its base.
DISPLACED = {"F": 200, "E": -200, "D": 200, "C": -200, "B": -200, "A": 20}
# Maximum number of questions for counts of an example if it pauses between two questions for longer than a move takes.
MOST_QUESTIONS = {"2_move_and_wait": 4, "4_two_joints": 8}
MOVED_RED = {"centroid": [285, 25, 20], "yaw_deg": 35}  # the place in which 6_find_and_pick must find it
MOST_MM = 2  # tolerance for the place of a block that was found with the camera
MOST_DEG = 3


class Wrong(Exception):
    """An example failed; the message gives the reason."""


# --- The expected state after each example.

@dataclasses.dataclass
class Outcome:
    """The expected state at the end, in addition to all other motors at 0."""

    moves: str = None  # all executed moves, if checked
    roll: int = 0  # the count of B
    red: tuple = None  # x, y, z in mm and yaw in degrees of the red block, if moved


OUTCOMES = {
    "1_hello": Outcome(moves=""),
    "2_move_and_wait": Outcome(moves="E+50 E-50"),
    "3_home": Outcome(),
    "3_home-mark3": Outcome(roll=-1152),  # B meets its switch once a turn: it goes on to the next
    "4_two_joints": Outcome(moves="F+40 E+80 F-40 E-80"),
    "5_pick_and_place": Outcome(red=(400, 0, 20, 0)),
    "6_find_and_pick": Outcome(red=(392, 60, 20, 90)),
}


def check_outcome(monitor, wanted, blocks):
    """Compares the state with `wanted`; `blocks` are the blocks before the example, by name."""
    state = monitor.state()
    motors = {motor["label"]: motor for motor in [*state["joints"], state["tool"]]}
    for label, motor in motors.items():
        place = wanted.roll if label == "B" else 0
        if motor["count"] != place:
            raise Wrong(f"{label} is at {motor['count']}, not at {place}")
    if state["stalled"] or state["moving"] or state["tool"]["holding"]:
        raise Wrong("the robot stalls, moves, or holds something")
    for block in state["blocks"]:
        check_block(block, blocks[block["name"]], wanted.red)
    check_events(monitor.recall("event", since=0), wanted)


def check_events(events, wanted):
    """Checks that there were no warnings or stalls, and that the moves are as expected."""
    for event in events:
        if event["event"] in ("warning", "stalled"):
            raise Wrong(f"{event['code']}: {event['message']}")
    moves = " ".join(f"{event['joint']}{event['counts']:+d}" for event in events
                     if event["event"] == "move")
    if wanted.moves not in (None, moves):
        raise Wrong(f"the moves were {moves}, not {wanted.moves}")


def check_block(block, before, red):
    """Checks that a block is at its place, and the red one at its new place."""
    if block["name"] == "red" and red is not None:
        if math.dist(block["xyz_mm"], red[:3]) > MOST_MM:
            raise Wrong(f"block red is at {block['xyz_mm']}, not at {red[:3]}")
        if abs(math.remainder(block["yaw_deg"] - red[3], 180)) > MOST_DEG:
            raise Wrong(f"block red is turned {block['yaw_deg']}, not {red[3]} degrees")
    elif (block["xyz_mm"], block["yaw_deg"]) != (before["xyz_mm"], before["yaw_deg"]):
        raise Wrong(f"block {block['name']} has moved")


def check_output(example, profile, printed):
    lines = [line for line in printed.splitlines() if not PROGRESS.match(line)]
    only_here = EXPECTED / f"{example}-{profile}.txt"
    file = only_here if only_here.exists() else EXPECTED / f"{example}.txt"
    expected = file.read_text(encoding="utf-8").splitlines()
    if lines != expected:
        raise Wrong("it printed\n    " + "\n    ".join(lines)
                    + "\n  not\n    " + "\n    ".join(expected))


# --- Running.

def commands_of(language):
    """The command of the README's first shell fence, and its command for another host and port."""
    readme = (CLIENTS / language / "README.md").read_text(encoding="utf-8")
    command = re.search(r"```sh\n(.*1_hello.*)\n```", readme).group(1)
    elsewhere = re.search(r"`([^`]*1_hello[^`]*) HOST PORT`", readme).group(1)
    return command, elsewhere


def run(command, folder, **environment):
    """Runs a shell command in a folder; returns its output. Raises Wrong if it fails or reports an error."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith("XR3_")}
    ran = subprocess.run(command, shell=True, cwd=folder, env={**clean, **environment}, text=True,
                         stdin=subprocess.DEVNULL, capture_output=True, check=False,
                         timeout=DEADLINE_S)
    if ran.returncode != 0 or ran.stderr.startswith("error:"):
        raise Wrong(f"`{command}` ended with {ran.returncode}\n{ran.stdout}{ran.stderr}")
    return ran.stdout


def workcell_for(example, folder):
    """The Rhino's workcell; for 6_find_and_pick, a copy with the red block at another place."""
    table = ROOT / "data" / "workcells" / "rhino-xr3.json"
    if example != "6_find_and_pick":
        return table
    cell = json.loads(table.read_text(encoding="utf-8"))
    next(block for block in cell["blocks"] if block["name"] == "red").update(MOVED_RED)
    moved = Path(folder) / "moved.json"
    moved.write_text(json.dumps(cell), encoding="utf-8")
    return moved


def displace(server):
    """Moves the arm away from its soft home."""
    with Robot("127.0.0.1", server.robot_port) as robot:
        robot.go(DISPLACED)


def run_in_a_row(language):
    """`make`: all examples in sequence, on one robot."""
    with Server("--clock", CLOCK) as server, Monitor("127.0.0.1", server.monitor_port) as monitor:
        blocks = {block["name"]: block for block in monitor.state("blocks")["blocks"]}
        run("make", CLIENTS / language, XR3_HOST="localhost", XR3_PORT=str(server.robot_port))
        check_outcome(monitor, Outcome(red=OUTCOMES[EXAMPLES[-1]].red), blocks)


def run_example(language, example, command, profile, by_arguments=False):
    """Runs one example with a new server."""
    with tempfile.TemporaryDirectory() as folder, \
            Server("--workcell", str(workcell_for(example, folder)), "--clock", CLOCK,
                   "--compat", profile) as server, \
            Monitor("127.0.0.1", server.monitor_port) as monitor:
        if example == "3_home":
            displace(server)
        blocks = {block["name"]: block for block in monitor.state("blocks")["blocks"]}
        where = {"XR3_HOST": "localhost", "XR3_PORT": str(server.robot_port)}
        if by_arguments:
            command, where = f"{command} localhost {server.robot_port}", {}
        printed = run(command, CLIENTS / language, **where)
        check_output(example, profile, printed)
        check_outcome(monitor, OUTCOMES.get(f"{example}-{profile}", OUTCOMES[example]), blocks)


def run_with_pauses(language, example, command):
    """Runs one example with XR3_POLL_MS=1000, and counts its questions."""
    with Server() as server, Monitor("127.0.0.1", server.monitor_port) as monitor:
        run(command, CLIENTS / language, XR3_HOST="localhost", XR3_PORT=str(server.robot_port), XR3_POLL_MS="1000")
        asked = sum(part["code"] == "query_error" for message in monitor.recall("line", since=0)
                    for part in message["parsed"])
        if asked > MOST_QUESTIONS[example]:
            raise Wrong(f"it does not obey XR3_POLL_MS: it has asked {asked} times")


# --- Languages.

def missing(language):
    """The reason why this machine cannot run a language, or None."""
    for command in NEEDS[language]:
        if subprocess.run(command, shell=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, check=False).returncode != 0:
            return f"`{command}` does not work here"
    return None


def prepare(language):
    """Builds the examples of a language, if they need it, in its build folder."""
    folder = CLIENTS / language
    if (folder / "Makefile").exists():
        run("make clean && make build", folder)


def check_language(language):
    """Runs all examples of a language; returns its summary line and whether it passed."""
    started = time.monotonic()
    lack = missing(language)
    if lack:
        return f"skipped   {language:10} {lack}", True
    faults = []
    try:
        prepare(language)
        command, elsewhere = commands_of(language)
        for example, profile in itertools.product(EXAMPLES, PROFILES):
            run_one(language, example, faults, run_example, command.replace("1_hello", example), profile)
        run_one(language, "1_hello", faults, run_example, elsewhere, "paper", by_arguments=True)
        for example in MOST_QUESTIONS:
            run_one(language, example, faults, run_with_pauses, command.replace("1_hello", example))
        if command.startswith("make"):
            run_in_a_row(language)
        faults += wrong_use.faults_of(language, command, CLIENTS / language)
    except (Wrong, subprocess.TimeoutExpired) as wrong:
        faults.append(f"{language}: {wrong}")
    print("".join(f"{fault}\n" for fault in faults), end="", flush=True)
    took = time.monotonic() - started
    word = "FAILED" if faults else "ok"
    return f"{word:9} {language:10} {len(EXAMPLES)} examples in both profiles, {took:.0f} s", not faults


def run_one(language, example, faults, how, *arguments, **options):
    try:
        how(language, example, *arguments, **options)
    except (Wrong, subprocess.TimeoutExpired) as wrong:
        faults.append(f"{language}, {example}, {' '.join(arguments)}: {wrong}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("languages", nargs="*", metavar="LANGUAGE",
                        help=f"some of {', '.join(NEEDS)} (all of them)")
    parser.add_argument("--summary", type=Path, metavar="FILE",
                        help="also write the summary to FILE")
    options = parser.parse_args()
    languages = options.languages or list(NEEDS)
    unknown = set(languages) - set(NEEDS)
    if unknown:
        parser.error(f"no such language: {', '.join(sorted(unknown))}")
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
        results = list(pool.map(check_language, languages))
    summary = "".join(f"{line}\n" for line, _ in results)
    print(summary, end="")
    if options.summary:
        options.summary.write_text(summary, encoding="utf-8")
    return 0 if all(fine for _, fine in results) else 1


if __name__ == "__main__":
    sys.exit(main())
