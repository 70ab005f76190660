"""A page of another site makes real Chromium connect to the robot port with WebRTC, which needs no permission of
the port: ICE over TCP, where the page chooses the name that is sent, TURN over TCP and over TLS. Nothing moves."""
# labels: full

import json
import pathlib
import unittest

from browser import CHROMIUM, MISSING, Chromium, Site
from support import LOCALHOST, ROOT, Server, machine

CONNECT = pathlib.Path(ROOT, "tests/integration/webrtc.js").read_text(encoding="utf-8")
# The names of ICE consist of letters, digits, + and /, which suffice for moves and outputs.
NAMES = ["////E+50/C+33/E+40/", "A+9/P1/L/N/" * 23]
SERVERS = [*((f"{protocol}:{LOCALHOST}:%d", name) for protocol in ("tcp", "ssltcp") for name in NAMES),
           (f"turn:{LOCALHOST}:%d?transport=tcp", NAMES[0]), (f"turns:{LOCALHOST}:%d?transport=tcp", NAMES[0])]


@unittest.skipUnless(CHROMIUM, MISSING)
class WebRtc(unittest.TestCase):
    def test_a_page_of_another_site(self):
        with Site() as site, Chromium(hosts={"evil.test": LOCALHOST}) as browser:
            page = browser.open(f"http://evil.test:{site.port}/")
            for server, name in SERVERS:
                with self.subTest(server, name=name), Server() as xr3, xr3.monitor() as monitor:
                    self.connect(page, xr3, monitor, server % xr3.robot_port, name)

    def connect(self, page, xr3, monitor, server, name):
        before = machine(monitor.get())
        monitor.subscribe("event")
        page.run(f"({CONNECT})({json.dumps(server)}, {json.dumps(name)})")
        opened, then = monitor.read(), monitor.read()
        self.assertEqual(("line_open", "stranger"), (opened["code"], then["code"]), then)
        xr3.wait_log("its client sent HTTP, TLS, STUN or other bytes .* none of its bytes were executed")
        self.assertEqual(before, machine(monitor.get()))


if __name__ == "__main__":
    unittest.main()
