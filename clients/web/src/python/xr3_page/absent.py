"""Threads and processes, which a program in the page does not have: clear errors in place of those
of Python. Without other threads, a wait for one of them with a timeout is a sleep."""

import _thread
import errno
import os
import subprocess
import threading
from typing import Any, Optional

from xr3_page.bridge import robot
from xr3_page.line import system_error

NO_THREADS = "a program in the page has no threads: run it beside `xr3 serve`"
NO_PROCESSES = "a program in the page cannot start others: run it beside `xr3 serve`"


def start_thread(*_: Any, **__: Any) -> None:
    """Stands in for Thread.start(): raises RuntimeError."""
    raise RuntimeError(NO_THREADS)


def start_process(*_: Any, **__: Any) -> None:
    """Stands in for the start of a process: raises OSError."""
    raise system_error(errno.EOPNOTSUPP, NO_PROCESSES)


def wait(condition: threading.Condition, timeout: Optional[float] = None) -> bool:
    """Stands in for Condition.wait(), and so for Event.wait(): nothing can notify the condition."""
    if not condition._is_owned():
        raise RuntimeError("cannot wait on un-acquired lock")
    if timeout is None:
        raise RuntimeError(f"this would wait for ever: {NO_THREADS}")
    robot.sleep(max(0.0, timeout))
    return False


def install() -> None:
    """Replaces the functions that start threads and processes, or wait for threads."""
    _thread.start_new_thread = threading.Thread.start = start_thread
    threading.Condition.wait = wait
    subprocess.Popen.__init__ = os.system = start_process
