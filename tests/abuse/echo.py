#!/usr/bin/python3
"""Prints a free port, accepts one connection there and sends back what it receives, until the connection ends.
Usage: echo.py CORE"""

import gc
import os
import socket
import sys

gc.disable()
os.sched_setaffinity(0, {int(sys.argv[1])})
with socket.create_server(("127.0.0.1", 0)) as listener:
    print(listener.getsockname()[1], flush=True)
    connection, _ = listener.accept()
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    while data := connection.recv(4096):
        connection.sendall(data)
