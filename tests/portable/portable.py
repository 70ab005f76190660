#!/usr/bin/python3
"""Builds commands_digest by several compilers, for several machines, and compares what it prints.

    portable.py [COMMANDS]

COMMANDS (200000) random commands to four robots with the byte clock must give the same replies and states:
by g++ and clang, for WebAssembly under Node.js, and for aarch64 under QEMU. Exit code 1: they differ.
"""

import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).parents[2]
BUILD = ROOT / "build/portable"
COMMANDS = 200_000


def first(*names):
    return next((name for name in names if shutil.which(name)), names[0])


def variants():
    """(name, how CMake is started, its options, what runs the program, its file)."""
    return [
        ("g++", [], ["-DCMAKE_CXX_COMPILER=g++"], [], "commands_digest"),
        ("clang", [], [f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/cmake/clang.cmake"], [], "commands_digest"),
        ("WebAssembly", ["emcmake"], [], ["node"], "commands_digest.js"),
        ("aarch64", [], ["-DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++", "-DCMAKE_SYSTEM_NAME=Linux",
                         "-DCMAKE_SYSTEM_PROCESSOR=aarch64"],
         [first("qemu-aarch64-static", "qemu-aarch64")], "commands_digest"),
    ]


def output(name, configure, options, runner, program, commands):
    folder = BUILD / name
    print(f"{name}: building", flush=True)
    command = [*configure, "cmake", "-S", ROOT / "tests/portable", "-B", folder, "-G", "Ninja", *options]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder], check=True, stdout=subprocess.DEVNULL)
    run = subprocess.run([*runner, folder / program, ROOT / "data", str(commands)], check=True, text=True,
                         stdout=subprocess.PIPE)
    print(f"{name}: {run.stdout.splitlines()[-1]}", flush=True)
    return run.stdout


def main():
    commands = int(sys.argv[1]) if len(sys.argv) > 1 else COMMANDS
    outputs = {name: output(name, *rest, commands) for name, *rest in variants()}
    if len(set(outputs.values())) == 1:
        print(f"{commands} commands: {len(outputs)} builds print the same")
        return 0
    for name, text in outputs.items():
        print(f"--- {name}\n{text}")
    return 1


if __name__ == "__main__":
    sys.exit(main())
