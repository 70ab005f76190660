"""Idle monitor clients, in real time: an idle JSON line stays open; a WebSocket that does not answer pings is
closed after half a minute, and so is a client that does not read."""

import asyncio
import os
import re
import signal
import time
import unittest
import urllib.request

from support import LOCALHOST, XR3, Monitor, Server, connect
from terminal import Terminal
from web_viewer import UPGRADE, Viewer

GONE_S = 30.0
SOON_S = 10.0  # tolerance


def connections(xr3):
    """The number of monitor clients, from /metrics."""
    with urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}/metrics") as answer:
        return int(re.search(r"^xr3_viewers\S* (\d+)", answer.read().decode(), re.MULTILINE)[1])


class Silence(unittest.IsolatedAsyncioTestCase):
    async def test_dead_clients_are_closed_after_half_a_minute(self):
        with Server("--log-level", "warn") as xr3, Server("--log-level", "warn") as other, xr3.monitor() as person:
            async with Viewer(xr3) as listener:  # the library answers pings automatically
                await asyncio.gather(asyncio.to_thread(self.mute_websocket, xr3), asyncio.to_thread(self.stuck, other))
                self.assertEqual("pong", (await listener.ask(op="ping"))["op"])
            self.assertEqual("pong", person.request("ping")["op"])

    async def test_watch_detects_a_server_that_hangs(self):
        with Server("--log-level", "warn") as xr3, Terminal([XR3, "watch", f"localhost:{xr3.monitor_port}"]) as terminal:
            terminal.wait_text("-90.00 deg")
            os.kill(xr3.pid, signal.SIGSTOP)
            try:
                terminal.wait_text("does not answer")
            finally:
                os.kill(xr3.pid, signal.SIGCONT)
            terminal.wait_for(lambda text: "retrying" not in text)

    def mute_websocket(self, xr3):
        """Reads, but does not answer the pings of the server."""
        with connect(xr3.monitor_port) as sock:
            started = time.monotonic()
            sock.settimeout(GONE_S + SOON_S)
            sock.sendall(UPGRADE)
            pings = 0
            try:
                while data := sock.recv(65536):
                    pings += data.count(b"\x89")
            except ConnectionResetError:
                pass
            took_s = time.monotonic() - started
            self.assertTrue(GONE_S / 2 < took_s < GONE_S + SOON_S, took_s)
            self.assertGreater(pings, 0)

    def stuck(self, xr3):
        """Sends requests and does not read the answers."""
        stuck = Monitor(xr3.monitor_port, buffer_bytes=4096)
        stuck.socket.setblocking(False)
        try:
            while True:
                stuck.socket.send(b'{"op":"get","channel":"image"}\n' * 1000)
        except BlockingIOError:
            pass
        before, started = connections(xr3), time.monotonic()
        while connections(xr3) >= before:
            self.assertLess(time.monotonic() - started, 2 * GONE_S + SOON_S)
            time.sleep(0.5)  # the timeout under test is real time
        self.assertGreater(time.monotonic() - started, GONE_S / 2)
        stuck.close()


if __name__ == "__main__":
    unittest.main()
