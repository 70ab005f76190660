#!/usr/bin/python3
"""Writes the fuzzers' seeds: transcripts for fuzz_line, data files for fuzz_data_file.

    make_seeds.py FOLDER      writes FOLDER/line/* and FOLDER/data_file/*
"""

import glob
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ESCAPE = re.compile(r"\\(x[0-9a-f]{2}|[rn0\\])")
PLAIN = {"r": "\r", "n": "\n", "0": "\0", "\\": "\\"}
MOST_BYTES = 0x40       # of one chunk
LONGEST_PASS = 0x80**2  # ticks of one chunk


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
    """A transcript as fuzz_line reads it; lines 2 and up become line 2."""
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


def main():
    folder = sys.argv[1]
    for name, text in files("tests/transcripts/*.txt"):
        write(os.path.join(folder, "line"), name, line_input(text.decode()))
    for kind, first in (("robots", b"\0"), ("workcells", b"\1")):
        for name, text in files(f"data/{kind}/*.json"):
            write(os.path.join(folder, "data_file"), f"{kind}-{name}", first + text)


if __name__ == "__main__":
    main()
