"""The server stops within two seconds, whatever a thousand clients have requested and not read."""
# labels: release serial

import json
import pathlib
import resource
import socket
import tempfile
import unittest

from support import LOCALHOST, ROOT, Server

CLIENTS = 1000
REQUESTS = {
    "images on lines": ("robot_port", b"A**" * 3),
    "images over HTTP": ("monitor_port", b"GET /camera.pbm HTTP/1.1\r\nHost: localhost\r\n\r\n" * 3),
    "images as JSON": ("monitor_port", b'{"op":"get","channel":"image"}\n' * 3),
}


class Shutdown(unittest.TestCase):
    def setUp(self):
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, (soft, hard))
        folder = self.enterContext(tempfile.TemporaryDirectory())
        workcell = json.loads(pathlib.Path(ROOT, "data/workcells/rhino-xr3.json").read_text(encoding="utf-8"))
        workcell["camera"]["pixels"] = [1000, 1000]
        self.workcell = pathlib.Path(folder, "large.json")
        self.workcell.write_text(json.dumps(workcell), encoding="utf-8")

    def client(self, port, request):
        sock = socket.socket()
        self.addCleanup(sock.close)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        sock.connect((LOCALHOST, port))
        sock.sendall(request)
        return sock

    def test_unread_images(self):
        for what, (port, request) in REQUESTS.items():
            options = "--max-lines", CLIENTS, "--workcell", self.workcell, "--log-level", "warn"
            with self.subTest(what), Server(*options, clock="real") as xr3:
                socks = [self.client(getattr(xr3, port), request) for _ in range(CLIENTS)]
                socks[-1].recv(1)  # the last one has been noticed
                self.assertEqual(0, xr3.stop())


if __name__ == "__main__":
    unittest.main(verbosity=2)
