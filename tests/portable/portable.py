#!/usr/bin/python3
"""Builds commands_digest by several compilers, for several machines, and compares what the programs print.

    portable.py [COMMANDS]

COMMANDS (200000) random commands to four robots with the byte clock must give the same replies and states:
by g++ and clang, for WebAssembly under Node.js, and for aarch64 under QEMU. Prints the seconds of each build
and run. Exit code 1: a build differs, failed, or lacks a program.
"""

import itertools
import pathlib
import shutil
import subprocess
import sys
import time
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/portable"
COMMANDS = 200_000


class Failure(Exception):
    """An error whose text says what failed and what to do."""


class Variant(NamedTuple):
    name: str
    programs: list  # programs that must be installed; A|B is one of them
    options: list  # options of CMake
    configure: list = []  # command that starts CMake
    runner: str = ""  # one of `programs`; empty for this machine
    program: str = "commands_digest"


VARIANTS = [
    Variant("g++", ["g++"], ["-DCMAKE_CXX_COMPILER=g++"]),
    Variant("clang", [], [f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/cmake/clang.cmake"]),
    Variant("WebAssembly", ["emcmake", "em++", "node"], [], ["emcmake"], "node", "commands_digest.js"),
    Variant("aarch64", ["aarch64-linux-gnu-g++", "qemu-aarch64-static|qemu-aarch64"],
            ["-DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++", "-DCMAKE_SYSTEM_NAME=Linux",
             "-DCMAKE_SYSTEM_PROCESSOR=aarch64"], runner="qemu-aarch64-static|qemu-aarch64"),
]


def path_of(alternatives):
    """The first of the programs A|B that is installed, or None."""
    return next(filter(None, map(shutil.which, alternatives.split("|"))), None)


def require_programs():
    wanted = ["cmake", "ninja", *(program for variant in VARIANTS for program in variant.programs)]
    missing = [program.replace("|", " or ") for program in wanted if not path_of(program)]
    if missing:
        raise Failure(f"not installed: {'; '.join(missing)}. `scripts/setup portable` installs all that is needed.")


def call(name, what, command):
    """Runs a command; returns what it prints, and its seconds."""
    start = time.monotonic()
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if done.returncode:
        print(done.stdout, done.stderr, sep="", end="")
        raise Failure(f"{name}: {what} failed with exit code {done.returncode} (output above); the command was:\n  "
                      + " ".join(map(str, command)))
    return done.stdout, time.monotonic() - start


def configure(variant):
    call(variant.name, "configuring", [*variant.configure, "cmake", "-S", ROOT / "tests/portable",
                                       "-B", BUILD / variant.name, "-G", "Ninja", *variant.options])


def build(variant):
    return call(variant.name, "the build", ["cmake", "--build", BUILD / variant.name])[1]


def run(variant, commands):
    runner = [path_of(variant.runner)] if variant.runner else []
    program = BUILD / variant.name / variant.program
    return call(variant.name, "the program", [*runner, program, ROOT / "data", str(commands)])


def first_difference(one, other):
    """The last line that two outputs have in common, and the next line of each."""
    common = "the beginning"
    for pair in itertools.zip_longest(one.splitlines(), other.splitlines(), fillvalue="(no more output)"):
        if pair[0] != pair[1]:
            return common, *pair
        common = pair[0]
    raise AssertionError("the outputs are equal")


def compare(outputs):
    """Fails with the first place where a build differs from the first build."""
    first, expected = next(iter(outputs.items()))
    for name, output in outputs.items():
        if output != expected:
            common, one, other = first_difference(expected, output)
            raise Failure(f"{name} differs from {first} after {common}\n  {first}: {one}\n  {name}: {other}\n"
                          "docs/decisions/0004-integers-decide.md lists what differs between machines.")


def test(commands):
    require_programs()
    for variant in VARIANTS:
        configure(variant)
    outputs = {}
    for variant in VARIANTS:
        build_s = build(variant)
        outputs[variant.name], run_s = run(variant, commands)
        last = outputs[variant.name].splitlines()[-1]
        print(f"{variant.name + ':':13}{build_s:4.0f} s to build, {run_s:4.0f} s to run; {last}", flush=True)
    compare(outputs)
    print(f"{commands} commands: {len(outputs)} builds give the same replies and states")


def main():
    text = sys.argv[1] if len(sys.argv) == 2 else str(COMMANDS)
    if len(sys.argv) > 2 or not text.isdecimal():
        print(f"usage: portable.py [COMMANDS], by default {COMMANDS}", file=sys.stderr)
        return 2
    try:
        test(int(text))
    except Failure as failure:
        print(f"portable: {failure}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
