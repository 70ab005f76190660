"""`time` in simulated time: sleeping, and the clocks. Calendar functions such as time.strftime()
and datetime.now() stay those of the wall clock."""

import math
import time
from typing import Optional

from xr3_page.bridge import robot

NS_PER_MS = 1_000_000


def sleep(seconds: float, /) -> None:
    """Lets simulated time pass, as time.sleep()."""
    if math.isnan(seconds):  # raises TypeError if it is not a number
        raise ValueError("Invalid value NaN (not a number)")
    if seconds < 0:
        raise ValueError("sleep length must be non-negative")
    robot.sleep(float(seconds))


def monotonic() -> float:
    """Seconds since the start of the run, as time.monotonic()."""
    return robot.now_ms() / 1000


def monotonic_ns() -> int:
    """Nanoseconds since the start of the run, as time.monotonic_ns()."""
    return int(robot.now_ms() * NS_PER_MS)


def wall() -> float:
    """Seconds since 1970, as time.time(): the start of the run, plus simulated time."""
    return robot.wall() + monotonic()


def wall_ns() -> int:
    """Nanoseconds since 1970, as time.time_ns()."""
    return int(robot.wall() * 1000) * NS_PER_MS + monotonic_ns()


class Deadline:
    """The end of a timeout in seconds; None for a timeout without end."""

    def __init__(self, timeout: Optional[float]) -> None:
        self._end = monotonic() + timeout if timeout else timeout

    def left(self) -> Optional[float]:
        """The seconds that are left, to the nanosecond, at least 0; None if there is no end."""
        return max(0.0, round(self._end - monotonic(), 9)) if self._end else self._end


def install() -> None:
    """Replaces the functions of `time`."""
    time.sleep = sleep
    time.monotonic = time.perf_counter = monotonic
    time.monotonic_ns = time.perf_counter_ns = monotonic_ns
    time.time = wall
    time.time_ns = wall_ns
