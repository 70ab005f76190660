"""Answers of a server of many cells about all of them."""
# labels: release full

import json
import unittest
import urllib.request

from support import LOCALHOST, Server

CELLS = 120


class ManyCells(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.xr3 = Server("--cells", CELLS, clock="real").__enter__()
        cls.addClassCleanup(cls.xr3.__exit__, None, None, None)

    def test_the_call_cells_lists_all(self):
        with self.xr3.monitor() as monitor:
            for _ in range(3):
                listed = monitor.request("call", fn="cells", args={})["value"]["cells"]
                self.assertEqual([str(k) for k in range(1, CELLS + 1)], sorted((cell["name"] for cell in listed), key=int))

    def test_clients_may_ask_at_the_same_time(self):
        monitors = [self.xr3.monitor() for _ in range(4)]
        for monitor in monitors:
            self.addCleanup(monitor.close)
            for number in range(5):
                monitor.send({"op": "call", "id": f"n{number}", "fn": "cells", "args": {}})
        for monitor in monitors:
            answers = [monitor.read() for _ in range(5)]
            self.assertEqual([f"n{number}" for number in range(5)], [answer["id"] for answer in answers])
            self.assertEqual({CELLS}, {len(answer["value"]["cells"]) for answer in answers})

    def test_the_overview_shows_all(self):
        with self.xr3.monitor() as monitor:
            self.assertEqual(CELLS, len(monitor.request("get", channel="overview")["cells"]))

    def test_each_state_is_read_by_http(self):
        for cell in 1, CELLS // 2, CELLS:
            page = f"http://{LOCALHOST}:{self.xr3.monitor_port}/state?cell={cell}"
            with urllib.request.urlopen(page) as answer:
                self.assertEqual("state", json.load(answer)["op"])


if __name__ == "__main__":
    unittest.main()
