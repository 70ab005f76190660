"""Judges a robot program with `xr3 exec`, for services that want the result in a form of their own.

    python3 -I xr3_judge.py vpl OPTIONS -- PROGRAM ARGS         comments and grade for Moodle's VPL
    python3 -I xr3_judge.py classroom OPTIONS -- PROGRAM ARGS   the output of a step for GitHub Classroom

and points(), for a test cell of nbgrader. OPTIONS are those of `xr3 exec`. XR3 names its executable, if it is
neither in PATH nor built in this checkout. With -I a submission that has a file json.py replaces no module.

No line that a service reads begins with what the program prints: see shown().
"""

import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SHOWN_LINES = 60  # of what the program prints
SHOWN_COLUMNS = 160
# Where services keep their secrets and read their results: the program does not get them.
PRIVATE = ("ACTIONS_", "CI_", "GITHUB_", "RUNNER_", "VPL_")
DEFAULT_GRADES = "0", "10"  # of a VPL activity that names none


class JudgeError(Exception):
    """The program was not judged: xr3 is missing, or an option or a file is wrong."""


def executable():
    """The path of xr3."""
    built = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "xr3"
    found = os.environ.get("XR3") or shutil.which("xr3") or (built.exists() and str(built))
    if not found:
        raise JudgeError("xr3 is not in PATH: install it, or name it with XR3=/path/to/xr3")
    return found


def judge(options, program):
    """(result, output): the result of the run and what the program printed, of several runs (--repeat) those of the
    worst, as in `xr3 grade`. Raises JudgeError."""
    with tempfile.TemporaryDirectory() as folder:
        listed, runs = pathlib.Path(folder, "results"), pathlib.Path(folder, "runs")
        environment = {name: value for name, value in os.environ.items() if not name.startswith(PRIVATE)}
        own_folder = [] if "--out" in options else ["--out", runs]
        if not own_folder:
            runs = pathlib.Path(options[options.index("--out") + 1])
        try:
            done = subprocess.run([executable(), "exec", *options, *own_folder, "--json", listed, "--quiet", "--",
                                   *program], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, env=environment, check=False)
        except OSError as error:
            raise JudgeError(f"xr3 cannot be started: {error}") from error
        if not listed.exists():
            raise JudgeError(done.stderr.decode(errors="replace").strip() or f"xr3 exec ended with {done.returncode}")
        results = [json.loads(line) for line in listed.read_text(encoding="utf-8").splitlines()]
        worst = min(range(len(results)), key=lambda i: (results[i]["points"], results[i]["passed"]))
        its = runs if len(results) == 1 else runs / f"{worst + 1:03}"
        which = "" if len(results) == 1 else f"Run {worst + 1} counts, the worst of {len(results)}"
        return {**results[worst], "which": which}, (its / "output.txt").read_bytes().decode(errors="replace")


def share(result):
    """The points, from 0 to 1."""
    return result["points"] / result["max_points"] if result["max_points"] else float(result["passed"])


def clean(line):
    """A line without characters that a service could take for the end of the line, or for a command."""
    return "".join(letter if letter.isprintable() else " " for letter in line)


def shown(output, mark):
    """The first lines that the program printed, each behind a mark. So none of them is a line of the service."""
    lines = output.splitlines()
    for line in lines[:SHOWN_LINES]:
        yield mark + clean(line[:SHOWN_COLUMNS])
    if len(lines) > SHOWN_LINES:
        yield f"{mark}and {len(lines) - SHOWN_LINES} more lines"


def report(result):
    """(what was checked, what was found) of a run, as lines without a line end."""
    if result["which"]:
        yield result["which"], []
    if result["why"]:
        yield f"✗ {clean(result['why'])}", []
    for goal in result["goals"]:
        found = [] if goal["met"] else [clean(goal["found"])]
        hint = [f"Hint: {clean(goal['hint'])}"] if goal["hint"] and not goal["met"] else []
        mark = "" if goal["counted"] else " (not counted)"
        yield f"{'✓' if goal['met'] else '✗'} {clean(goal['expected'])}{mark}", found + hint
    if result["not_counted"]:
        yield f"Not counted: {clean(result['not_counted'])}", []


def block(lines):
    """A comment of VPL: a line with - in front is a title, one with > is shown as it is."""
    return ["<|--", *lines, "--|>"]


def vpl_lines(result, output):
    """What VPL reads. Its last line is the grade, between the grades of the activity."""
    lowest, highest = (float(os.environ.get(name) or usual)
                       for name, usual in zip(("VPL_GRADEMIN", "VPL_GRADEMAX"), DEFAULT_GRADES))
    comment = []
    for title, found in report(result):
        comment += [f"-{title}", *found]
    if output:
        comment += ["-What the program printed", *shown(output, ">")]
    return [*block(comment), f"Grade :=>> {lowest + (highest - lowest) * share(result):.2f}"]


def classroom_lines(result):
    """The output `result` of a step, as the reporter of GitHub Classroom reads it: a test for each goal."""
    tests = []
    for goal in result["goals"]:
        has_points = goal["met"] and goal["counted"]
        found = goal["found"] if goal["counted"] else f"not counted: {result['not_counted']}"
        tests.append({"name": goal["expected"], "test_code": "", "filename": "", "line_no": 0,
                      "status": "pass" if has_points else "fail", "message": found,
                      "score": goal["points"] if has_points else 0})
    status = "error" if result["outcome"] != "finished" else "pass" if result["passed"] else "fail"
    every = {"version": 1, "status": status, "max_score": result["max_points"], "tests": tests}
    return ["result=" + base64.b64encode(json.dumps(every).encode()).decode()]


def use_utf8(*streams):
    """Services read UTF-8, whatever the locale of their machine is. The streams of a notebook have no other."""
    for stream in streams:
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")


def print_report(result, file):
    """The goals, for people."""
    for title, found in report(result):
        print(title, *found, sep="\n  ", file=file)


def points(program, *options, of=None):
    """Judges a program, a list such as ["python3", "pick.py"]; prints its goals, and returns its points: those of
    the goals, or a share of the points `of` a cell. As the last line of a test cell this is partial credit."""
    result, output = judge([str(option) for option in options], program)
    use_utf8(sys.stdout)
    print_report(result, sys.stdout)
    print(*shown(output, "| "), sep="\n")
    return (of if of is not None else result["max_points"]) * share(result)


def main(arguments):
    use_utf8(sys.stdout, sys.stderr)
    if len(arguments) < 3 or arguments[0] not in ("vpl", "classroom") or "--" not in arguments[:-1]:
        print(f"usage: {os.path.basename(__file__)} vpl|classroom OPTIONS -- PROGRAM ARGS", file=sys.stderr)
        return 2
    at = arguments.index("--")
    try:
        result, output = judge(arguments[1:at], arguments[at + 1:])
    except JudgeError as error:
        trouble = [clean(line) for line in str(error).splitlines()]
        if arguments[0] == "vpl":  # and no grade: the student can do nothing about it
            print(*block(["-The program was not judged. Please tell your teacher:", *(">" + each for each in trouble)]),
                  sep="\n")
        print(*trouble, sep="\n", file=sys.stderr)
        return 1
    if arguments[0] == "classroom":
        print_report(result, sys.stderr)
    print(*(vpl_lines(result, output) if arguments[0] == "vpl" else classroom_lines(result)), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
