"""Runs a program as `python3 NAME` does: with a fresh `__main__`, and without the modules of the
program that ran before."""

import contextlib
import os
import socket
import sys
import types
from typing import Any, Iterator, Mapping, Sequence, Tuple, Union

import xr3_page
from xr3_page import folder, line, report
from xr3_page.bridge import from_js

STOPPED = 130  # the exit code of a program that SIGINT ends
OF_A_RUN = ("argv", "path", "stdin", "stdout", "stderr", "dont_write_bytecode")  # names in sys


def run(source_files: Mapping[str, Union[str, bytes]], name: str, argv: Sequence[str] = (),
        environ: Mapping[str, str] = types.MappingProxyType({})) -> int:
    """Writes the source files, by name, and runs the one called `name` with the arguments `argv`
    and these additions to the environment. Returns its exit code. The arguments may be JavaScript
    objects."""
    folder.write(from_js(source_files))
    with _restoring():
        _prepare(name, from_js(argv), from_js(environ))
        code, message = _outcome(os.path.join(folder.PATH, name))
    sys.stdout.flush()
    print(message, end="", file=sys.stderr, flush=True)
    return code


@contextlib.contextmanager
def _restoring() -> Iterator[None]:
    """Undoes at the end what a run has changed, and closes connections that it has left open."""
    environment, here, main = dict(os.environ), os.getcwd(), sys.modules["__main__"]
    saved = {name: getattr(sys, name) for name in OF_A_RUN}
    try:
        yield
    finally:
        vars(sys).update(saved)
        os.environ.clear()
        os.environ.update(environment)
        os.chdir(here)
        sys.modules["__main__"] = main
        line.close_all()
        folder.forget_modules()


def _prepare(name: str, argv: Sequence[str], environ: Mapping[str, str]) -> None:
    xr3_page.replace()
    socket.setdefaulttimeout(None)
    sys.argv = [name, *argv]
    sys.path = [folder.PATH, *sys.path]
    sys.dont_write_bytecode = True  # or a change within a second would be missed
    os.environ.update(environ)
    os.chdir(folder.PATH)


def _outcome(path: str) -> Tuple[int, str]:
    """Executes a file; returns the exit code, and what to say if the program has failed."""
    try:
        _execute(path)
    except SystemExit as leaving:
        return _outcome_of_exit(leaving.code)
    except KeyboardInterrupt:
        return STOPPED, "stopped\n"
    except BaseException as error:
        return 1, report.text_of(error)
    return 0, ""


def _execute(path: str) -> None:
    main = types.ModuleType("__main__")
    main.__file__ = path
    sys.modules["__main__"] = main
    with open(path, "rb") as file:
        code = compile(file.read(), path, "exec", dont_inherit=True)
    exec(code, vars(main))


def _outcome_of_exit(argument: Any) -> Tuple[int, str]:
    """The exit code and the message for the argument of SystemExit."""
    if argument is None or isinstance(argument, int):
        return int(argument or 0), ""
    return 1, f"{argument}\n"
