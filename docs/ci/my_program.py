"""An example of a program under test: turns the shoulder by 50 counts."""

import os
import socket

robot = socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"])))
robot.sendall(b"E+50\r")
to_go = 50
while to_go > 0:
    robot.sendall(b"E?")
    to_go = robot.recv(1)[0] - 32
print("E is there")
