"""Runs in a second container and connects to the server by the name of its service, HOST: as a browser
(page and WebSocket) and as a program (calls, serial line). Usage: by_name.py HOST TOKEN"""

import json
import socket
import sys
import urllib.request

from xr3 import Monitor, MonitorError, Robot

HOST, TOKEN = sys.argv[1:]
HANDSHAKE = (f"GET /ws HTTP/1.1\r\nHost: {HOST}:9601\r\nOrigin: http://{HOST}:9601\r\n"
             "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\n\r\n")


class WebSocket:
    """The part of RFC 6455 that short text messages need; the mask is zero."""

    def __init__(self):
        self.socket = socket.create_connection((HOST, 9601), 20)
        self.socket.sendall(HANDSHAKE.encode())
        self.file = self.socket.makefile("rb")
        head = b"".join(iter(self.file.readline, b"\r\n"))
        assert head.startswith(b"HTTP/1.1 101 "), head

    def send(self, **message):
        text = json.dumps(message).encode()
        assert len(text) < 126
        self.socket.sendall(bytes([0x81, 0x80 | len(text), 0, 0, 0, 0]) + text)

    def read(self):
        size = self.file.read(2)[1]
        if size == 126:
            size = int.from_bytes(self.file.read(2), "big")
        return json.loads(self.file.read(size))


def call_by_websocket():
    page = WebSocket()
    assert page.read()["op"] == "hello"
    page.send(op="call", id=1, fn="home")
    assert page.read()["error"]["code"] == "token_required"
    page.send(op="auth", id=2, token=TOKEN)
    assert page.read()["ok"]
    page.send(op="call", id=3, fn="home")
    assert page.read()["ok"]


def call_by_lines():
    with Monitor(HOST) as monitor:
        try:
            monitor.call("pause")
            raise AssertionError("a call without a token was executed")
        except MonitorError as refused:
            assert refused.code == "token_required"
    with Monitor(HOST, token=TOKEN) as monitor:
        monitor.call("pause")
        monitor.call("resume")


with urllib.request.urlopen(f"http://{HOST}:9601/", timeout=20) as answer:
    assert b"<!doctype html>" in answer.read()
print("page")
call_by_websocket()
print("websocket")
call_by_lines()
print("calls")
with Robot(HOST) as robot:
    assert robot.to_go("E") == 0
print("line")
