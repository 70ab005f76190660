"""A server that can open no file: what it counts, logs, and tells health checks and a service manager. (Not under sanitizers, which need
descriptors for their checks.)"""
# labels: release

import contextlib
import resource
import unittest

from support import Server, connect
from test_cells import get
from test_metrics import metrics, of_cell
from test_service_manager import SILENCE_S, empty, is_silent, received, watched

STANDARD_STREAMS = 3


@contextlib.contextmanager
def no_descriptors(xr3):
    """Until the end of the block the server can open nothing."""
    before = resource.prlimit(xr3.pid, resource.RLIMIT_NOFILE)
    resource.prlimit(xr3.pid, resource.RLIMIT_NOFILE, (STANDARD_STREAMS, before[1]))
    yield
    resource.prlimit(xr3.pid, resource.RLIMIT_NOFILE, before)


class WithoutDescriptors(unittest.TestCase):
    def test_failures_to_accept(self):
        """A connection waits in the kernel, and is served as soon as there is a descriptor."""
        with Server() as xr3, connect(xr3.monitor_port) as kept, kept.makefile("rb") as file:
            kept.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")
            file.readline()
            with no_descriptors(xr3):
                line = xr3.line()
                line.send("E?")
                xr3.wait_log("the robot port cannot accept a connection: Too many open files")
                kept.sendall(b"GET /readyz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
                self.assertIn(b"the robot port cannot accept a connection: Too many open files", file.read())
            self.assertEqual(b" ", line.read(1))
            self.assertEqual("ok\n", get(xr3, "/readyz"))
            now = metrics(xr3)
            self.assertGreater(now[of_cell("xr3_accept_failures_total", port="robot")], 0)
            self.assertEqual(0, now[of_cell("xr3_accept_failures_total", port="monitor")])

    def test_a_sign_of_life_that_cannot_be_sent_is_logged(self):
        with watched() as (xr3, sock):
            with no_descriptors(xr3):
                xr3.wait_log("the service manager does not receive WATCHDOG=1: .*: Too many open files")
                empty(sock)
                self.assertTrue(is_silent(sock, SILENCE_S))
            self.assertEqual("WATCHDOG=1", received(sock))


if __name__ == "__main__":
    unittest.main()
