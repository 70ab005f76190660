"""Displays the robot's page in a notebook. Needs no package of notebooks."""

import html
import re
from typing import Optional, Union
from urllib.parse import quote

from xr3.address import host_and_port


class Page:
    """A page that notebooks display in a frame. `address` is its address, `height` the height of
    the frame in pixels."""

    def __init__(self, address: str, height: int) -> None:
        self.address = address
        self.height = height

    def __repr__(self) -> str:
        return f"the robot is at {self.address}"

    def _repr_html_(self) -> str:
        return (f'<iframe src="{html.escape(self.address)}" width="100%" height="{self.height}" '
                f'style="border: 0" allow="clipboard-write; fullscreen" title="xr3"></iframe>')


def show(host: Optional[str] = None, port: Union[int, str, None] = None, *,
         cell: Optional[str] = None, here: Optional[str] = None, height: int = 600) -> Page:
    """Displays the robot's page in a notebook, as the value of a notebook's cell; elsewhere its
    text is the address of the page. Connects to nothing itself: the browser opens the page.

    `host` and `port` are those of the monitor port, by default the variables XR3_HOST and
    XR3_MONITOR_PORT, else localhost and 9601. `cell` is the name of a robot on a server of several.
    The server must be started with `--allow-frame` and the origin of the notebook.

    `here` is the address of a page that has the robot in itself, such as a link made by its "Copy
    link"; it needs no server. `height` is in pixels.

    Raises ValueError if the port is no port, the height is no number above 0, or `here` is no
    address or is given with a server."""
    if not isinstance(height, int) or height < 1:
        raise ValueError(f"give the height as a number of pixels above 0, such as 600, not {height!r}")
    if here is None:
        return Page(_server_page(host, port, cell), height)
    if host or port or cell:
        raise ValueError("give either here= or the host, port and cell of a server: a page that has "
                         "the robot in itself needs no server")
    if not re.match(r"https?://[^/\s]", here):
        raise ValueError("give here= an address that begins with http:// or https://, such as "
                         f"http://localhost:8000/, not {here!r}")
    return Page(here, height)


def _server_page(host: Optional[str], port: Union[int, str, None], cell: Optional[str]) -> str:
    name, number = host_and_port(host, port, "XR3_MONITOR_PORT", 9601)
    authority = f"[{name}]" if ":" in name else name
    return f"http://{authority}:{number}/" + (f"cell/{quote(cell, safe='')}" if cell else "")
