"""A client of the monitor port (JSON lines): reads the state of the robot and controls simulated
time, for tests of robot programs. A real arm has no such port. Messages are dictionaries as
described in docs/monitor.md.
"""

import json
import os
import socket
from types import TracebackType
from typing import Any, Dict, Iterator, List, Optional, Sequence, Type, Union

from xr3.address import connect

Message = Dict[str, Any]


class MonitorError(Exception):
    """The server refused a request. `code` names the reason and never changes from version to
    version, unlike the text. `details` has the single errors of a file or of arguments, as
    messages."""

    def __init__(self, error: Message) -> None:
        super().__init__(f"{error['code']}: {error['message']} ({error['hint']})")
        self.code: str = error["code"]
        self.details: Sequence[Message] = error["details"]


def server_version(host: Optional[str] = None) -> Optional[str]:
    """Name and version of the server whose monitor port answers within a second, such as
    "xr3 0.10.0", at the default port of Monitor. None if there is none. Sends only a brace, which a
    robot ignores: the port may be that of another arm."""
    try:
        with connect(host, None, "XR3_MONITOR_PORT", 9601, 1.0) as line:
            line.sendall(b"{")
            with line.makefile("rb") as answers:
                hello = json.loads(answers.readline(65536))
    except (OSError, ValueError):
        return None
    server = hello.get("server") if isinstance(hello, dict) else None
    return server if isinstance(server, str) else None


class Monitor:
    """A connection to the monitor port. Use it in a `with` statement, or call `close()`. The
    attribute `hello` is the server's first message, or its first after the token if reading needs
    the token.

    `cell` is the name of the cell of all requests that name none themselves, on a server of several
    robots; by default the one that `hello` names.

    `host` and `port` default to the variables XR3_HOST and XR3_MONITOR_PORT, else to localhost and
    9601. `token`, if the server requires one, defaults to the variable XR3_TOKEN.

    The constructor raises ValueError if the port is no port, ConnectionError if no server answers,
    and MonitorError if the token is wrong. All methods raise OSError if the connection is lost, and
    TimeoutError if the server is silent for `timeout_s` seconds; the connection remains usable
    after a TimeoutError. Those that make a request raise MonitorError if the server refuses it."""

    def __init__(self, host: Optional[str] = None, port: Union[int, str, None] = None, *,
                 token: Optional[str] = None, cell: Optional[str] = None,
                 timeout_s: float = 30.0) -> None:
        self._timeout_s = timeout_s
        self.cell = cell
        self._socket = connect(host, port, "XR3_MONITOR_PORT", 9601, timeout_s)
        self._received = b""  # bytes of an incomplete line
        self._last_id = 0
        self._send({"op": "ping", "id": 0})  # makes the server send `hello` at once
        self.hello = self.read()
        self.read()
        if token is None and self.hello["access"] != "control":
            token = os.environ.get("XR3_TOKEN") or None
        if token is not None:
            self.request("auth", token=token)
            if self.hello["access"] == "none":
                self.hello = self.read()

    def __enter__(self) -> "Monitor":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Closes the connection."""
        self._socket.close()

    # --- Messages.

    def _send(self, message: Message) -> None:
        self._socket.sendall(json.dumps(message).encode() + b"\n")

    def read(self) -> Message:
        """Reads the next message of the server, of any kind."""
        while b"\n" not in self._received:
            try:
                part = self._socket.recv(65536)
            except socket.timeout:  # a subclass of TimeoutError only since Python 3.10
                raise TimeoutError(f"the server said nothing for {self._timeout_s} s") from None
            if not part:
                raise ConnectionError("the server closed the monitor's connection")
            self._received += part
        line, _, self._received = self._received.partition(b"\n")
        message: Message = json.loads(line)
        return message

    def messages(self) -> Iterator[Message]:
        """Yields all messages, such as those of subscribed channels, until the server closes the
        connection. Raises TimeoutError if none arrives within `timeout_s` seconds; call it again to
        wait for more."""
        while True:
            try:
                yield self.read()
            except ConnectionError:
                return

    def request(self, op: str, **members: Any) -> Message:
        """Sends a request, such as `request("get", channel="state")`, and returns its response.
        Drops messages of subscriptions that arrive in between. Raises MonitorError if the server
        refuses."""
        self._last_id += 1
        if self.cell is not None and op != "auth":
            members.setdefault("cell", self.cell)
        self._send({"op": op, "id": self._last_id, **members})
        answer = self.read()
        while answer.get("id") != self._last_id:
            answer = self.read()
        if answer["op"] == "result" and not answer["ok"]:
            raise MonitorError(answer["error"])
        return answer

    def recall(self, channel: str, **options: Any) -> List[Message]:
        """The messages in the server's ring buffer of `event` or `line`: the last 256, or those
        `since` a sequence number."""
        messages = [self.request("get", channel=channel, **options)]
        while messages[-1]["op"] != "result":
            messages.append(self.read())
        return [message for message in messages if message["op"] == channel]

    # --- Common requests.

    def state(self, *fields: str) -> Message:
        """The robot's state: all members, or only `fields`."""
        return self.request("get", channel="state", **({"fields": list(fields)} if fields else {}))

    def counts(self) -> Dict[str, int]:
        """The positions of all motors in counts from the soft home, by label."""
        state = self.state("joints", "tool")
        return {motor["label"]: motor["count"] for motor in [*state["joints"], state["tool"]]}

    def block(self, name: str) -> Message:
        """The block with this name: a dictionary with `name`, `xyz_mm`, the centre, `yaw_deg` and
        `held`. Raises KeyError if there is none."""
        for block in self.state("blocks")["blocks"]:
            if block["name"] == name:
                found: Message = block
                return found
        raise KeyError(name)

    def sub(self, channel: str, **options: Any) -> Message:
        """Subscribes to a channel and returns what the server confirms; read its messages with
        `messages()`."""
        value: Message = self.request("sub", channel=channel, **options)["value"]
        return value

    def call(self, fn: str, **arguments: Any) -> Message:
        """Makes a call with its arguments, such as `call("pause")` or `call("rate", factor=2)`;
        returns the value of its result. Calls need the token, if the server has one."""
        value: Message = self.request("call", fn=fn, args=arguments)["value"]
        return value

    def step(self, ticks: int) -> Message:
        """Advances a manual clock (--clock manual, or after `pause`); a tick is 1 ms. Returns the
        state."""
        state: Message = self.call("step", ticks=ticks)["state"]
        return state

    def settle(self, max_ticks: int = 600_000) -> Message:
        """Advances a manual clock until nothing moves, or by `max_ticks` milliseconds. Returns the
        state."""
        state: Message = self.call("run_until", idle=True, max_ticks=max_ticks)["state"]
        return state
