#!/usr/bin/python3
"""Only server/net/spawn.hpp, which loses no exception, starts coroutines that are not awaited: no other file of
server/ may contain `detached`, or co_spawn without an await. Prints every breach as file:line."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALLOWED = {"server/net/spawn.cpp"}
LOOSE = re.compile(r"\bdetached\b|(?<!co_await )asio::co_spawn\(")


def breaches(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        code = line.split("//")[0]
        if LOOSE.search(code):
            yield f"{path.relative_to(ROOT)}:{number}: {line.strip()}"


def main():
    files = [path for path in sorted(ROOT.glob("server/**/*.?pp")) if str(path.relative_to(ROOT)) not in ALLOWED]
    found = [breach for path in files for breach in breaches(path)]
    for breach in found:
        print(breach)
    print(f"{len(files)} files read, {len(found)} breaches")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
