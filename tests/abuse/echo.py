#!/usr/bin/python3
"""Sends back what one client sends, until it ends: on a connection to a free port, whose number it prints, or on a
pseudo-terminal, whose path it prints. Usage: echo.py CORE|pty"""

import gc
import os
import pty
import socket
import sys
import tty


def on_a_connection(core):
    os.sched_setaffinity(0, {core})
    with socket.create_server(("127.0.0.1", 0)) as listener:
        print(listener.getsockname()[1], flush=True)
        connection, _ = listener.accept()
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        while data := connection.recv(4096):
            connection.sendall(data)


def on_a_pseudo_terminal():
    master, slave = pty.openpty()
    tty.setraw(slave)
    print(os.ttyname(slave), flush=True)
    while data := os.read(master, 4096):
        os.write(master, data)


gc.disable()
_, place = sys.argv
if place == "pty":
    on_a_pseudo_terminal()
else:
    on_a_connection(int(place))
