"""The course of docs/course: each solution in Python and C meets all goals, and each of the five wrong programs of an
exercise fails for the reason in its first line, `# expects: KIND: PART OF WHAT THE JUDGE SAYS`, or `# expects: failed`
or `# expects: time_up`. The starter runs without an error and gets no points; nor does an empty program, or one with a
syntax error. Each sentence of the judge that a sheet quotes is said to one of its wrong programs.
Run by `./test --course`. Usage: course_runs.py [EXERCISE...]; the environment has XR3 and XR3_ROOT."""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from support import ROOT, XR3

COURSE = pathlib.Path(ROOT, "docs/course")
COMMAND = re.compile(r"^xr3 exec (.*?) -- python3 (\S+)$", re.MULTILINE)
MISTAKE = re.compile(r"^\| .* \| (.*) \|$", re.MULTILINE)  # a row of the last table of a sheet
QUOTE = re.compile(r"`([^`]*[ _][^`]*)`")  # a sentence, or the code of a warning
WRONG_PROGRAMS = 5
JOBS = 8


def sheet_command(exercise):
    """(the options of `xr3 exec`, the program) of the first command that the sheet shows."""
    options, program = COMMAND.search((exercise / "README.md").read_text(encoding="utf-8")).groups()
    return options.split(), program


def options_of(exercise):
    return sheet_command(exercise)[0]


def starter_of(exercise):
    return exercise / "starter" / sheet_command(exercise)[1]


def judged(exercise, command):
    """(the report, what was printed) of a run."""
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder, "result.json")
        environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(ROOT, "clients/python"))}
        done = subprocess.run([XR3, "exec", *options_of(exercise), "--json", result, "--quiet", "--",
                               *map(str, command)], cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
        assert result.exists(), done.stderr
        return json.loads(result.read_text(encoding="utf-8")), done.stdout


def check_solution(exercise, command):
    """(whether all is as it should be, what was printed); check_wrong the same."""
    report, printed = judged(exercise, command)
    return report["passed"], printed


def check_wrong(exercise, program):
    wanted = re.match(r"# expects: (\w+)(?:: (.*))?$", program.read_text(encoding="utf-8").splitlines()[0])
    kind, part = wanted.groups()
    report, printed = judged(exercise, [sys.executable, program])
    if part is None:
        return report["outcome"] == kind, printed
    is_found = any(goal["kind"] == kind and not goal["met"] and part in goal["found"] for goal in report["goals"])
    return is_found, printed if is_found else f"not found: {kind}: {part}\n{printed}"


def check_nothing(exercise, text):
    report, printed = judged(exercise, [sys.executable, "-c", text])
    return report["points"] == 0, printed


def check_starter(exercise):
    report, printed = judged(exercise, [sys.executable, starter_of(exercise)])
    return (report["outcome"], report["points"]) == ("finished", 0), printed


def quotes_missing(exercise, printed):
    """What the sheet quotes from the judge, `...` for a gap, and the judge said to none of the wrong programs."""
    table = (exercise / "README.md").read_text(encoding="utf-8").partition("## Common mistakes")[2]
    quotes = [quote for row in MISTAKE.findall(table) for quote in QUOTE.findall(row)]
    gaps = ((quote, [re.escape(part.strip(" ;,")) for part in quote.split("...")]) for quote in quotes)
    return [quote for quote, parts in gaps if not re.search(".*".join(parts), printed)]


def tasks(exercise, folder):
    """(name, function, arguments) of every run of an exercise."""
    binary = pathlib.Path(folder, exercise.name)
    subprocess.run(["gcc", "-std=c11", "-Wall", "-Werror", f"-I{COURSE}", "-o", binary, exercise / "solution.c", "-lm"],
                   check=True)
    yield "solution.py", check_solution, (exercise, [sys.executable, exercise / "solution.py"])
    yield "solution.c", check_solution, (exercise, [binary])
    programs = sorted((exercise / "wrong").glob("*.py"))
    assert len(programs) == WRONG_PROGRAMS, f"{exercise.name}: {len(programs)} wrong programs"
    for program in programs:
        yield f"wrong/{program.name}", check_wrong, (exercise, program)
    yield f"starter/{starter_of(exercise).name}", check_starter, (exercise,)
    yield "an empty program", check_nothing, (exercise, "")
    yield "a syntax error", check_nothing, (exercise, "this is no Python")


def main():
    wanted = sys.argv[1:] or sorted(path.name for path in COURSE.iterdir() if path.is_dir())
    unknown = [name for name in wanted if not (COURSE / name).is_dir()]
    if unknown:
        names = ", ".join(sorted(path.name for path in COURSE.iterdir() if path.is_dir()))
        sys.exit(f"there is no exercise {unknown[0]}, but: {names}")
    failed = 0
    printed = dict.fromkeys(wanted, "")
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        runs = [(name, what, pool.submit(function, *arguments)) for name in wanted
                for what, function, arguments in tasks(COURSE / name, folder)]
        for name, what, run in runs:
            is_good, said = run.result()
            failed += not is_good
            print(f"ok      {name}/{what}" if is_good else f"FAILED  {name}/{what}\n{said}", flush=True)
            printed[name] += said
    for name in wanted:
        for quote in quotes_missing(COURSE / name, printed[name]):
            failed += 1
            print(f"FAILED  {name}/README.md: the judge does not say: {quote}")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
