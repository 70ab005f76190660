"""The modules of pyserial: `serial`, `serial.serialutil`, `serial.tools` and its `list_ports`."""

import re
import sys
import types
from typing import Any, Dict, Iterator, List

from xr3_page import serial_port
from xr3_page.serial_port import Serial

VERSION = "3.5"  # of pyserial, whose functions these are
DEVICE = "robot"  # the only port that is listed; programs may use any name


def serial_for_url(url: str, *arguments: Any, do_not_open: bool = False, **settings: Any) -> Serial:
    """Returns a port, as serial.serial_for_url(): open, unless `do_not_open`."""
    port = Serial(None, *arguments, **settings)
    port.port = url
    if not do_not_open:
        port.open()
    return port


class ListPortInfo:
    """A port that comports() lists: also a sequence of device, description and hwid."""

    device = name = DEVICE
    description = "The robot of the page"
    hwid = "n/a"
    vid = pid = serial_number = location = manufacturer = product = interface = None

    def __getitem__(self, index: int) -> str:
        return (self.device, self.description, self.hwid)[index]

    def __str__(self) -> str:
        return f"{self.device} - {self.description}"


def comports(include_links: bool = False) -> List[ListPortInfo]:
    """Returns the ports of the page, as serial.tools.list_ports.comports()."""
    return [ListPortInfo()]


def grep(regexp: str, include_links: bool = False) -> Iterator[ListPortInfo]:
    """Yields the ports of which a text matches, as serial.tools.list_ports.grep()."""
    for port in comports():
        if any(re.search(regexp, text, re.IGNORECASE) for text in port):
            yield port


def _serial_names() -> Dict[str, Any]:
    names: Dict[str, Any] = {
        name: getattr(serial_port, name)
        for name in ("Serial", "SerialException", "SerialTimeoutException", "PortNotOpenError")}
    names.update(serial_for_url=serial_for_url, VERSION=VERSION, __version__=VERSION)
    names.update(zip(("FIVEBITS", "SIXBITS", "SEVENBITS", "EIGHTBITS"), (5, 6, 7, 8)))
    names.update(zip(("STOPBITS_ONE", "STOPBITS_ONE_POINT_FIVE", "STOPBITS_TWO"),
                     serial_port.STOP_BITS))
    names.update((f"PARITY_{name}", name[0]) for name in ("NONE", "EVEN", "ODD", "MARK", "SPACE"))
    return names


def _module(name: str, **names: Any) -> types.ModuleType:
    module = types.ModuleType(name)
    module.__dict__.update(names)
    sys.modules[name] = module
    return module


def install() -> None:
    """Puts the modules in the place of pyserial."""
    list_ports = _module("serial.tools.list_ports", comports=comports, grep=grep)
    tools = _module("serial.tools", list_ports=list_ports)
    util = _module("serial.serialutil", **_serial_names())
    _module("serial", tools=tools, serialutil=util, **_serial_names())
