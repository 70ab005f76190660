"""Where a port of the server is, and how to get there. Says in one sentence what is wrong where
there is none."""

import os
import socket
from typing import Optional, Union


def connect(host: Optional[str], port: Union[int, str, None], variable: str, usual: int,
            timeout_s: float) -> socket.socket:
    """A connection to host and port; where they are not given, to XR3_HOST and the port that the
    variable names, else to localhost and the usual one. Empty ones count as not given. Raises
    ValueError where the port is none, and ConnectionError where nobody answers."""
    host = host or os.environ.get("XR3_HOST") or "localhost"
    number = port_number(port or os.environ.get(variable) or usual)
    try:
        line = socket.create_connection((host, number), timeout_s)
    except OSError as error:
        raise ConnectionError(f"no robot answers at {host} port {number}: is the server running? "
                              f"./run ({error})") from error
    line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # bytes go out at once
    return line


def port_number(port: Union[int, str]) -> int:
    """The port as a number. Raises ValueError where it is none."""
    if not str(port).isdecimal() or not 1 <= int(port) <= 65535:
        raise ValueError(f"the port has to be a number from 1 to 65535, not {port!r}")
    return int(port)
