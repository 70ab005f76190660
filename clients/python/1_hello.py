"""1. Hello: connect to the robot, ask it two questions, print the answers.

    python3 1_hello.py [HOST [PORT]]

The robot's serial protocol has no lines of text and no "OK". The robot answers most questions with
one byte and does not answer other commands.
"""

import os
import socket
import sys

# Host and port: from the arguments, else from the environment, else the defaults.
host = sys.argv[1] if len(sys.argv) > 1 else os.environ.get("XR3_HOST") or "localhost"
port = sys.argv[2] if len(sys.argv) > 2 else os.environ.get("XR3_PORT") or "9600"
if not port.isdecimal() or not 1 <= int(port) <= 65535:
    sys.exit(f"the port has to be a number from 1 to 65535, not {port!r}")
try:
    robot = socket.create_connection((host, int(port)), timeout=5)
except OSError as error:
    sys.exit(f"no robot answers at {host} port {port}: is the server running? ./run ({error})")


def ask(question):
    """Sends a question and returns the one-byte answer as a number."""
    robot.sendall(question)
    try:
        answer = robot.recv(100)
    except socket.timeout:
        answer = b""
    if len(answer) != 1:
        sys.exit("no robot answers like this; is it the monitor port? The robot port is 9600")
    return answer[0]


# Ask how many counts the shoulder, joint E, still has to go. 32, the code of a blank, is added to
# the answer to make it printable: a blank means 0 counts to go, "!" means 1, and so on.
reply = ask(b"E?")
print(f"E? is answered by {reply}: {reply - 32} counts to go")

# Which microswitches are closed? Again 32 is added; each switch has one bit.
reply = ask(b"I")
print(f"I is answered by {reply}: switches {reply - 32}")

robot.close()
