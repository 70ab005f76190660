#!/usr/bin/env python3
"""Checks docs/paper-map.md: no empty cell, a known status, every file of a row that is not planned exists, and
ctest runs the tests that a row names. Called as `paper_map.py CTEST BUILD`, it asks ctest for the tests of that
build; without arguments it checks only what needs no build."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MAP = ROOT / "docs" / "paper-map.md"
COLUMNS = 4
STATUSES = ("done", "planned", "replaced")
LIBRARIES = ("core", "protocol", "cell", "tools", "server", "cli")
GTEST = re.compile(r"^(TEST|TEST_F|TEST_P|RC_GTEST_PROP)\(\s*(\w+),", re.MULTILINE)

# The tests of ctest that use the other files of tests/.
RUNNERS = {
    "tests/transcripts": ["integration.transcripts"],
    "tests/web/viewer_test.mjs": ["integration.viewer"],
    "tests/bench/fanout.cpp": ["bench.fanout"],
}
# Files of other suites: `./test --soak`, `./test --clients` and `./test --lines`.
OUTSIDE = ("tests/web/", "tests/clients", "tests/lines")


def cells(line):
    """The cells of a table row; \\| is a bar inside a cell."""
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def unit_tests(path):
    """The names in ctest of the suites in a file of GoogleTest; `*` stands for the name of an instantiation."""
    suites = sorted(set(GTEST.findall((ROOT / path).read_text(encoding="utf-8"))))
    return [f"unit.*/{suite}" if kind == "TEST_P" else f"unit.{suite}" for kind, suite in suites]


def names_of(path):
    """The names in ctest of the tests that a path of a row stands for; none if another suite runs it."""
    if path in RUNNERS:
        return RUNNERS[path]
    if (ROOT / path).is_dir():
        files = sorted(each.relative_to(ROOT).as_posix() for each in (ROOT / path).rglob("*.*"))
        return [name for each in files for name in names_of(each)]
    script = re.fullmatch(r"tests/integration/test_(\w+)\.py", path)
    if script:
        return [f"integration.{script[1]}"]
    if re.fullmatch(rf"tests/({'|'.join(LIBRARIES)})/.*_test\.cpp", path):
        return unit_tests(path)
    return RUNNERS.get(path.rpartition("/")[0], [])


def tests_of(ctest, build):
    """The tests of a build."""
    listed = subprocess.run([ctest, "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^ *Test +#\d+: (.+?)(?: \(Disabled\))?$", listed, re.MULTILINE))


def is_expected(name, known):
    """Whether this build has tests of that kind: a release has no unit tests, a development build measures nothing."""
    kind = name.partition(".")[0]
    if name.endswith("_release"):
        return any(each.endswith("_release") for each in known)
    return any(each.partition(".")[0] == kind for each in known)


def is_known(name, known):
    """Whether ctest has this test; `*` stands for the name of an instantiation."""
    if "*" not in name:
        return name in known
    before, after = name.split("*")
    return any(each.startswith(before) and each.endswith(after) for each in known)


def wrong_tests(paths, word, known):
    """The faults of the tests of a row; `known` are the tests of the build, None without one."""
    if word == "done" and paths and not any(names_of(path) for path in paths):
        yield f"ctest runs none of {', '.join(paths)}"
    for path in paths:
        names = names_of(path)
        if not names and not path.startswith(OUTSIDE):
            yield f"{path} is no test"
        yield from (f"ctest has no test {name}, named by {path}" for name in names
                    if known is not None and is_expected(name, known) and not is_known(name, known))


def wrong(row, known):
    """The faults of one row, one message each."""
    if len(row) != COLUMNS:
        yield f"{len(row)} cells, not {COLUMNS}"
        return
    if not all(row):
        yield "an empty cell"
    _, code, tests, status = row
    word, _, detail = status.partition(":")
    if word not in STATUSES:
        yield f"status '{word}' is not one of {', '.join(STATUSES)}"
    if word in ("planned", "replaced") and not detail.strip():
        yield f"'{word}' needs a reason after a colon"
    for cell in (code, tests):
        paths = re.findall(r"`([^`]+)`", cell)
        if not paths:
            yield f"no path in backticks in '{cell}'"
        if word != "planned":
            yield from (f"{path} does not exist" for path in paths if not (ROOT / path).exists())
    yield from wrong_tests([path for path in re.findall(r"`([^`]+)`", tests) if (ROOT / path).exists()], word, known)


def main(ctest=None, build=None):
    known = tests_of(ctest, build) if ctest else None
    faults = [f"{name}: build it first" for name in sorted(known or []) if name.endswith("_NOT_BUILT")]
    rows = 0
    for number, line in enumerate(MAP.read_text(encoding="utf-8").splitlines(), start=1):
        if not line.startswith("|"):
            continue
        row = cells(line)
        if row[:1] == ["feature"] or all(set(cell) <= set("-: ") and cell for cell in row):
            continue
        rows += 1
        faults += [f"{MAP.relative_to(ROOT)}:{number}: {fault}" for fault in wrong(row, known)]
    if not rows:
        faults.append(f"{MAP.relative_to(ROOT)}: no rows")
    print("\n".join(faults) if faults else f"paper map: {rows} rows, all in order")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
