"""The text of an exception that has ended a program: a traceback with the program's own frames, in
which files have the names that the user gave them."""

import traceback
from typing import Iterator, Optional

from xr3_page.folder import own_name


def text_of(error: BaseException) -> str:
    """The traceback, as Python prints it."""
    shown = traceback.TracebackException.from_exception(error, compact=True)
    for each in _all(shown):
        _keep_own(each)
    return "".join(shown.format())


def _all(shown: Optional[traceback.TracebackException]) -> Iterator[traceback.TracebackException]:
    """The exception, those that it came of, and those of a group."""
    if shown is None:
        return
    yield shown
    for other in (shown.__cause__, shown.__context__, *(getattr(shown, "exceptions", None) or ())):
        yield from _all(other)


def _keep_own(shown: traceback.TracebackException) -> None:
    own = [frame for frame in shown.stack if own_name(frame.filename)]
    for frame in own:
        frame.filename = own_name(frame.filename)
    shown.stack = traceback.StackSummary.from_list(own) or None  # without frames, no heading
    if getattr(shown, "filename", None):  # of a SyntaxError
        shown.filename = own_name(shown.filename) or shown.filename
