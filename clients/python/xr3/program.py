"""The program xr3 for Server and judge(): where it is, whether its version is that of the package,
its command line and its environment.
"""

import functools
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Union

import xr3

FilePath = Union[str, "os.PathLike[str]"]
VERSION_S = 20.0  # for `xr3 --version`
KEPT = "XR3_DATA"  # the variable XR3_… of the caller that the program gets: the folder of its data


class ServerError(Exception):
    """The program xr3 is missing, has another version than the package, does not start, or does not
    accept its arguments. The message has what the program printed."""


def program_file(program: Optional[FilePath]) -> str:
    """The path of the program: this one, else the variable XR3, else beside this Python, where pip
    installs it, else on PATH. Raises ServerError if there is none, or if it is of another version."""
    file = os.fspath(program) if program is not None else _found()
    _check_version(file)
    return file


def _found() -> str:
    if sys.platform == "emscripten":
        raise ServerError("a program in the page cannot start others: xr3.Robot() drives the robot "
                          "of the page")
    folder = Path(sys.executable or "/").parent
    found = os.environ.get("XR3") or shutil.which("xr3", path=str(folder)) or shutil.which("xr3")
    if not found:
        raise ServerError("there is no program xr3: the variable XR3 is not set, and neither "
                          f"{folder} nor a folder of PATH has it. Install the wheel for Linux, or set "
                          "XR3 to the path of the program")
    return found


@functools.lru_cache(maxsize=None)
def _check_version(file: str) -> None:
    """Once for each program, since it takes as long as a start."""
    with start([file, "--version"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
               stderr=subprocess.STDOUT) as process:
        try:
            said = process.communicate(timeout=VERSION_S)[0]
        except subprocess.TimeoutExpired:
            process.kill()
            raise ServerError(f"{file} --version has not ended after {VERSION_S:g} s: is it the program "
                              "xr3?") from None
    version = re.match(rb"xr3 (\S+) ", said)
    if not version:
        raise ServerError(f"{file} is not the program xr3: --version prints {shown(said)!r}")
    if version[1].decode() != xr3.__version__:
        raise ServerError(f"{file} has the version {version[1].decode()}, and the Python package "
                          f"{xr3.__version__}: install both from one wheel, or set the variable XR3 to a "
                          "program of the package's version")


def start(command: List[str], **streams: Any) -> "subprocess.Popen[bytes]":
    """Starts the program in the environment() of its own. Raises ServerError if that fails."""
    try:
        return subprocess.Popen(command, env=environment(), **streams)
    except OSError as error:
        raise ServerError(f"{command[0]} cannot be started: {error.strerror or error}") from None


def environment() -> Dict[str, str]:
    """The environment of the caller without variables XR3_…, which are options of the program."""
    return {name: value for name, value in os.environ.items()
            if name == KEPT or not name.startswith("XR3_")}


def words(options: Mapping[str, object]) -> List[str]:
    """Options as arguments: `robot_port=0` is --robot-port=0, a list repeats its option, True is a
    flag, and None and False leave it out."""
    found = []
    for name, value in options.items():
        word = "--" + name.replace("_", "-")
        for each in value if isinstance(value, (list, tuple)) else [value]:
            if each is True:
                found.append(word)
            elif each is not None and each is not False:
                found.append(f"{word}={os.fspath(each) if isinstance(each, os.PathLike) else each}")
    return found


def shown(said: bytes) -> str:
    """Text that the program printed, without the token of a run."""
    return re.sub(r"(#token=)\S+", r"\1…", said.decode(errors="replace").strip())
