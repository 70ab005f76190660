"""Runs a program against a fresh robot and judges it, by `xr3 exec`."""

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Union

from xr3.program import FilePath, ServerError, program_file, shown, start, words

JUDGED = (0, 5, 6, 7, 8)  # exit codes of a run that was judged


@dataclass(frozen=True)
class Verdict:
    """The verdict of `judge()`. `code` is the exit code of `xr3 exec`: 0 if all goals are met, 5 if
    one is missed, 6 if the program failed, 7 if a limit was reached, 8 if repeated runs differ.
    `runs` has the object that `--json` writes for each run, with members such as `points`,
    `max_points`, `goals`, `ticks` (simulated ms) and `outcome`. `text`, and `str()`, is what the
    program and the judge have printed."""

    code: int
    runs: List[Dict[str, Any]]
    text: str

    @property
    def passed(self) -> bool:
        """Whether the program ended well and met all goals, in each run."""
        return self.code == 0

    def __str__(self) -> str:
        return self.text


def judge(program: Union[FilePath, Sequence[FilePath]], *, goals: Optional[FilePath] = None,
          clock: Optional[str] = None, xr3_program: Optional[FilePath] = None,
          **options: Any) -> Verdict:
    """Runs a program against a fresh robot by `xr3 exec`, and returns the verdict:
    `verdict = judge("my_program.py", goals="goals.json")`, then `assert verdict.passed, verdict`.

    `program` is a path, which this Python runs if it ends in `.py`, or a list of the words of a
    command. `goals` is a file of goals, `clock` by default `bytes`. Further options are those of
    `xr3 exec`, as for `Server`: `judge(["./a.out", "-v"], exercise="07-pick", max_seconds=10)`.
    `xr3_program` is the path of xr3, which `Server` calls `program`.

    A program that cannot be started or fails has a verdict, too. Raises ServerError if there is
    none: an option or a file is wrong, or xr3 cannot be started."""
    with tempfile.TemporaryDirectory(prefix="xr3-") as folder:
        options = {"goals": goals, "clock": clock, "json": Path(folder, "verdict.json"), **options}
        command = [program_file(xr3_program), "exec", *words(options), "--", *_command(program)]
        process = start(command, stdin=None if options.get("stdin") else subprocess.DEVNULL,
                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        text = shown(_output(process))
        runs = _runs(Path(options["json"]))
    if process.returncode not in JUDGED or not runs:
        raise ServerError(f"xr3 exec did not judge, exit code {process.returncode}: {text}")
    return Verdict(process.returncode, runs, text)


def _command(program: Union[FilePath, Sequence[FilePath]]) -> List[str]:
    if not isinstance(program, (str, os.PathLike)):
        return [os.fspath(word) for word in program]
    path = os.path.join(".", os.fspath(program))
    return [sys.executable, path] if path.endswith(".py") else [path]


def _output(process: "subprocess.Popen[bytes]") -> bytes:
    with process:
        try:
            return process.communicate()[0]
        except BaseException:
            process.terminate()  # ends the run; what it has started ends with it
            raise


def _runs(file: Path) -> List[Dict[str, Any]]:
    try:
        return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
    except (FileNotFoundError, ValueError):
        return []
