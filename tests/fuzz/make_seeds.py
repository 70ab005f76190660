#!/usr/bin/python3
"""Writes the fuzzers' seeds: transcripts for fuzz_line, fuzz_line_speed and fuzz_byte_clock, data files for
fuzz_data_file, one request of each kind for fuzz_monitor_request, sessions for fuzz_recording, short streams for the
fuzzers of byte streams, and the inputs that
`minimise` keeps in corpus/NAME.txt, one a line in base64.

    make_seeds.py FOLDER [--made]  writes FOLDER/NAME/* for each fuzzer NAME; --made: without corpus/
    make_seeds.py --pack FOLDER    prints corpus/NAME.txt for the inputs in a folder
"""

import base64
import glob
import hashlib
import itertools
import json
import os
import re
import sys

from stream_seeds import streams

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ESCAPE = re.compile(r"\\(x[0-9a-f]{2}|[rn0\\])")
PLAIN = {"r": "\r", "n": "\n", "0": "\0", "\\": "\\"}
MOST_BYTES = 0x40       # maximum of one chunk
LONGEST_PASS = 0x80**2  # ticks of one chunk
MOST_PACKED = 28_000    # bytes of corpus/NAME.txt


def unescape(text):
    def byte(match):
        name = match.group(1)
        return chr(int(name[1:], 16)) if name[0] == "x" else PLAIN[name]
    return ESCAPE.sub(byte, text).encode("latin-1")


def sent(wire, data):
    first = 0 if wire == 1 else 0x40
    for at in range(0, len(data), MOST_BYTES):
        piece = data[at:at + MOST_BYTES]
        yield bytes([first + len(piece) - 1]) + piece


def passed(ticks):
    while ticks > 0:
        root = min(0x80, int(ticks**0.5))
        yield bytes([0x7f + root])
        ticks -= root * root


def line_input(text):
    """Converts a transcript to the input format of fuzz_line; lines above 2 become line 2."""
    chunks = [b"\1" if "@ compat mark3" in text else b"\0"]
    for line in text.splitlines():
        match = re.match(r"([1-9]?)([>~]) (.*)", line)
        if not match:
            continue
        wire, sign, rest = match.groups()
        if sign == ">":
            chunks += sent(int(wire or 1), unescape(rest))
        else:
            value, unit = re.match(r"(\d+)(ms|s)$", rest).groups()
            chunks += passed(int(value) * (1 if unit == "ms" else 1000))
    return b"".join(chunks)


def write(folder, name, data):
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, name), "wb") as file:
        file.write(data)


def files(pattern):
    for path in sorted(glob.glob(os.path.join(ROOT, pattern))):
        with open(path, "rb") as file:
            yield os.path.splitext(os.path.basename(path))[0], file.read()


def saved_cell(workcell):
    """A saved cell at the soft home with one motor running and a block in the jaws."""
    motor = {"count": 0, "phase": 0, "error": 0, "speed": 1, "blocked": "no", "switch_closed": False}
    display = {"on": True, "view": [1, -2, 3], "period_half_s": 6, "erase": False, "status_option": 6,
               "function_keys": True}
    block = {"name": "red", "size_um": [64000, 32000, 40000], "centroid_um": [262000, 0, 20000],
             "yaw_udeg": 90000000, "color": 12}
    state = {"tick": 5, "motors": [{**motor, "phase": 3, "error": 50, "speed": 130}] + [motor] * 7,
             "stall": "no", "below_surface": False, "enabled": True, "display": display,
             "io": {"inputs": 1, "outputs": 2, "auxiliary": 3}, "blocks": [block],
             "held": {"block": 0, "quarter_turns": 1, "grasped_at": [0] * 8}, "jaws_warned": False,
             "tip_path": {"points": [[238100, 0, 320700], [238000, 0, 320700]], "oldest": 0},
             "faults": {"seed": 1, "power_cycles": 2, "slipped": 4, "all": [
                 {"fault": {"name": "s", "kind": "switch_bouncing", "joint": "E", "at_tick": 4, "ticks": 90},
                  "effects": 1, "bounce_tick": 4, "news_second": 0, "news": 1},
                 {"fault": {"name": "t", "kind": "encoder_slip", "joint": "F", "probability": 0.5},
                  "effects": 0, "news_second": 0, "news": 0}]}}
    return {"robot_hash": "sha256:1", "workcell": workcell, "state": state}


def calls(workcell):
    """Every call with args."""
    return {
        "rate": {"factor": 0.5},
        "step": {"ticks": 5, "after": {"line": 1, "bytes_in": 2, "within_ms": 3}, "fields": ["tool"]},
        "run_until": {"idle": True, "max_ticks": 60000}, "key": {"function": "view", "value": [1, 0, -9]},
        "send": {"hex": "452b350d"}, "input": {"input": 8, "value": True},
        "inverse": {"xyz_mm": [262, 0, 120], "pitch_deg": -90, "roll_deg": 90, "branch": "front, elbow up", "near": {"E": 242}},
        "block_add": {"name": "a", "size_mm": [40, 20, 10], "xyz_mm": [300, 0, 5], "yaw_deg": 30, "color": 2},
        "block_move": {"name": "a", "xyz_mm": [1, 2, 3]}, "block_remove": {"name": "a"},
        "workcell": {"workcell": workcell}, "snapshot_save": {"inline": True},
        "snapshot_load": {"snapshot": saved_cell(workcell)}, "line_disconnect": {"line": 1},
        "fault_set": {"fault": {"name": "a", "kind": "byte_flipped", "line": "any", "direction": "out", "bit": 3,
                                "probability": 0.01, "from_tick": 5, "count": 7}, "seed": 3},
        "fault_clear": {"name": "a"}, "trace": {"tick": 5, "epoch": 0, "every": 20},
        "describe": {"fn": "step"},
    }


def requests():
    """One request of each kind, by name."""
    workcell = {
        "name": "w", "length_unit": "mm", "workspace": {"x": 600, "y": 500, "z": 700},
        "blocks": [{"name": "red", "size": [64, 32, 40], "centroid": [262, 0, 20], "yaw_deg": 90, "color": 12}],
        "camera": {"location": [290, 0, 1000], "field": [384, 384], "pixels": [64, 64],
                   "projection": "perspective"}}
    yield "auth", {"op": "auth", "id": "a", "token": "3q2-7wEXAMPLEtoken16chars"}
    yield "sub", {"op": "sub", "channel": "image", "encoding": "rle", "max_hz": 10, "on_change": False,
                  "fields": ["rows"]}
    yield "unsub", {"op": "unsub", "channel": "line"}
    yield "get", {"op": "get", "cell": "main", "channel": "event", "since": 7}
    for fn, args in calls(workcell).items():
        yield fn, {"op": "call", "id": 1, "fn": fn, "args": args}


def packed(folder):
    """The inputs of a folder as lines, the shortest first, as many as fit."""
    inputs = []
    for path in glob.glob(os.path.join(folder, "*")):
        with open(path, "rb") as file:
            inputs.append(file.read())
    lines = [base64.b64encode(data).decode() for data in sorted(inputs, key=lambda data: (len(data), data))]
    sizes = itertools.accumulate(len(line) + 1 for line in lines)
    return [line for line, size in zip(lines, sizes) if size <= MOST_PACKED]


def recordings():
    """(name, entries of a recording) without checks, see recording.cpp."""
    opened = {"tick": 0, "line": 1, "open": "tcp", "peer": "127.0.0.1:5000", "guard": "normal"}
    session = [opened, {"tick": 5, "line": 1, "in": "E+60\r"}, {"tick": 90, "line": 1, "in": "E?", "out": "V"},
               {"tick": 95, "line": 1, "in": "E?D?", "taken": 2, "unsent": 1},
               {"tick": 99, "line": 1, "settings": "9600-7e2", "cooked": True}, {"tick": 99, "line": 1, "unsent": 0},
               {"tick": 10_001, "hash": "sha256:0"}, {"tick": 10_001, "line": 1, "input_ended": True},
               {"tick": 10_002, "line": 1, "close": "client_closed"}, {"tick": 10_002, "end": "limit"}]
    yield "session", 0, session
    yield "paced", 2, [opened, {"tick": 0, "line": 1, "in": "E?" * 200}, {"tick": 12, "line": 1, "out": " "}]
    yield "device", 4, [{"tick": 0, "device": "opened"}, opened, {"tick": 1, "line": 1, "in": "A@E?"},
                        {"tick": 2, "device_out": 2}, {"tick": 4, "device_in": "%"}, {"tick": 600, "device": "silent"},
                        {"tick": 700, "device": "lost", "why": "unplugged"}]
    for request in (request for _, request in requests() if request.get("op") == "call"):
        call = {"tick": 0, "call": request["fn"], "args": request.get("args", {})}
        yield request["fn"], 1, [opened, {"tick": 0, "line": 1, "in": "E+9\r"}, call,
                                 {"epoch": 1, "tick": 0, "line": 1, "in": "E?"}]


def kept():
    """(fuzzer, name, input) of corpus/NAME.txt."""
    for name, text in files("tests/fuzz/corpus/*.txt"):
        for line in text.split():
            data = base64.b64decode(line)
            yield name, hashlib.sha1(data).hexdigest(), data  # libFuzzer names files so, too


def made():
    """(fuzzer, name, input) of all other seeds."""
    for index, (name, text) in enumerate(files("tests/transcripts/*.txt")):
        data = line_input(text.decode())
        yield "line", name, data
        yield "line_speed", name, bytes([index % 8]) + data[1:]
        yield "byte_clock", name, bytes([index % 8]) + data[1:]
    for kind, first in (("robots", b"\0"), ("workcells", b"\1"), ("faults", b"f")):
        for name, text in files(f"data/{kind}/*.json"):
            yield "data_file", f"{kind}-{name}", first + text
    for name, request in requests():
        yield "monitor_request", name, json.dumps(request).encode()
    for name, choice, entries in recordings():
        yield "recording", name, bytes([choice]) + "".join(json.dumps(entry) + "\n" for entry in entries).encode()
    yield from streams()


def main():
    if sys.argv[1] == "--pack":
        print("".join(line + "\n" for line in packed(sys.argv[2])), end="")
        return
    only_made = sys.argv[2:] == ["--made"]
    for fuzzer, name, data in [*made(), *([] if only_made else kept())]:
        write(os.path.join(sys.argv[1], fuzzer), name, data)


if __name__ == "__main__":
    main()
