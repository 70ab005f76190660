"""Exercise 7, by Finn: waits for a reply to a move. There is none."""

import os
import socket

line = socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"])))
line.sendall(b"A-16\r")
while line.recv(1) != b"O":
    pass
print("the jaws are open")
