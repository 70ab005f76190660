"""Runs a program as `python3 NAME` does: with a fresh `__main__`, and without the modules of the
program that ran before."""

import contextlib
import os
import socket
import sys
import types
from typing import Any, Iterator, Mapping, Sequence, Union

import xr3_page
from xr3_page import folder, line, report
from xr3_page.bridge import from_js

STOPPED = 130  # the exit code of a program that SIGINT ends
OF_A_RUN = ("argv", "path", "stdin", "stdout", "stderr", "dont_write_bytecode")  # names in sys


def run(source_files: Mapping[str, Union[str, bytes]], name: str, argv: Sequence[str] = (),
        environ: Mapping[str, str] = types.MappingProxyType({})) -> int:
    """Writes the source files, by name, and runs the one called `name` with the arguments `argv` and
    these additions to the environment. Returns its exit code. The arguments may be JavaScript
    objects."""
    folder.write(from_js(source_files))
    with _restoring():
        _prepare(name, from_js(argv), from_js(environ))
        return _exit_code(os.path.join(folder.PATH, name))


@contextlib.contextmanager
def _restoring() -> Iterator[None]:
    """Undoes at the end what a run has changed, and closes the connections that it has left open."""
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
    sys.dont_write_bytecode = True  # it would be mistaken for that of a file changed within a second
    os.environ.update(environ)
    os.chdir(folder.PATH)


def _exit_code(path: str) -> int:
    """Executes a file; returns the exit code, after a message if the program has failed."""
    try:
        _execute(path)
        return 0
    except SystemExit as leaving:
        return _code_of(leaving.code)
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        return STOPPED
    except BaseException as error:
        print(report.text_of(error), end="", file=sys.stderr)
        return 1
    finally:
        sys.stdout.flush()
        sys.stderr.flush()


def _execute(path: str) -> None:
    main = types.ModuleType("__main__")
    main.__file__ = path
    sys.modules["__main__"] = main
    with open(path, "rb") as file:
        code = compile(file.read(), path, "exec", dont_inherit=True)
    exec(code, vars(main))


def _code_of(code: Any) -> int:
    """The exit code for the argument of SystemExit; prints it if it is a message."""
    if code is None or isinstance(code, int):
        return int(code or 0)
    print(code, file=sys.stderr)
    return 1
