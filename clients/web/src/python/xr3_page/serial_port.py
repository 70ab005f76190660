"""The class in place of pyserial's Serial. Every port is the robot's; URLs with a host and a port
may also name the monitor's. Speed and frame are checked, and have no effect."""

import io
import math
import time
from typing import Any, Callable, Optional, Tuple
from urllib.parse import urlsplit

from xr3_page.clock import Deadline
from xr3_page.line import Line

ROBOT_ADDRESS = ("localhost", 9600)
SCHEMES = ("rfc2217", "socket")
PARITIES = "NEOMS"
STOP_BITS = (1, 1.5, 2)


class SerialException(OSError):
    """An error of a serial port."""

    __module__ = "serial"


class SerialTimeoutException(SerialException):
    """A write took longer than the port's write_timeout."""

    __module__ = "serial"


class PortNotOpenError(SerialException):
    """The port is not open."""

    __module__ = "serial"

    def __init__(self) -> None:
        super().__init__("Attempting to use a port that is not open")


def _address(port: str) -> Tuple[str, int]:
    """The host and port of a URL; those of the robot for the name of a device."""
    if "://" not in port:
        return ROBOT_ADDRESS
    url = urlsplit(port)
    if url.scheme not in SCHEMES:
        raise SerialException(f"in the page, {port} is no port: give rfc2217://HOST:PORT, "
                              "socket://HOST:PORT or the name of a device")
    if url.port is None:
        raise SerialException(f"{port} has no port number, as in {url.scheme}://localhost:9600")
    return url.hostname or "localhost", url.port


def _is_timeout(value: Any) -> bool:
    return value is None or not math.isnan(value) and value >= 0


class Setting:
    """An attribute of a port that takes only valid values."""

    def __init__(self, is_valid: Callable[[Any], bool]) -> None:
        self._is_valid = is_valid

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __set__(self, port: Any, value: Any) -> None:
        if not self._is_valid(value):
            raise ValueError(f"Not a valid {self._name}: {value!r}")
        port.__dict__[self._name] = value


class Serial(io.RawIOBase):
    """Stands in for serial.Serial, with its timeouts and errors."""

    __module__ = "serial"
    baudrate = Setting(lambda value: int(value) > 0)
    bytesize = Setting(range(5, 9).__contains__)
    parity = Setting(lambda value: value in tuple(PARITIES))
    stopbits = Setting(STOP_BITS.__contains__)
    timeout = Setting(_is_timeout)
    write_timeout = Setting(_is_timeout)
    inter_byte_timeout = Setting(_is_timeout)

    _line: Optional[Line] = None

    def __init__(self, port: Optional[str] = None, baudrate: int = 9600, bytesize: int = 8,
                 parity: str = "N", stopbits: float = 1, timeout: Optional[float] = None,
                 xonxoff: bool = False, rtscts: bool = False,
                 write_timeout: Optional[float] = None, dsrdtr: bool = False,
                 inter_byte_timeout: Optional[float] = None,
                 exclusive: Optional[bool] = None) -> None:
        super().__init__()
        self.port, self.exclusive = port, exclusive
        self.baudrate, self.bytesize = baudrate, bytesize
        self.parity, self.stopbits = parity, stopbits
        self.timeout, self.write_timeout = timeout, write_timeout
        self.inter_byte_timeout = inter_byte_timeout
        self.xonxoff, self.rtscts, self.dsrdtr = xonxoff, rtscts, dsrdtr
        self.rts = self.dtr = True  # outputs, without effect
        self.break_condition = False
        self.cts = self.dsr = self.cd = True  # inputs, as with `xr3 serve`
        self.ri = False
        if port is not None:
            self.open()

    # --- Opening and closing.

    def open(self) -> None:
        """Connects to the robot."""
        if self.port is None:
            raise SerialException("Port must be configured before it can be used.")
        if self._line is not None:
            raise SerialException("Port is already open.")
        line = Line()
        try:
            line.connect(_address(self.port))
        except OSError as error:
            raise SerialException(f"could not open port {self.port}: {error}") from error
        self._line = line

    def close(self) -> None:
        """Closes the line; the port can be opened again."""
        line, self._line = self._line, None
        if line is not None:
            line.close()

    @property
    def is_open(self) -> bool:
        """Whether the port is open."""
        return self._line is not None

    @property
    def name(self) -> Optional[str]:
        """The name of the port."""
        return self.port

    portstr = name

    def isOpen(self) -> bool:
        """Whether the port is open, by its old name."""
        return self.is_open

    def __enter__(self) -> "Serial":
        if self.port is not None and not self.is_open:
            self.open()
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def _opened(self) -> Line:
        if self._line is None:
            raise PortNotOpenError()
        return self._line

    def fileno(self) -> int:
        """Returns a number for select()."""
        return self._opened().fileno()

    def readable(self) -> bool:
        """Whether the port can be read: always."""
        return True

    def writable(self) -> bool:
        """Whether the port can be written: always."""
        return True

    # --- Reading.

    @property
    def in_waiting(self) -> int:
        """The number of bytes that can be read at once."""
        return max(0, self._opened().waiting())

    def inWaiting(self) -> int:
        """The number of bytes that can be read at once, by its old name."""
        return self.in_waiting

    def read(self, size: int = 1, /) -> bytes:
        """Reads `size` bytes, or fewer at the timeout."""
        line, data, deadline = self._opened(), b"", Deadline(self.timeout)
        while len(data) < size:
            line.settimeout(self._next_within(bool(data), deadline.left()))
            try:
                part = line.recv(size - len(data))
            except (TimeoutError, BlockingIOError):
                break
            if not part:
                raise SerialException("the robot has closed the line")
            data += part
        return data

    def _next_within(self, has_begun: bool, left: Optional[float]) -> Optional[float]:
        """The seconds to wait for the next byte; inter_byte_timeout is for all but the first."""
        if not has_begun or self.inter_byte_timeout is None:
            return left
        return self.inter_byte_timeout if left is None else min(left, self.inter_byte_timeout)

    def readinto(self, buffer: Any, /) -> int:
        """Reads into a buffer; returns the number of bytes."""
        data = self.read(len(buffer))
        buffer[:len(data)] = data
        return len(data)

    def read_until(self, expected: bytes = b"\n", size: Optional[int] = None) -> bytes:
        """Reads until `expected` has arrived, or `size` bytes, or up to the timeout."""
        data, deadline = b"", Deadline(self.timeout)
        while not data.endswith(expected) and (size is None or len(data) < size):
            byte = self.read(1)
            data += byte
            if not byte or deadline.left() == 0:
                break
        return data

    def read_all(self) -> bytes:
        """Reads what can be read at once."""
        return self.read(self.in_waiting)

    def reset_input_buffer(self) -> None:
        """Discards what can be read at once."""
        while self.in_waiting:
            self.read_all()

    def flushInput(self) -> None:
        """Discards what can be read at once, by its old name."""
        self.reset_input_buffer()

    # --- Writing.

    def write(self, data: Any, /) -> int:
        """Writes all bytes; returns their number."""
        if isinstance(data, str):
            raise TypeError(f"unicode strings are not supported, please encode to bytes: {data!r}")
        line = self._opened()
        line.settimeout(self.write_timeout)
        try:
            line.sendall(bytes(data))
        except (TimeoutError, BlockingIOError):
            raise SerialTimeoutException("Write timeout") from None
        except OSError as error:
            raise SerialException(f"write failed: {error}") from error
        return len(data)

    @property
    def out_waiting(self) -> int:
        """The number of bytes that write() has not sent yet: 0."""
        self._opened()
        return 0

    def flush(self) -> None:
        """Waits until all is sent: at once."""
        self._opened()

    def reset_output_buffer(self) -> None:
        """Discards what is not sent yet: nothing."""
        self._opened()

    def flushOutput(self) -> None:
        """Discards what is not sent yet, by its old name."""
        self.reset_output_buffer()

    def send_break(self, duration: float = 0.25) -> None:
        """Takes the time of a break, which the controller does not see."""
        self._opened()
        time.sleep(duration)
