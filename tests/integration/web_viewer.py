"""A client of the monitor port by WebSocket, of another library (Debian package python3-websockets). Every
message that it reads is checked against the schema."""

import asyncio
import json

import websockets

import monitor_schema
from support import DEADLINE_S, LOCALHOST

SUBPROTOCOL = "xr3.v1"
UPGRADE = (b"GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
           b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")


class Viewer:
    """As an asynchronous context. `hello` is the greeting."""

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
        """The code that the server closes with."""
        await asyncio.wait_for(self.socket.wait_closed(), DEADLINE_S)
        return self.socket.close_code
