"""Runs tests, and programs, with the Python package of the page: clients/web/src/python/xr3_page, which stands in for
sockets, pyserial, clocks and input."""

import errno
import faulthandler
import functools
import io
import os
import pathlib
import socket
import sys
import tempfile
import traceback
import unittest
import warnings

from page_robots import ScriptedRobot

DEADLINE_S = 20.0
CHECKOUT = pathlib.Path(__file__).resolve().parents[2]

sys.path.insert(0, str(CHECKOUT / "clients" / "web" / "src" / "python"))
import xr3_page.run  # noqa: E402


def forked(work):
    """Runs work() in a child process, in a folder of its own. Raises AssertionError with the child's traceback."""
    reads, writes = os.pipe()
    with tempfile.TemporaryDirectory(prefix="xr3-") as folder:
        child = os.fork()
        if child == 0:
            os.close(reads)
            text = ""
            faulthandler.dump_traceback_later(DEADLINE_S, exit=True)
            try:
                os.chdir(folder)
                work()
            except BaseException:
                text = traceback.format_exc()
            os.write(writes, text.encode()[:60000])  # fits into a pipe
            os._exit(0)
        os.close(writes)
        with open(reads, encoding="utf-8") as pipe:
            text = pipe.read()
        _, status = os.waitpid(child, 0)
    if text or status:
        raise AssertionError(f"in the child process, which ended with {status}:\n{text}")


def in_page(test):
    """Runs a test in a child process with the package; the test is given a robot, which it may script."""
    @functools.wraps(test)
    def wrapper(self):
        def work():
            robot = ScriptedRobot()
            install(robot)
            test(self, robot)
        forked(work)
    return wrapper


def install(robot):
    warnings.simplefilter("error")
    xr3_page.folder.PATH = os.path.abspath("program")
    xr3_page.install(robot)


def run(files, name="main.py", argv=(), environ=None):
    """Runs a program; returns its exit code, and what it wrote to its standard output and error."""
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = written = io.StringIO(), io.StringIO()
    try:
        code = xr3_page.run.run({name: files} if isinstance(files, str) else files, name, argv, environ or {})
    finally:
        sys.stdout, sys.stderr = before
    return (code, *(file.getvalue() for file in written))


def connected(port=9600, timeout=None):
    return socket.create_connection(("localhost", port), timeout)


class Case(unittest.TestCase):
    def assertFails(self, code, function, *arguments, **named):
        """Calls a function, which must raise OSError with this code; returns its text."""
        with self.assertRaises(OSError) as caught:
            function(*arguments, **named)
        self.assertEqual(errno.errorcode[code], errno.errorcode.get(caught.exception.errno), caught.exception)
        return caught.exception.strerror
