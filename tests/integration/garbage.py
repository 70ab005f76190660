"""A line of garbage at full speed, from a process of its own."""

import subprocess
import sys

from support import LOCALHOST

POUR = """
import socket, sys, time
sock = socket.create_connection(("%s", %d))
garbage = bytes(number * 7 %% 256 for number in range(65536)).replace(b"A", b"z").replace(b"\\xff", b"z") * 4
until = time.monotonic() + %f
while time.monotonic() < until:
    sock.sendall(garbage)
"""


def pour_garbage(port, seconds):
    """A process of its own that writes as fast as the server takes it."""
    return subprocess.Popen([sys.executable, "-c", POUR % (LOCALHOST, port, seconds)], stderr=subprocess.DEVNULL)
