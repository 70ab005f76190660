"""`select` and `selectors` over lines to the robot, files of makefile(), serial ports, and whatever
else has a fileno() of a line."""

import errno
import select as select_module
import selectors
from typing import Any, List, Optional, Sequence, Tuple

from xr3_page.bridge import robot
from xr3_page.clock import Deadline
from xr3_page.line import Line, lines, system_error

STEP_S = 0.001  # between two looks at several lines
LONG_STEP_S = 1.0  # of a wait for nothing
NO_POLL = "the page has no poll or epoll: use select.select() or selectors.DefaultSelector()"
ONLY_LINES = "in the page, select waits for connections to the robot only"
POLLERS = ("poll", "epoll", "devpoll", "kqueue")
POLL_SELECTORS = ("PollSelector", "EpollSelector", "DevpollSelector", "KqueueSelector")


def _line_of(waited: Any) -> Line:
    """The line of an object with a fileno(), or of such a number."""
    if not isinstance(waited, int) and not hasattr(waited, "fileno"):
        raise TypeError("argument must be an int, or have a fileno() method.")
    number = waited if isinstance(waited, int) else waited.fileno()
    if number < 0:
        raise ValueError(f"file descriptor cannot be a negative integer ({number})")
    line = lines.get(number)
    if line is None:
        raise system_error(errno.EBADF, ONLY_LINES)
    return line


def _wait(waited: Sequence[Line], left: Optional[float]) -> None:
    """Waits for a byte of the only line; a step if there are several lines or none."""
    if len(waited) == 1:
        waited[0].wait_readable(left)
    else:
        step = STEP_S if waited else LONG_STEP_S
        robot.sleep(step if left is None else min(step, left))


def select(rlist: Any, wlist: Any, xlist: Any, timeout: Optional[float] = None,
           /) -> Tuple[List[Any], List[Any], List[Any]]:
    """Waits until a line can be read or written, as select.select(). A line can be written at any
    time."""
    if timeout is not None and timeout < 0:
        raise ValueError("timeout must be non-negative")
    readers = [(each, _line_of(each)) for each in rlist]
    writable = [each for each in wlist if _line_of(each)]
    for each in xlist:  # which has no effect
        _line_of(each)
    deadline = Deadline(timeout)
    while True:
        readable = [each for each, line in readers if line.is_readable()]
        left = deadline.left()
        if readable or writable or left == 0:
            return readable, writable, []
        _wait([line for _, line in readers], left)


class LineSelector(selectors.SelectSelector):
    """Stands in for selectors.DefaultSelector."""

    _select = staticmethod(select)  # by which its base class waits


def no_poll(*_: Any, **__: Any) -> None:
    """Stands in for select.poll and its like: raises OSError."""
    raise system_error(errno.EOPNOTSUPP, NO_POLL)


def install() -> None:
    """Replaces the functions of `select` and the classes of `selectors`."""
    select_module.select = select
    selectors.DefaultSelector = selectors.SelectSelector = LineSelector
    for module, names in ((select_module, POLLERS), (selectors, POLL_SELECTORS)):
        for name in names:
            if hasattr(module, name):
                setattr(module, name, no_poll)
