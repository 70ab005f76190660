"""The robot of the page, called with Python's types and with seconds. Converts values between
Python and JavaScript where Python runs in a page; elsewhere the values are left alone."""

from typing import Any, Optional

try:
    from pyodide import ffi
except ImportError:
    ffi = None

JS_ERRORS = (ffi.JsException,) if ffi else ()
CLOSED_BY_ROBOT = -2  # result of send()


def from_js(value: Any) -> Any:
    """Waits for a promise; converts a JavaScript object to Python's type."""
    if hasattr(value, "then"):
        value = ffi.run_sync(value)
    return value.to_py() if hasattr(value, "to_py") else value


def _js_bytes(data: bytes) -> Any:
    return ffi.to_js(data) if ffi else data


def _python_error(error: Any) -> BaseException:
    if error.name == "KeyboardInterrupt":
        return KeyboardInterrupt(error.message)
    return OSError(error.message)


def _ms(timeout: Optional[float]) -> float:
    return -1 if timeout is None else timeout * 1000


class Robot:
    """The robot that `install()` was given. Timeouts are in seconds, None for none."""

    functions: Any = None

    def _call(self, name: str, *arguments: Any) -> Any:
        try:
            return from_js(getattr(self.functions, name)(*arguments))
        except JS_ERRORS as error:
            raise _python_error(error) from None

    @property
    def monitor_port(self) -> int:
        """The port of the monitor."""
        return int(self.functions.monitor_port)

    def open(self) -> int:
        """Opens a line to the robot; returns its number."""
        return int(self._call("open"))

    def open_monitor(self) -> int:
        """Opens a connection to the monitor; returns its number as a line."""
        return int(self._call("open_monitor"))

    def send(self, line: int, data: bytes, timeout: Optional[float]) -> int:
        """Returns the number of bytes taken, 0 after the timeout, or CLOSED_BY_ROBOT."""
        return int(self._call("send", line, _js_bytes(data), _ms(timeout)))

    def receive(self, line: int, size: int, timeout: Optional[float],
                peek: bool = False) -> Optional[bytes]:
        """Returns up to `size` bytes, none at the end of the line, or None after the timeout. With
        `peek` the bytes stay to be read."""
        data = self._call("receive", line, size, _ms(timeout), peek)
        return None if data is None else bytes(data)

    def waiting(self, line: int) -> int:
        """The number of bytes that can be read now; -1 at the end of the line."""
        return int(self._call("waiting", line))

    def finish(self, line: int) -> None:
        """Ends sending; bytes can still be received."""
        self._call("finish", line)

    def close(self, line: int) -> None:
        """Closes a line."""
        self._call("close", line)

    def sleep(self, seconds: float) -> None:
        """Lets simulated time pass."""
        self._call("sleep", seconds * 1000)

    def now_ms(self) -> float:
        """Simulated time since the start of the run, in ms."""
        return float(self._call("now"))

    def wall(self) -> float:
        """The start of the run, in seconds since 1970."""
        return float(self._call("wall"))

    def ask(self, prompt: str) -> Optional[str]:
        """Asks the user for a line of input; None at the end of input."""
        return self._call("ask", prompt)


robot = Robot()
