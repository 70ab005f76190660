"""Runs Python programs for the robot in a browser page, unmodified.

`install(robot)` replaces what a program uses to reach a robot and to wait: `socket`, `select`,
`selectors`, `serial`, `time` and `input()`. `xr3_page.run.run()` then runs a program.

`robot` has these functions and one number. Times are in ms, simulated, from the start of the run;
a timeout of -1 means none. None is JavaScript's undefined, not its null. A function may return a
promise instead of its value, except close(), which garbage collection may call.

    open()                                a new line to the robot: its number
    open_monitor()                        a new connection to the monitor port: its number
    send(line, data, timeout)             the number of bytes taken, or -2: closed by the robot
    receive(line, size, timeout, peek)    bytes, empty at the end; None after the timeout
    waiting(line)                         the number of bytes to read now, -1 at the end
    finish(line)                          ends sending; bytes can still be received
    close(line)
    sleep(ms)
    now()                                 ms since the start of the run
    wall()                                seconds since 1970 at the start of the run
    ask(prompt)                           shows the prompt: the line typed, None at the end of input
    monitor_port                          the port of the monitor, 9601

A JavaScript error of a function is raised as OSError with its text. One with the name
KeyboardInterrupt is raised as KeyboardInterrupt: that stops a program.
"""

from typing import Any

from xr3_page import absent, asking, clock, selecting, serial_modules, sockets
from xr3_page.bridge import robot as _robot


def install(robot: Any) -> None:
    """Replaces the modules of Python by those of the page, for this robot. Can be called again,
    also with another robot."""
    _robot.functions = robot
    replace()


def replace() -> None:
    """Replaces the modules again, after a program may have changed them."""
    for module in (absent, asking, clock, selecting, serial_modules, sockets):
        module.install()
