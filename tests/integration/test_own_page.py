"""The server's own page in real Chromium: it may read and make calls under every address of the server, also
through a port mapping."""
# labels: full

import json
import unittest

from browser import CHROMIUM, MISSING, Chromium
from proxy import Proxy
from support import LOCALHOST, Server

STEP = '{"op":"call","id":"page","fn":"step","args":{"ticks":100}}\n'


@unittest.skipUnless(CHROMIUM, MISSING)
class OwnAddress(unittest.TestCase):
    SAME_SITE = """(async () => {
      const state = await (await fetch("/state")).json();
      const answers = await new Promise((done, failed) => {
        const socket = new WebSocket(location.origin.replace("http", "ws") + "/ws", "xr3.v1");
        const got = [];
        socket.onopen = () => socket.send(%s);
        socket.onmessage = message => { got.push(JSON.parse(message.data)); if (got.length == 2) done(got); };
        socket.onerror = failed;
      });
      return {state, answers};
    })()""" % json.dumps(STEP)

    def test_the_page_reads_and_controls(self):
        with Server() as xr3, xr3.monitor() as monitor, Proxy(xr3.monitor_port) as mapping, \
                Chromium(hosts={f"lab.localhost:{xr3.monitor_port}": f"{LOCALHOST}:{xr3.monitor_port}"}) as browser:
            ticks = 0
            for host in (f"{LOCALHOST}:{xr3.monitor_port}", f"localhost:{xr3.monitor_port}",
                         f"lab.localhost:{xr3.monitor_port}", f"{LOCALHOST}:{mapping.port}"):
                with self.subTest(host):
                    seen = browser.open(f"http://{host}/").run(self.SAME_SITE)
                    self.assertEqual("Rhino XR-3", seen["answers"][0]["robot"]["name"])
                    self.assertEqual(ticks, seen["state"]["tick"])
                    ticks += 100
                    self.assertEqual((True, ticks), (seen["answers"][1]["ok"], seen["answers"][1]["value"]["tick"]))
            self.assertEqual(ticks, monitor.get("moving")["tick"])


if __name__ == "__main__":
    unittest.main()
