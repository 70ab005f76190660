"""The course of docs/course: `xr3 exercise check` proves each exercise, and each sentence of the judge that a sheet quotes
is said to one of its wrong programs.
Run by `./test --course`. Usage: course_runs.py [EXERCISE...]; the environment has XR3 and XR3_ROOT."""

import pathlib
import re
import subprocess
import sys

from support import ROOT, XR3

COURSE = pathlib.Path(ROOT, "docs/course")
COMMAND = re.compile(r"^xr3 exec (.*?) -- python3 (\S+)$", re.MULTILINE)
MISTAKE = re.compile(r"^\| .* \| (.*) \|$", re.MULTILINE)  # a row of the last table of a sheet
QUOTE = re.compile(r"`([^`]*[ _][^`]*)`")  # a sentence, or the code of a warning


def sheet_command(exercise):
    """(the options of `xr3 exec`, the program) of the first command that the sheet shows."""
    options, program = COMMAND.search((exercise / "README.md").read_text(encoding="utf-8")).groups()
    return options.split(), program


def options_of(exercise):
    return sheet_command(exercise)[0]


def starter_of(exercise):
    return exercise / "starter" / sheet_command(exercise)[1]


def programs_of(exercise):
    return {str(path.relative_to(exercise)) for pattern in ("solution.*", "starter/*", "wrong/*") for path in exercise.glob(pattern)}


def quotes_missing(exercise, printed):
    """Quotes of the judge in the sheet, `...` for a gap, that the judge said to none of the wrong programs."""
    table = (exercise / "README.md").read_text(encoding="utf-8").partition("## Common mistakes")[2]
    quotes = [quote for row in MISTAKE.findall(table) for quote in QUOTE.findall(row)]
    gaps = ((quote, [re.escape(part.strip(" ;,")) for part in quote.split("...")]) for quote in quotes)
    return [quote for quote, parts in gaps if not re.search(".*".join(parts), printed)]


def troubles_of(exercise):
    """The problems of an exercise, as lines."""
    done = subprocess.run([XR3, "exercise", "check", exercise], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        yield f"{exercise.name}:\n{done.stdout}{done.stderr}"
    proven = set(re.findall(r"^. ([^:\n]*?)(?:, run \d+)?$", done.stdout, re.MULTILINE))
    for program in programs_of(exercise) - proven:
        yield f"{exercise.name}/{program} is not run"
    for quote in quotes_missing(exercise, done.stdout):
        yield f"{exercise.name}/README.md: the judge does not say: {quote}"


def main():
    names = sorted(path.name for path in COURSE.iterdir() if path.is_dir())
    wanted = sys.argv[1:] or names
    unknown = [name for name in wanted if name not in names]
    if unknown:
        sys.exit(f"there is no exercise {unknown[0]}, but: {', '.join(names)}")
    failed = False
    for name in wanted:
        troubles = list(troubles_of(COURSE / name))
        failed = failed or bool(troubles)
        print("\n".join(troubles) or f"ok      {name}", flush=True)
    return failed


if __name__ == "__main__":
    sys.exit(main())
