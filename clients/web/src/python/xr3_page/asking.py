"""Input from the user: input() and sys.stdin ask in the page."""

import builtins
import io
import sys
from typing import Any

from xr3_page.bridge import robot

_read_stdin = builtins.input


class Keyboard(io.TextIOBase):
    """Stands in for sys.stdin: each line is asked for."""

    _rest = ""  # of a line that was read in part

    def readable(self) -> bool:
        """Whether the file can be read: always."""
        return True

    def isatty(self) -> bool:
        """Whether a user is at the other end: always."""
        return True

    def readline(self, size: int = -1, /) -> str:
        """Reads a line, or at most `size` characters of it; empty at the end of input."""
        line = self._rest or self._asked()
        part = line if size < 0 else line[:size]
        self._rest = line[len(part):]
        return part

    def _asked(self) -> str:
        sys.stdout.flush()
        line = robot.ask("")
        return "" if line is None else line + "\n"

    def read(self, size: int = -1, /) -> str:
        """Reads to the end of input, or at most `size` characters of a line."""
        return "".join(self) if size < 0 else self.readline(size)


def ask(prompt: Any = "", /) -> str:
    """Asks the user for a line, as input(). A program that has replaced sys.stdin reads that."""
    if not isinstance(sys.stdin, Keyboard):
        return _read_stdin(prompt)
    sys.stdout.flush()
    line = robot.ask(str(prompt))
    if line is None:
        raise EOFError("EOF when reading a line")
    return line


def install() -> None:
    """Replaces input() and sys.stdin."""
    builtins.input = ask
    sys.stdin = Keyboard()
