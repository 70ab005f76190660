"""Plays docs/monitor-messages.md against the server and compares every message. With --write it updates the
document instead; `< ?` in the document is the place for a new message."""

import json
import os
import pathlib
import re
import sys
import unittest

import monitor_schema
from support import ROOT, Server, connect
from test_transcripts import unescaped

DOCUMENT = pathlib.Path(ROOT, "docs", "monitor-messages.md")
COMMAND = re.compile(r"\$ ((?:\w+=\S+ )*)xr3 serve --clock (manual|bytes)")
REPEATED = re.compile(r"(.*) \((\d+) times\)")
CALLS = re.compile(r'("op":"hello".*"calls":\["pause"),.*?\]')  # the list of calls grows
PEER = re.compile(r"127\.0\.0\.1:\d+")  # differs from run to run
FREE_PORT = re.compile(r'("cell":"main-b1","robot_port":)\d+')  # a free port differs in each run


class Player:
    """One block of the document: a server, a client of its monitor port, and a serial line."""

    def __init__(self, command):
        settings, clock = COMMAND.fullmatch(command).groups()
        environment = dict(pair.split("=") for pair in settings.split())
        self.server = Server("--log-level", "error", clock=clock, environment=environment)

    def __enter__(self):
        self.server.__enter__()
        self.socket = connect(self.server.monitor_port)
        self.file = self.socket.makefile("rb")
        self.socket.sendall(b'{"op":"ping"}\n')
        self.greeting = self.file.readline()
        assert json.loads(self.file.readline()) == {"op": "pong", "id": None}
        return self

    def __exit__(self, *problem):
        self.file.close()
        self.socket.close()
        self.server.__exit__(*problem)

    def send(self, text):
        self.socket.sendall(text.encode() + b"\n")

    def write(self, text):
        repeated = REPEATED.fullmatch(text)
        data = unescaped(repeated[1]) * int(repeated[2]) if repeated else unescaped(text)
        line = self.server.lines[0] if self.server.lines else self.server.line()
        line.send(data)

    def read(self):
        text, self.greeting = self.greeting or self.file.readline(), b""
        monitor_schema.check(json.loads(text), is_whole=False)
        shown = CALLS.sub(r"\1,...]", text.decode().rstrip("\n"))
        return FREE_PORT.sub(r"\g<1>40123", PEER.sub("127.0.0.1:51022", shown))


def played():
    """(number, line, the same line with the message of the server) of each line of the document."""
    player = None
    lines = DOCUMENT.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        if COMMAND.fullmatch(line):
            player = Player(line).__enter__()
            if not lines[number].startswith("<"):
                player.read()  # a `hello` that is not in the document
        elif line.startswith("```") and player:
            player.__exit__(None, None, None)
            player = None
        elif line.startswith("> "):
            player.send(line[2:])
        elif line.startswith("robot> "):
            player.write(line[7:])
        yield number, line, "< " + player.read() if line.startswith("<") else line


class Examples(unittest.TestCase):
    def test_every_message(self):
        messages = 0
        for number, written, said in played():
            self.assertEqual(written, said, f"{DOCUMENT.name}:{number}")
            messages += said.startswith("<")
        self.assertGreater(messages, 60)


if __name__ == "__main__":
    if "--write" in sys.argv:
        DOCUMENT.write_text("".join(said + os.linesep for _, _, said in list(played())), encoding="utf-8")
    else:
        unittest.main()
