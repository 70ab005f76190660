#!/usr/bin/env python3
"""Checks docs/paper-map.md: no empty cell, a known status, and every file of a row that is not
planned exists."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MAP = ROOT / "docs" / "paper-map.md"
COLUMNS = 4
STATUSES = ("done", "planned", "replaced")


def cells(line):
    """The cells of a table row; \\| is a bar inside a cell."""
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def wrong(row):
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


def main():
    faults, rows = [], 0
    for number, line in enumerate(MAP.read_text(encoding="utf-8").splitlines(), start=1):
        if not line.startswith("|"):
            continue
        row = cells(line)
        if row[:1] == ["feature"] or all(set(cell) <= set("-: ") and cell for cell in row):
            continue
        rows += 1
        faults += [f"{MAP.relative_to(ROOT)}:{number}: {fault}" for fault in wrong(row)]
    if not rows:
        faults.append(f"{MAP.relative_to(ROOT)}: no rows")
    print("\n".join(faults) if faults else f"paper map: {rows} rows, all in order")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
