"""Connects to a port of the server, and checks the types of arguments. Errors have a one-sentence
message.
"""

import os
import socket
from typing import Optional, Tuple, Union


def host_and_port(host: Optional[str], port: Union[int, str, None], variable: str,
                  usual: int) -> Tuple[str, int]:
    """Host and port. If they are not given or empty, uses the environment (XR3_HOST and `variable`
    for the port), else localhost and the port `usual`. Raises ValueError if the port is invalid."""
    return (host or os.environ.get("XR3_HOST") or "localhost",
            port_number(port or os.environ.get(variable) or usual))


def connect(host: Optional[str], port: Union[int, str, None], variable: str, usual: int,
            timeout_s: float) -> socket.socket:
    """Connects to `host_and_port()` of these arguments. Raises ConnectionError if that fails."""
    host, number = host_and_port(host, port, variable, usual)
    try:
        line = socket.create_connection((host, number), timeout_s)
    except OSError as error:
        raise ConnectionError(f"no robot answers at {host} port {number}: is the server running? "
                              f"./run ({error})") from error
    line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # send small messages at once
    return line


def check_type(value: object, kind: type, what: str) -> None:
    """Raises ValueError if the value is not of this kind; `what` names it, with an example."""
    if not isinstance(value, kind):
        raise ValueError(f"give {what}, not {value!r}")


def port_number(port: Union[int, str]) -> int:
    """Converts the port to a number. Raises ValueError if it is invalid."""
    if not str(port).isdecimal() or not 1 <= int(port) <= 65535:
        raise ValueError(f"the port has to be a number from 1 to 65535, not {port!r}")
    return int(port)
