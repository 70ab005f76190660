"""1. Hello: connect to the robot, ask it two questions, print the answers.

    python3 1_hello.py [HOST [PORT]]

A robot on a serial line knows no lines of text and no "OK". It answers a question with one byte,
and everything else with silence.
"""

import os
import socket
import sys

host = sys.argv[1] if len(sys.argv) > 1 else os.environ.get("XR3_HOST", "localhost")
port = int(sys.argv[2] if len(sys.argv) > 2 else os.environ.get("XR3_PORT", "9600"))
robot = socket.create_connection((host, port))

# How far has the shoulder, joint E, still to go? The answer is counted from 32, the code of a
# blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and so on.
robot.sendall(b"E?")
reply = robot.recv(1)[0]
print(f"E? is answered by {reply}: {reply - 32} counts to go")

# Which microswitches are closed? Again 32 is added; each switch has a bit of its own.
robot.sendall(b"I")
reply = robot.recv(1)[0]
print(f"I is answered by {reply}: switches {reply - 32}")

robot.close()
