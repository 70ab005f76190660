"""A server of its own for tests and notebooks: starts `xr3 serve` on free ports, and ends it.

Its standard input is a pipe whose other end only this process and its forks have, and it runs with
--until-stdin-ends, so that it ends with this process, even after SIGKILL. It is in a session of its
own, so that neither Ctrl-C nor the interruption of a notebook's cell reaches it.
"""

import os
import re
import selectors
import subprocess
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import IO, Any, List, Optional, Type

from xr3 import arm_file
from xr3.exchanges import exchanges
from xr3.kinematics import Arm
from xr3.monitor import Monitor
from xr3.program import FilePath, ServerError, program_file, shown, start, words
from xr3.robot import Robot
from xr3.vision import Camera

END_S = 10.0  # for an orderly end: clients have a second to read their last replies
LISTENING = re.compile(r"LISTENING robot=(\S+):(\d+) monitor=\S+:(\d+)((?: pty=.+)?)\n")
TOKEN = re.compile(rb"#token=(\S+)")
REACHABLE = {"0.0.0.0": "127.0.0.1", "::": "::1"}  # for clients, if a server listens at all


class Server:
    """A running `xr3 serve` on free ports of this machine. Use it in a `with` statement, or call
    `close()`. It also ends with this process, even after SIGKILL.

    The options are those of `xr3 serve`, with `_` in place of `-`, such as
    `Server(robot="adept-one", clock="bytes")`. A list repeats its option, True is a flag, and None
    or False leaves it out. `pty=True` makes a pseudo-terminal in a temporary folder. The level of
    the log is `warn` if `log_level` does not say otherwise. The server does not get the caller's
    variables XR3_…, except XR3_DATA.

    `program` is the path of the program, by default the variable XR3, else `xr3` beside this Python,
    else on PATH. Its version must be that of this package.

    The attributes `host` and `port` are those of the robot port, `monitor_port` is the other port,
    and `pty` the path of the first pseudo-terminal, or None.

    The constructor raises ServerError, with what the server printed, if it does not listen within
    `timeout_s` seconds."""

    def __init__(self, *, program: Optional[FilePath] = None, timeout_s: float = 20.0,
                 **options: Any) -> None:
        file = program_file(program)
        with ExitStack() as closing:
            if options.get("pty") is True:
                folder = closing.enter_context(tempfile.TemporaryDirectory(prefix="xr3-"))
                options["pty"] = Path(folder, "pty")
            self._options = {"robot_port": 0, "monitor_port": 0, "log_level": "warn", **options}
            self._said = closing.enter_context(tempfile.TemporaryFile())  # a pipe would fill
            command = [file, "serve", "--until-stdin-ends", *words(self._options)]
            self._process = start(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                  stderr=self._said, start_new_session=True)
            closing.callback(_end, self._process)
            self._await_ports(timeout_s)
            self._closing = closing.pop_all()

    def _await_ports(self, timeout_s: float) -> None:
        began = time.monotonic()
        line = os.fsdecode(_read(self._process.stdout, b"\n", timeout_s))
        ports = LISTENING.fullmatch(line)
        if not ports:
            is_late = time.monotonic() - began >= timeout_s
            self._process.kill()
            self._process.wait()
            why = f"it did not listen within {timeout_s:g} s\n" if is_late else ""
            said = shown(os.fsencode(line) + self._printed()) or "it printed nothing"
            raise ServerError(f"xr3 does not start: {why}{said}")
        host = ports[1].strip("[]")
        self.host = REACHABLE.get(host, host)
        self.port, self.monitor_port = int(ports[2]), int(ports[3])
        self.pty: Optional[str] = ports[4].split(" pty=")[1] if ports[4] else None
        token = TOKEN.search(self._printed())
        self._token = token[1].decode() if token else None

    def _printed(self) -> bytes:
        self._said.seek(0)
        return self._said.read()

    def __repr__(self) -> str:
        return (f"<xr3.Server at {self.host}, robot port {self.port}, "
                f"monitor port {self.monitor_port}>")

    def __enter__(self) -> "Server":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Ends the server as by SIGTERM, and waits for that. Close the robots and monitors before:
        the server waits a second for the clients that are still connected."""
        self._closing.close()

    def robot(self, **options: Any) -> Robot:
        """A new Robot at this server, with these arguments of `Robot()`. `arm` and `camera` are by
        default those of the server's robot and workcell, whatever files they come from. With the byte
        clock, which questions advance, `pause` by default does not wait."""
        if str(self._options.get("clock")).startswith("bytes"):
            options.setdefault("pause", lambda: None)
        with self.monitor() as monitor:
            model = monitor.request("get", channel="model", fields=["robot", "workcell"])
            if "arm" not in options:
                name = Path(self._options.get("robot") or "rhino-xr3").stem
                options["arm"] = arm_file.arm_of(name, model["robot"], Arm)
            if "camera" not in options and "camera" in model["workcell"]:
                options["camera"] = Camera.from_monitor(monitor)
        return Robot(self.host, self.port, **options)

    def monitor(self, **options: Any) -> Monitor:
        """A new Monitor at this server, with these arguments of `Monitor()`. Has the token of a
        server with `token="auto"`."""
        options.setdefault("token", self._token)
        return Monitor(self.host, self.monitor_port, **options)

    def wires(self, count: int = 30) -> List[str]:
        """The last `count` exchanges of all lines, decoded, a line of text each: simulated time in
        ms, number of the line, the bytes and their meaning, and that of the reply. Equal inquiries
        in succession are one exchange, `E? 12 times`. The server keeps the last 256 messages. Raises
        OSError if the server has ended."""
        with self.monitor() as monitor:
            return [str(each) for each in exchanges(monitor.recall("line"))[-count:]]


def _read(out: Optional[IO[bytes]], end: bytes, timeout_s: float) -> bytes:
    """Reads up to the bytes `end`, or up to the end of the stream; less after the timeout."""
    assert out is not None
    text, deadline = b"", time.monotonic() + timeout_s
    with selectors.DefaultSelector() as selector:
        selector.register(out, selectors.EVENT_READ)
        while not (end and text.endswith(end)):
            if not selector.select(max(0.0, deadline - time.monotonic())):
                break
            part = os.read(out.fileno(), 4096)
            if not part:
                break
            text += part
    return text


def _end(process: "subprocess.Popen[bytes]") -> None:
    """Ends the server. Its output ends with it; Popen.wait() with a timeout would poll."""
    with process:
        process.terminate()
        assert process.stdin is not None
        process.stdin.close()  # ends a server that a script has started
        _read(process.stdout, b"", END_S)
        if process.poll() is None:
            process.kill()
