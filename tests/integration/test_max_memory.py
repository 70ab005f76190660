"""Many clients that do not read what they have requested: the process keeps to --max-memory, the greediest clients
are closed, and the others are served."""
# labels: release serial full

import json
import pathlib
import re
import socket
import tempfile
import unittest

from support import LOCALHOST, NO_QUARANTINE, ROOT, Server

LIMIT_MIB = 64
CLIENTS = 500
MOST_HELD_MIB = 2  # by one client
KERNEL_BYTES = 300_000  # that a socket takes at most
# Beyond the limit: the program itself, freed memory that the allocator keeps, and the sanitizer's shadow.
MARGIN_MIB = 160
REQUESTS = {
    "images on lines": ("robot_port", b"A**" * 12),
    "endless requests": ("monitor_port", b'{"op":"ping","id":"' + b"x" * 250_000),
}


class MaxMemory(unittest.TestCase):
    def setUp(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        workcell = json.loads(pathlib.Path(ROOT, "data/workcells/rhino-xr3.json").read_text(encoding="utf-8"))
        workcell["camera"]["pixels"] = [1000, 1000]
        self.workcell = pathlib.Path(folder, "large.json")
        self.workcell.write_text(json.dumps(workcell), encoding="utf-8")

    def serve(self):
        return Server("--workcell", self.workcell, "--max-memory", LIMIT_MIB, "--max-lines", CLIENTS + 1, clock="real",
                      environment=NO_QUARANTINE)

    def client(self, port, request):
        sock = socket.socket()
        self.addCleanup(sock.close)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        sock.connect((LOCALHOST, port))
        sock.sendall(request)
        return sock

    def test_the_kernel_keeps_little_of_what_a_client_does_not_read(self):
        with self.serve() as xr3, xr3.monitor() as monitor:
            self.client(xr3.robot_port, b"A**" * 4)
            while not (sent := sum(line["bytes_out"] for line in monitor.call("lines")["lines"])):
                pass
            self.assertLess(sent, KERNEL_BYTES)
            self.assertGreater(4 * 1000 * 1000 // 6, 2 * KERNEL_BYTES, "the images are larger")

    def test_the_greediest_clients_are_closed(self):
        for what, (port, request) in REQUESTS.items():
            with self.subTest(what), self.serve() as xr3, xr3.line() as good:
                self.assertEqual(32, good.ask("E?"))
                before = xr3.status("VmRSS") / 1024
                for _ in range(CLIENTS):
                    self.client(getattr(xr3, port), request)
                    self.assertEqual(32, good.ask("E?"))
                log = xr3.wait_log("more memory than --max-memory, and this client has the most unread")
                kept = CLIENTS - log.count("more memory")
                closed = re.findall(r"the connection of (\S+) is closed", log)
                self.assertCountEqual(set(closed), closed, "no client is closed twice")
                self.assertGreater(kept * MOST_HELD_MIB, LIMIT_MIB, "no more are closed than necessary")
                self.assertLess(xr3.status("VmHWM") / 1024, before + LIMIT_MIB + MARGIN_MIB)

    def test_a_shared_picture_exists_once(self):
        """1 MB for each of 500 clients would be 500."""
        with self.serve() as xr3, xr3.line() as good:
            for _ in range(CLIENTS):
                self.client(xr3.monitor_port, b"GET /camera.pbm HTTP/1.1\r\nHost: localhost\r\n\r\n" * 3)
                self.assertEqual(32, good.ask("E?"))
            self.assertNotIn("more memory", xr3.log())


if __name__ == "__main__":
    unittest.main(verbosity=2)
