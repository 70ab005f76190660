"""The reports to a service manager, as systemd receives them: a datagram socket named by NOTIFY_SOCKET."""

import contextlib
import os
import pathlib
import signal
import socket
import tempfile
import unittest
import uuid

from support import DEADLINE_S, Server

WATCHDOG_US = 400_000
FAST = {"WATCHDOG_USEC": str(WATCHDOG_US)}
BEATS = 3
# Times without a sign of life after which a manager would restart the server.
SILENCE_S = 3 * WATCHDOG_US / 1e6


@contextlib.contextmanager
def manager():
    """A socket like that of systemd. Yields it and the value of NOTIFY_SOCKET."""
    with tempfile.TemporaryDirectory() as folder, socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sock:
        path = str(pathlib.Path(folder, "notify"))
        sock.bind(path)
        sock.settimeout(DEADLINE_S)
        yield sock, path


def received(sock):
    return sock.recv(4096).decode()


def is_silent(sock, seconds):
    """Whether nothing arrives in this time."""
    sock.settimeout(seconds)
    try:
        sock.recv(4096)
        return False
    except TimeoutError:
        return True
    finally:
        sock.settimeout(DEADLINE_S)


def empty(sock):
    """Discards what has arrived."""
    sock.setblocking(False)
    with contextlib.suppress(BlockingIOError):
        while True:
            sock.recv(4096)
    sock.settimeout(DEADLINE_S)


class States(unittest.TestCase):
    def test_ready_and_stopping(self):
        with manager() as (sock, value), Server(environment={"NOTIFY_SOCKET": value}) as xr3:
            self.assertEqual("READY=1", received(sock))
            xr3.line().ask("E?")  # clients can connect
            self.assertTrue(is_silent(sock, SILENCE_S), "no watchdog was asked for")
            xr3.stop()
            self.assertEqual("STOPPING=1", received(sock))

    def test_a_server_that_does_not_start_is_not_ready(self):
        with manager() as (sock, value), Server() as first:
            with self.assertRaises(AssertionError):
                with Server("--monitor-port", first.monitor_port, environment={"NOTIFY_SOCKET": value}):
                    pass
            self.assertTrue(is_silent(sock, 0.01))

    def test_without_a_manager(self):
        """Values that make no sense, and a manager that has gone, are logged; the server works."""
        nobody = f"/nonexistent/{uuid.uuid4()}"
        for value, says in [("not/absolute", "NOTIFY_SOCKET is ignored"), ("@" + "x" * 200, "NOTIFY_SOCKET is ignored"),
                            (nobody, f"does not receive READY=1: {nobody}")]:
            with self.subTest(value), Server(environment={"NOTIFY_SOCKET": value}) as xr3:
                xr3.wait_log(says)
                xr3.line().ask("E?")
        with Server(environment={"NOTIFY_SOCKET": ""}) as xr3:
            xr3.line().ask("E?")
            self.assertNotIn("service manager", xr3.log())


@contextlib.contextmanager
def watched(*options, **variables):
    """A server that is ready, and the socket that gets its signs of life."""
    with manager() as (sock, value):
        with Server(*options, environment={"NOTIFY_SOCKET": value, **FAST, **variables}) as xr3:
            assert received(sock) == "READY=1"
            yield xr3, sock


class Watchdog(unittest.TestCase):
    def test_signs_of_life(self):
        with watched() as (xr3, sock), xr3.monitor() as monitor:
            self.assertEqual(["WATCHDOG=1"] * BEATS, [received(sock) for _ in range(BEATS)])
            self.assertEqual([], monitor.recall("event"))
            xr3.stop()
            empty(sock)

    def test_a_wrong_value_is_ignored(self):
        with watched(WATCHDOG_USEC="5s") as (xr3, sock):
            self.assertTrue(is_silent(sock, SILENCE_S))
            self.assertIn("WATCHDOG_USEC is ignored", xr3.log())

    def test_full_lines_are_no_failure(self):
        """Otherwise a client that takes every line could have the server restarted."""
        with watched("--max-lines", 1) as (xr3, sock):
            xr3.line().ask("E?")
            empty(sock)
            self.assertEqual(["WATCHDOG=1"] * BEATS, [received(sock) for _ in range(BEATS)])

    def test_a_process_that_hangs_shows_no_life(self):
        with watched() as (xr3, sock):
            os.kill(xr3.pid, signal.SIGSTOP)
            try:
                empty(sock)
                self.assertTrue(is_silent(sock, SILENCE_S))
            finally:
                os.kill(xr3.pid, signal.SIGCONT)
            self.assertEqual("WATCHDOG=1", received(sock))


if __name__ == "__main__":
    unittest.main()
