"""Web pages of other origins in real Chromium: one from another port, and one whose host name is rebound to
this machine (DNS rebinding). On both ports their requests move nothing and read nothing."""
# labels: full

import json
import pathlib
import unittest

from browser import CHROMIUM, MISSING, Chromium, Site
from proxy import Proxy
from support import LOCALHOST, ROOT, Server, machine

ATTACKS = pathlib.Path(ROOT, "tests/integration/attacks.js").read_text(encoding="utf-8")
STEP = '{"op":"call","id":"page","fn":"step","args":{"ticks":100}}\n'
MOVES = "F+100\rA$\rLM"
# The bytes of HTTP method names are commands that switch output lines and ports: both initial states are
# tried.
EVERYTHING_HIGH = "LNP1P2P3P4P5P6P7P8E+30\r"
EVERYTHING_LOW = "MOR1R2R3R4R5R6R7R8E+30\r"
METHODS = ["E+50", "P1", "L", "P1P2LNE+50C+33F-20", *("P1L" * count for count in (100, 1000, 30_000, 100_000))]
# Words that a page must never read: parts of a state, a robot file, a `hello` and the metrics.
SECRETS = ["joints", "hello", "tick", "xr3_", "polylines", "rows"]


class Robot:
    """A robot in the middle of a move, with all outputs high or low, and the attacks of pages on it."""

    def __init__(self, test, setup):
        self.test = test
        self.xr3 = test.enterContext(Server())
        self.monitor = test.enterContext(self.xr3.monitor())
        self.line = test.enterContext(self.xr3.line())
        self.line.send(setup)
        self.monitor.step(100, after=self.line)
        self.before = machine(self.monitor.get())

    def attack(self, page, base, call):
        """Runs all attacks of attacks.js; none may read anything or change the robot."""
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
class PagesOfOtherSites(unittest.TestCase):
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

    def test_a_page_of_a_rebound_name(self):
        """The host name resolves to another site until the page is loaded, then to this machine."""
        robot = Robot(self, EVERYTHING_LOW)
        for port, call in (robot.xr3.monitor_port, STEP), (robot.xr3.robot_port, MOVES):
            with Site() as site, Proxy(site.port) as resolver, \
                    Chromium(hosts={f"evil.test:{port}": f"{LOCALHOST}:{resolver.port}"}) as browser:
                page = browser.open(f"http://evil.test:{port}/")
                resolver.redirect(port)
                tried = dict(robot.attack(page, f"http://evil.test:{port}/", call))
                if port == robot.xr3.monitor_port:
                    self.assertRegex(tried["fetch same-origin /state"], "^read: 403 ", "it may read the error")

    def test_a_rebound_page_with_methods_that_are_commands(self):
        """On the robot port a page may choose the method: a long one arrives in more than one piece."""
        robot = Robot(self, EVERYTHING_LOW)
        port = robot.xr3.robot_port
        with Site() as site, Proxy(site.port) as resolver, \
                Chromium(hosts={f"evil.test:{port}": f"{LOCALHOST}:{resolver.port}"}) as browser:
            page = browser.open(f"http://evil.test:{port}/")
            resolver.redirect(port)
            for method in METHODS:
                with self.subTest(method[:20], length=len(method)):
                    page.run(f"fetch('/', {{method: {json.dumps(method)}}}).catch(() => 0)")
                    self.assertEqual(32 + 19, robot.line.ask("E?"))
                    self.assertEqual(robot.before, machine(robot.monitor.get()))
        robot.xr3.wait_log("client sent HTTP", times=len(METHODS))


if __name__ == "__main__":
    unittest.main()
