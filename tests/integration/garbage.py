"""A flood of garbage on a line at full speed, from a separate process. It has a low priority, so that it loads the
server, and not the scheduler of a machine with two cores."""

import subprocess
import sys

from support import LOCALHOST

POUR = """
import os, select, socket, time
os.nice(10)
sock = socket.create_connection(("%s", %d))
garbage = bytes(number * 7 %% 256 for number in range(65536)).replace(b"A", b"z").replace(b"\\xff", b"z") * 4
sock.setblocking(False)
until = time.monotonic() + %f
while (left := until - time.monotonic()) > 0:
    readable, writable, _ = select.select([sock], [sock], [], left)
    if readable and not sock.recv(1 << 20):
        break
    if writable:
        sock.send(garbage)
"""


def pour_garbage(port, seconds):
    """Starts a process that writes garbage for `seconds`, as fast as the server reads it, and reads the replies."""
    return subprocess.Popen([sys.executable, "-c", POUR % (LOCALHOST, port, seconds)], stderr=subprocess.DEVNULL)
