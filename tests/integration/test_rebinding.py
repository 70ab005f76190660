"""Pages of other sites in a real Chromium: one from another port, and one whose name has come to stand
for this machine. Whatever they try on both ports, nothing moves and nothing is read."""

import json
import pathlib
import unittest

from browser import CHROMIUM, MISSING, Chromium, Site
from proxy import Proxy
from support import LOCALHOST, ROOT, Server, machine

ATTACKS = pathlib.Path(ROOT, "tests/integration/attacks.js").read_text(encoding="utf-8")
STEP = '{"op":"call","id":"page","fn":"step","args":{"ticks":100}}\n'
MOVES = "F+100\rA$\rLM"
# Bytes of the names of HTTP's methods move output lines and ports: each way is tried.
EVERYTHING_HIGH = "LNP1P2P3P4P5P6P7P8E+30\r"
EVERYTHING_LOW = "MOR1R2R3R4R5R6R7R8E+30\r"
# What a page must never get hold of: part of what a state, a robot file, a greeting or metrics say.
SECRETS = ["joints", "hello", "tick", "xr3_", "polylines", "rows"]


class Robot:
    """A robot in the middle of a move, all its outputs high or low, and what pages try against it."""

    def __init__(self, test, setup):
        self.test = test
        self.xr3 = test.enterContext(Server())
        self.monitor = test.enterContext(self.xr3.monitor())
        self.line = test.enterContext(self.xr3.line())
        self.line.send(setup)
        self.monitor.step(100, after=self.line)
        self.before = machine(self.monitor.get())

    def attack(self, page, base, call):
        """Everything is tried; nothing may come of it."""
        tried = page.run(f"({ATTACKS})({json.dumps(base)}, {json.dumps(call)})")
        self.test.assertGreater(len(tried), 50)
        for attempt, came in tried:
            for secret in SECRETS:
                self.test.assertNotIn(secret, came, f"{attempt} at {base}")
            if "WebSocket" in attempt or attempt in ("events", "image", "drawing"):
                self.test.assertIn(came, ("error", "failed"), f"{attempt} at {base}")
        self.test.assertEqual(32 + 19, self.line.ask("E?"))
        self.test.assertEqual((self.before, 100), (machine(self.monitor.get()), self.monitor.get()["tick"]))
        return tried


@unittest.skipUnless(CHROMIUM, MISSING)
class Strangers(unittest.TestCase):
    def test_a_page_from_another_port(self):
        with Site() as site, Chromium() as browser:
            page = browser.open(site.url)
            for setup in EVERYTHING_HIGH, EVERYTHING_LOW:
                robot = Robot(self, setup)
                monitor_port, robot_port = robot.xr3.monitor_port, robot.xr3.robot_port
                for base, call in [(f"http://{LOCALHOST}:{monitor_port}/", STEP),
                                   (f"http://localhost:{monitor_port}/", STEP),
                                   (f"http://{LOCALHOST}:{robot_port}/", MOVES)]:
                    for attempt, came in robot.attack(page, base, call):
                        self.assertNotIn("read", came, f"{attempt} at {base}")
                robot.xr3.wait_log("client sent HTTP", times=5)

    def test_a_page_by_a_rebound_name(self):
        """Its name stands for another site until the page is loaded, then for this machine."""
        robot = Robot(self, EVERYTHING_LOW)
        for port, call in (robot.xr3.monitor_port, STEP), (robot.xr3.robot_port, MOVES):
            with Site() as site, Proxy(site.port) as resolver, \
                    Chromium(hosts={f"evil.test:{port}": f"{LOCALHOST}:{resolver.port}"}) as browser:
                page = browser.open(f"http://evil.test:{port}/")
                resolver.target = port
                tried = dict(robot.attack(page, f"http://evil.test:{port}/", call))
                if port == robot.xr3.monitor_port:
                    self.assertRegex(tried["fetch same-origin /state"], "^read: 403 ", "an error is no secret")


if __name__ == "__main__":
    unittest.main()
