"""Floods at full speed, each from a separate process: a line of garbage, a client that sends requests. The processes
have a low priority, so that they load the server, and not the scheduler of a machine with two cores."""

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


ASK = """
import os, socket, threading
os.nice(10)
sock = socket.create_connection(("%s", %d))
def take():
    while sock.recv(1 << 20):
        pass
threading.Thread(target=take, daemon=True).start()
while True:
    sock.sendall(%r * 200)
"""


def ask_without_end(port, request):
    """Starts a process that repeats a request as fast as the server answers, and reads the answers."""
    return subprocess.Popen([sys.executable, "-c", ASK % (LOCALHOST, port, request)], stderr=subprocess.DEVNULL)


def pour(port, data):
    """Starts a process that repeats the data as fast as the server reads it, and reads nothing."""
    return subprocess.Popen([sys.executable, "-c", WRITE % (LOCALHOST, port, data)], stderr=subprocess.DEVNULL)


WRITE = """
import os, socket
os.nice(10)
sock = socket.create_connection(("%s", %d))
while True:
    sock.sendall(%r * 200)
"""
