"""The class in place of socket.socket: a TCP stream to the robot or to its monitor. Whatever the
host and the port, the robot is at the other end; the monitor is at its own port."""

import errno
import itertools
import math
import os
import socket
import weakref
from typing import Any, Optional, Tuple

from xr3_page.bridge import CLOSED_BY_ROBOT, robot
from xr3_page.clock import Deadline

FIRST_NUMBER = 1000  # above every file descriptor that a program has in a page
FIRST_LOCAL_PORT = 49152
TYPE_MASK = 0xF  # the other bits of a type are SOCK_NONBLOCK and SOCK_CLOEXEC
CANNOT_LISTEN = "a program in the page cannot listen: run it beside `xr3 serve`"
ONLY_TCP = "a program in the page has TCP to the robot only: run it beside `xr3 serve`"
NO_DESCRIPTORS = "a socket in the page has no file descriptor: run the program beside `xr3 serve`"

lines: "weakref.WeakValueDictionary[int, Line]" = weakref.WeakValueDictionary()  # by fileno()
_numbers = itertools.count(FIRST_NUMBER)


def system_error(code: int, text: str = "") -> OSError:
    """An error with the code and, if no text is given, the system's text for it."""
    return OSError(code, text or os.strerror(code))


def _refusal(text: str) -> Any:
    """A method that raises OSError with the text."""
    def refuse(self: "Line", *_: Any, **__: Any) -> None:
        raise system_error(errno.EOPNOTSUPP, text)
    return refuse


def _check_kind(family: int, kind: int, fileno: Optional[int]) -> None:
    if fileno is not None:
        raise system_error(errno.EOPNOTSUPP, NO_DESCRIPTORS)
    if family not in (-1, socket.AF_INET, socket.AF_INET6):
        raise system_error(errno.EOPNOTSUPP, ONLY_TCP)
    if kind != -1 and kind & TYPE_MASK != socket.SOCK_STREAM:
        raise system_error(errno.EOPNOTSUPP, ONLY_TCP)


def _check_address(address: Any) -> int:
    """Returns the port of an address. Raises what connect() of a TCP socket raises."""
    if not isinstance(address, tuple):
        raise TypeError(f"AF_INET address must be tuple, not {type(address).__name__}")
    host, port = address[:2]
    if not isinstance(host, (str, bytes, bytearray)):
        raise TypeError(f"str, bytes or bytearray expected, not {type(host).__name__}")
    if not isinstance(port, int):
        raise TypeError(f"'{type(port).__name__}' object cannot be interpreted as an integer")
    if not 0 <= port <= 65535:
        raise OverflowError("connect(): port must be 0-65535.")
    return port


def _monitor_port() -> int:
    given = os.environ.get("XR3_MONITOR_PORT", "")
    return int(given) if given.isdecimal() else robot.monitor_port


class Line:
    """Stands in for socket.socket, with its methods, timeouts and errors."""

    _is_open = False  # until __init__ is through

    def __init__(self, family: int = -1, type: int = -1, proto: int = -1,
                 fileno: Optional[int] = None) -> None:
        _check_kind(family, type, fileno)
        self.family = socket.AF_INET if family == -1 else family
        self.type, self.proto = socket.SOCK_STREAM, max(0, proto)
        self._timeout = socket.getdefaulttimeout()
        self._line: Optional[int] = None  # the robot's number, once connected
        self._peer: Tuple[Any, ...] = ()
        self._can_receive = self._can_send = True
        self._closed, self._io_refs = False, 0  # names that makefile() and its files use
        self._number, self._is_open = next(_numbers), True
        lines[self._number] = self

    # --- Connecting.

    def connect(self, address: Tuple[Any, ...]) -> None:
        """Connects to the monitor if the address has its port, else to the robot."""
        self._check_open()
        port = _check_address(address)
        if self._line is not None:
            raise system_error(errno.EISCONN)
        self._line = robot.open_monitor() if port == _monitor_port() else robot.open()
        self._peer = address

    def connect_ex(self, address: Tuple[Any, ...]) -> int:
        """Connects; returns the code of an error, else 0."""
        try:
            self.connect(address)
        except OSError as error:
            return error.errno or errno.ECONNREFUSED
        return 0

    bind = listen = accept = _refusal(CANNOT_LISTEN)
    recvfrom = recvfrom_into = recvmsg = recvmsg_into = sendto = sendmsg = _refusal(ONLY_TCP)
    dup = detach = _refusal(NO_DESCRIPTORS)

    def _check_open(self) -> None:
        if not self._is_open:
            raise system_error(errno.EBADF)

    def _connected(self) -> int:
        """Returns the robot's number of the line. Raises OSError if it is not connected."""
        self._check_open()
        if self._line is None:
            raise system_error(errno.ENOTCONN)
        return self._line

    # --- Sending and receiving.

    def send(self, data: Any, flags: int = 0, /) -> int:
        """Sends bytes; returns how many of them were taken."""
        return self._send(memoryview(data).cast("B"), self._wait(flags), flags)

    def sendall(self, data: Any, flags: int = 0, /) -> None:
        """Sends all bytes; the timeout is for all of them together."""
        rest = memoryview(data).cast("B")
        self._connected()
        deadline = Deadline(self._wait(flags))
        while rest:
            rest = rest[self._send(rest, deadline.left(), flags):]

    def _send(self, data: memoryview, wait: Optional[float], flags: int) -> int:
        line = self._connected()
        if not self._can_send:
            raise system_error(errno.EPIPE)
        taken = robot.send(line, data.tobytes(), wait)
        if taken == CLOSED_BY_ROBOT:
            raise system_error(errno.ECONNRESET)
        if not taken and data:
            raise self._too_late(flags)
        return taken

    def recv(self, size: int, flags: int = 0, /) -> bytes:
        """Receives at least one byte and at most `size`; b"" at the end."""
        if size < 0:
            raise ValueError("negative buffersize in recv")
        data = self._receive(size, flags)
        if flags & socket.MSG_WAITALL and self._timeout is None:
            while len(data) < size and (part := self._receive(size - len(data), 0)):
                data += part
        return data

    def _receive(self, size: int, flags: int) -> bytes:
        line = self._connected()
        if size == 0 or not self._can_receive:
            return b""
        data = robot.receive(line, size, self._wait(flags), bool(flags & socket.MSG_PEEK))
        if data is None:
            raise self._too_late(flags)
        return data

    def recv_into(self, buffer: Any, nbytes: int = 0, flags: int = 0) -> int:
        """Receives into a buffer; returns the number of bytes."""
        view = memoryview(buffer).cast("B")
        if nbytes < 0 or nbytes > len(view):
            raise ValueError("negative buffersize in recv_into" if nbytes < 0 else
                             "buffer too small for requested bytes")
        data = self.recv(nbytes or len(view), flags)
        view[:len(data)] = data
        return len(data)

    def _wait(self, flags: int) -> Optional[float]:
        return 0 if flags & socket.MSG_DONTWAIT else self._timeout

    def _too_late(self, flags: int) -> OSError:
        return system_error(errno.EAGAIN) if self._wait(flags) == 0 else TimeoutError("timed out")

    # --- Waiting, for select() and pyserial.

    def waiting(self) -> int:
        """The number of bytes that can be read at once; -1 at the end of the line."""
        return robot.waiting(self._connected())

    def is_readable(self) -> bool:
        """Whether recv() would return, or fail, at once."""
        return self._line is None or not self._can_receive or self.waiting() != 0

    def wait_readable(self, timeout: Optional[float]) -> None:
        """Waits until a byte can be read, or for `timeout` seconds."""
        robot.receive(self._connected(), 1, timeout, peek=True)

    # --- Files and closing.

    makefile = socket.socket.makefile  # it needs recv_into(), send() and the names above

    def _decref_socketios(self) -> None:
        """Called by each file of makefile() when it is closed."""
        self._io_refs = max(0, self._io_refs - 1)
        if self._closed:
            self.close()

    def shutdown(self, how: int, /) -> None:
        """Ends sending, receiving or both."""
        line = self._connected()
        if how not in (socket.SHUT_RD, socket.SHUT_WR, socket.SHUT_RDWR):
            raise system_error(errno.EINVAL)
        if how != socket.SHUT_WR:
            self._can_receive = False
        if how != socket.SHUT_RD and self._can_send:
            self._can_send = False
            robot.finish(line)

    def close(self) -> None:
        """Closes the connection, or leaves that to the last open file of makefile()."""
        self._closed = True
        if self._io_refs == 0:
            self.release()

    def release(self) -> None:
        """Closes the connection at once."""
        line, self._line = self._line, None
        self._is_open = False
        lines.pop(self._number, None)
        if line is not None:
            robot.close(line)

    def __enter__(self) -> "Line":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if self._is_open:
            self.release()

    # --- Options and names.

    def settimeout(self, value: Optional[float], /) -> None:
        """Sets the timeout in simulated seconds: 0 never waits, None waits for ever."""
        if value is not None and (math.isnan(value) or value < 0):
            raise ValueError("Timeout value out of range")
        self._timeout = None if value is None else float(value)

    def gettimeout(self) -> Optional[float]:
        """Returns the timeout in seconds."""
        return self._timeout

    timeout = property(gettimeout)

    def setblocking(self, flag: bool, /) -> None:
        """Sets no timeout, or a timeout of 0."""
        self._timeout = None if flag else 0.0

    def getblocking(self) -> bool:
        """Whether the socket may wait."""
        return self._timeout != 0

    def setsockopt(self, *_: Any) -> None:
        """Has no effect: a line of the page has no options."""
        self._check_open()

    def getsockopt(self, level: int, option: int, buflen: int = 0, /) -> Any:
        """Returns zeros."""
        self._check_open()
        return bytes(buflen) if buflen else 0

    def getpeername(self) -> Tuple[Any, ...]:
        """Returns the address that the program has connected to."""
        self._connected()
        return self._peer

    def getsockname(self) -> Tuple[str, int]:
        """Returns an address of this computer."""
        self._check_open()
        if self._line is None:
            return "0.0.0.0", 0
        return "127.0.0.1", FIRST_LOCAL_PORT + self._number - FIRST_NUMBER

    def fileno(self) -> int:
        """Returns a number that select() knows, and nothing else; -1 once closed."""
        return self._number if self._is_open else -1


def close_all() -> None:
    """Closes every connection that a program has left open."""
    for line in list(lines.values()):
        line.release()
