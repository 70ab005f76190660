"""All that other threads of the server do, at once: pictures, looks into the past, branches, and pseudo-terminals
whose programs arrive and leave, beside a line that moves the robot. In the preset `threads` any data race ends the
server."""
# labels: full

import os
import pathlib
import tempfile
import threading
import unittest
import urllib.request

from support import LOCALHOST, MonitorError, Server

ROUNDS = 24


class Threads(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.addCleanup(folder.cleanup)
        self.port = pathlib.Path(folder.name, "port")
        self.failures = []

    def start(self, work, *args):
        def run():
            try:
                for number in range(ROUNDS):
                    work(number, *args)
            except Exception as failure:  # shown by the test
                self.failures.append((work.__name__, failure))

        thread = threading.Thread(target=run)
        thread.start()
        return thread

    # --- The work of each thread in a round.

    def move(self, number, line):
        line.send(f"E{'+-'[number % 2]}20\rF{'+-'[number % 2]}9\r".encode())
        line.ask("E?")

    def picture(self, _, port, path):
        with urllib.request.urlopen(f"http://{LOCALHOST}:{port}{path}") as answer:
            self.assertTrue(answer.read())

    def look(self, number, monitor):
        history = monitor.call("history")
        tick = max(history["epochs"][-1]["from"], history["tick"] - 7 * number)
        monitor.send({"op": "call", "id": "look", "fn": "look",
                      "args": {"tick": tick, "channels": ["state", "image"]}})
        monitor.read_until(lambda message: message["op"] == "result")

    def branch(self, number, monitor):
        if number % 6:
            return
        try:
            history = monitor.call("history")
            monitor.call("branch", tick=max(history["epochs"][-1]["from"], history["tick"] - 20))
        except MonitorError as refused:
            self.assertEqual("limit", refused.code)

    def program(self, number):
        port = os.open(self.port, os.O_RDWR | os.O_NOCTTY)
        try:
            os.write(port, b"E?F?" * (1 + number))
            if number % 2:
                os.read(port, 1)
        finally:
            os.close(port)

    def test_all_at_once(self):
        with Server("--pty", self.port, clock="real") as xr3:
            monitors = [xr3.monitor() for _ in range(2)]
            line = xr3.line()
            self.move(0, line)
            threads = [self.start(self.move, line), self.start(self.look, monitors[0]),
                       self.start(self.branch, monitors[1]), self.start(self.program),
                       self.start(self.picture, xr3.monitor_port, "/camera.png"),
                       self.start(self.picture, xr3.monitor_port, "/view.svg")]
            for thread in threads:
                thread.join()
            self.assertEqual([], self.failures)
            self.assertEqual(32, xr3.line().ask("C?"))


if __name__ == "__main__":
    unittest.main()
