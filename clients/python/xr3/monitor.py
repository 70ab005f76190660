"""The monitor port, JSON lines: what the robot looks like right now, and control of its time. A
real arm has no such port; a test of a robot's program wants it. Messages are dictionaries as
docs/monitor.md describes them.
"""

import json
import os
import socket
from types import TracebackType
from typing import Any, Dict, Iterator, List, Optional, Sequence, Type, Union

from xr3.address import connect

Message = Dict[str, Any]


class MonitorError(Exception):
    """The server refused a request. `code` is stable, message and hint are for people."""

    def __init__(self, error: Message) -> None:
        super().__init__(f"{error['code']}: {error['message']} ({error['hint']})")
        self.code: str = error["code"]
        self.details: Sequence[Message] = error["details"]


class Monitor:
    """A connection to the monitor port. Use it in a `with`, or call close(). `hello` is what the
    server said first.

    Host and port come from XR3_HOST and XR3_MONITOR_PORT where they are not given, else localhost
    and 9601; the token from XR3_TOKEN where the server wants one. Every operation raises OSError
    when the server is gone and TimeoutError when it is silent for timeout_s; after a TimeoutError
    the connection can be used as before."""

    def __init__(self, host: Optional[str] = None, port: Union[int, str, None] = None, *,
                 token: Optional[str] = None, timeout_s: float = 30.0) -> None:
        self._timeout_s = timeout_s
        self._socket = connect(host, port, "XR3_MONITOR_PORT", 9601, timeout_s)
        self._received = b""  # what no message has been made of yet
        self._last_id = 0
        self._send({"op": "ping", "id": 0})  # who sends first is greeted at once
        self.hello = self.read()
        self.read()
        if token is None and self.hello["access"] == "read":
            token = os.environ.get("XR3_TOKEN") or None
        if token is not None:
            self.request("auth", token=token)

    def __enter__(self) -> "Monitor":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection."""
        self._socket.close()

    # --- Messages.

    def _send(self, message: Message) -> None:
        self._socket.sendall(json.dumps(message).encode() + b"\n")

    def read(self) -> Message:
        """The next message of the server, whatever it is."""
        while b"\n" not in self._received:
            try:
                part = self._socket.recv(65536)
            except socket.timeout:  # before Python 3.10 that is no TimeoutError
                raise TimeoutError(f"the server said nothing for {self._timeout_s} s") from None
            if not part:
                raise ConnectionError("the server closed the monitor's connection")
            self._received += part
        line, _, self._received = self._received.partition(b"\n")
        message: Message = json.loads(line)
        return message

    def messages(self) -> Iterator[Message]:
        """Every message from now on, until the server closes: for the channels that sub() asked
        for. TimeoutError says that none came within timeout_s; call it again to wait for more."""
        while True:
            try:
                yield self.read()
            except ConnectionError:
                return

    def request(self, op: str, **members: Any) -> Message:
        """Sends a request and returns its answer; messages of subscriptions that come in between
        are dropped. Raises MonitorError where the server refuses."""
        self._last_id += 1
        self._send({"op": op, "id": self._last_id, **members})
        answer = self.read()
        while answer.get("id") != self._last_id:
            answer = self.read()
        if answer["op"] == "result" and not answer["ok"]:
            raise MonitorError(answer["error"])
        return answer

    def recall(self, channel: str, **options: Any) -> List[Message]:
        """What the server still has of `event` or `line`: the last 256 messages, or those `since` a
        number."""
        messages = [self.request("get", channel=channel, **options)]
        while messages[-1]["op"] != "result":
            messages.append(self.read())
        return [message for message in messages if message["op"] == channel]

    # --- What one asks for most.

    def state(self, *fields: str) -> Message:
        """The robot's state: whole, or only these members of it."""
        return self.request("get", channel="state", **({"fields": list(fields)} if fields else {}))

    def counts(self) -> Dict[str, int]:
        """Where every motor is, in counts from the soft home, by its label."""
        state = self.state("joints", "tool")
        return {motor["label"]: motor["count"] for motor in [*state["joints"], state["tool"]]}

    def block(self, name: str) -> Message:
        """One block: its name, xyz_mm, yaw_deg and whether it is held. Raises KeyError."""
        for block in self.state("blocks")["blocks"]:
            if block["name"] == name:
                found: Message = block
                return found
        raise KeyError(name)

    def sub(self, channel: str, **options: Any) -> Message:
        """Asks for the messages of a channel; read them by messages()."""
        value: Message = self.request("sub", channel=channel, **options)["value"]
        return value

    def call(self, fn: str, **arguments: Any) -> Message:
        """Carries out a call, such as `home`, `pause` or `rate` with a factor; returns the value of
        its result."""
        value: Message = self.request("call", fn=fn, args=arguments)["value"]
        return value

    def step(self, ticks: int) -> Message:
        """Lets standing time pass (after `pause`, or with --clock manual); a tick is a millisecond.
        Returns the state."""
        state: Message = self.call("step", ticks=ticks)["state"]
        return state

    def settle(self, max_ticks: int = 600_000) -> Message:
        """Lets standing time pass until nothing moves any more. Returns the state."""
        state: Message = self.call("run_until", idle=True, max_ticks=max_ticks)["state"]
        return state
