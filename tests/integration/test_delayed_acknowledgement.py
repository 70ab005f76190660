"""Clients that do not set TCP_NODELAY: their kernel holds small writes back until the server has acknowledged the one
before, so "write, write, read" must not wait for a delayed acknowledgement (40 ms)."""

import os
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import unittest

from support import DEADLINE_S, XR3, Server

ROUNDS = 40
ROUND_S = 0.02  # half a delay; a round takes less than 1 ms
PROGRAM = """
import os, socket
line = socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"])))
for number in range(300):
    line.sendall(b"E+1\\r")
    line.sendall(b"E?")
    assert line.recv(1)
"""


def median_round_s(port, writes, expected):
    """The median time to write each of `writes` separately and to read a reply that contains `expected`."""
    with socket.create_connection(("127.0.0.1", port), timeout=DEADLINE_S) as line:
        times = []
        for _ in range(ROUNDS):
            started = time.monotonic()
            for text in writes:
                line.sendall(text)
            reply = b""
            while expected not in reply:
                part = line.recv(65536)
                assert part, reply
                reply += part
            times.append(time.monotonic() - started)
    return statistics.median(times)


class DelayedAcknowledgement(unittest.TestCase):
    def test_a_move_and_an_inquiry(self):
        with Server(clock="real") as xr3:
            self.assertLess(median_round_s(xr3.robot_port, [b"EX", b"E?"], b" "), ROUND_S)

    def test_a_request_in_parts(self):
        with Server(clock="real") as xr3:
            parts = [b'{"op":"get","id":7,', b'"channel":"state","fields":["moving"]}', b"\n"]
            self.assertLess(median_round_s(xr3.monitor_port, parts, b'"id":7'), ROUND_S)

    def test_a_program_of_xr3_exec(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "program.py")
            with open(path, "w", encoding="utf-8") as program:
                program.write(PROGRAM)
            result = subprocess.run([XR3, "exec", "--clock", "bytes:20", "--max-seconds", "10", "--", sys.executable, path],
                                    capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual(0, result.returncode, result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()
