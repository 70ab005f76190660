"""A WebSocket client of the monitor port, implemented with python3-websockets. It checks every message that
it reads against the schema."""

import asyncio
import json

import websockets

import monitor_schema
from support import DEADLINE_S, LOCALHOST

SUBPROTOCOL = "xr3.v1"
UPGRADE = (b"GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
           b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")


# The versions of python3-websockets differ in names; these suit all.
REFUSED = websockets.InvalidHandshake


def status_of(refusal):
    """The HTTP status of the refusal of a handshake."""
    return refusal.response.status_code if hasattr(refusal, "response") else refusal.status_code


def extensions_of(socket):
    """The extensions that client and server have agreed on."""
    return getattr(socket, "protocol", socket).extensions


class Viewer:
    """An asynchronous context manager. `hello` is the first message of the server."""

    def __init__(self, xr3, **options):
        options = {"subprotocols": [SUBPROTOCOL], "max_size": None, **options}
        self._connecting = websockets.connect(f"ws://{LOCALHOST}:{xr3.monitor_port}/ws", **options)

    async def __aenter__(self):
        self.socket = await self._connecting.__aenter__()
        self.hello = await self.read()
        return self

    async def __aexit__(self, *problem):
        await self._connecting.__aexit__(*problem)

    async def text(self):
        return await asyncio.wait_for(self.socket.recv(), DEADLINE_S)

    async def read(self):
        return monitor_schema.check(json.loads(await self.text()))

    async def ask(self, **request):
        await self.socket.send(json.dumps(request))
        return await self.read()

    async def closed(self):
        """Waits for the close; returns the server's close code."""
        await asyncio.wait_for(self.socket.wait_closed(), DEADLINE_S)
        return self.socket.close_code
