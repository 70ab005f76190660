"""The functions of `socket` that look up names, and its constants. The others, such as
create_connection() and create_server(), are written in Python on these and on the class."""

import errno
import socket
from typing import Any, List, Tuple, Union

from xr3_page.line import ONLY_TCP, Line, system_error

LOCALHOST = {socket.AF_INET: "127.0.0.1", socket.AF_INET6: "::1"}
# Numbers of Linux, for constants that a build of Python lacks.
CONSTANTS = {"IPPROTO_TCP": 6, "TCP_NODELAY": 1, "SOL_SOCKET": 1, "SO_REUSEADDR": 2,
             "SO_KEEPALIVE": 9, "SHUT_RD": 0, "SHUT_WR": 1, "SHUT_RDWR": 2, "MSG_PEEK": 2,
             "MSG_DONTWAIT": 0x40, "MSG_WAITALL": 0x100}


def _port_number(port: Union[int, str, bytes, None]) -> int:
    text = port.decode() if isinstance(port, bytes) else port
    if text is None or isinstance(text, int):
        return text or 0
    if not text.isdecimal():
        raise socket.gaierror(socket.EAI_SERVICE, "Servname not supported for ai_socktype")
    return int(text)


def getaddrinfo(host: Any, port: Any, family: int = 0, type: int = 0, proto: int = 0,
                flags: int = 0) -> List[Tuple[Any, ...]]:
    """Returns the one address that every host has, as socket.getaddrinfo()."""
    family = socket.AF_INET6 if family == socket.AF_INET6 else socket.AF_INET
    address = (LOCALHOST[family], _port_number(port))
    if family == socket.AF_INET6:
        address += (0, 0)
    return [(family, type or socket.SOCK_STREAM, proto or socket.IPPROTO_TCP, "", address)]


def gethostbyname(host: str, /) -> str:
    """Returns the address of every host, as socket.gethostbyname()."""
    return LOCALHOST[socket.AF_INET]


def gethostbyname_ex(host: str, /) -> Tuple[str, List[str], List[str]]:
    """Returns name, aliases and addresses, as socket.gethostbyname_ex()."""
    return host, [], [gethostbyname(host)]


def gethostbyaddr(host: str, /) -> Tuple[str, List[str], List[str]]:
    """Returns name, aliases and addresses, as socket.gethostbyaddr()."""
    return "localhost", [], [gethostbyname(host)]


def socketpair(*_: Any) -> None:
    """Raises OSError: there is only the robot to connect to."""
    raise system_error(errno.EOPNOTSUPP, ONLY_TCP)


def install() -> None:
    """Replaces the class and the functions of `socket`."""
    for name, value in CONSTANTS.items():
        if not hasattr(socket, name):
            setattr(socket, name, value)
    socket.socket = socket.SocketType = Line
    for function in (getaddrinfo, gethostbyname, gethostbyname_ex, gethostbyaddr, socketpair):
        setattr(socket, function.__name__, function)
