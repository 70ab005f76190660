"""A serial line over WebSocket: the bytes of binary messages are those of a connection to the robot port, with its limits, faults
and ends."""

import socket
import struct
import unittest

from support import DEADLINE_S, LOCALHOST, Server
from test_access import TOKEN, WRONG, TokenFile

BINARY, TEXT, CLOSE = 0x82, 0x81, 0x88
POLICY, UNKNOWN, NORMAL = 1008, 1003, 1000


class LineWebsocket:
    """The part of RFC 6455 that messages of less than 126 bytes need; the mask is zero."""

    def __init__(self, xr3, path="/line", **fields):
        self.socket = socket.create_connection((LOCALHOST, xr3.monitor_port), DEADLINE_S)
        fields = {"Host": "localhost", "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
                  "Sec-WebSocket-Key": "MDEyMzQ1Njc4OWFiY2RlZg==", **fields}
        head = [f"GET {path} HTTP/1.1", *(f"{name.replace('_', '-')}: {value}" for name, value in fields.items())]
        self.socket.sendall("\r\n".join([*head, "", ""]).encode())
        self.file = self.socket.makefile("rb")
        self.head = b"".join(iter(self.file.readline, b"\r\n")).decode()
        self.status = int(self.head.split()[1])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.file.close()
        self.socket.close()

    def send(self, data, kind=BINARY):
        assert len(data) < 126
        self.socket.sendall(bytes([kind, 0x80 | len(data), 0, 0, 0, 0]) + data)

    def auth(self, token):
        self.send(b'{"op":"auth","token":"%s"}' % token.encode(), TEXT)

    def frame(self):
        kind, size = self.file.read(2)
        if size == 126:
            size = int.from_bytes(self.file.read(2), "big")
        elif size == 127:
            size = int.from_bytes(self.file.read(8), "big")
        return kind, self.file.read(size)

    def read(self, size):
        """Reads so many bytes of binary messages."""
        data = b""
        while len(data) < size:
            kind, more = self.frame()
            assert kind == BINARY, (kind, more)
            data += more
        return data

    def closed(self):
        """Returns code and reason of the close frame, which is the next."""
        kind, data = self.frame()
        assert kind == CLOSE, (kind, data)
        return struct.unpack(">H", data[:2])[0], data[2:].decode()


class Case(unittest.TestCase):
    def line(self, xr3, *args, **fields):
        return self.enterContext(LineWebsocket(xr3, *args, **fields))


class Lines(Case):
    def test_it_is_a_line_of_the_robot_port(self):
        with Server() as xr3, xr3.monitor() as monitor:
            line = self.line(xr3, Sec_WebSocket_Protocol="xr3.line.v1")
            self.assertEqual(101, line.status)
            self.assertIn("Sec-WebSocket-Protocol: xr3.line.v1\r\n", line.head)
            line.send(b"F+5\rF?")
            self.assertEqual(b"%", line.read(1))
            (entry,) = monitor.call("lines")["lines"]
            self.assertEqual(("tcp", 6), (entry["kind"], entry["bytes_in"]))
            self.assertEqual("%s:%d" % line.socket.getsockname(), entry["peer"])
            monitor.call("line_disconnect", line=entry["line"])
            self.assertEqual((NORMAL, "the line is closed"), line.closed())

    def test_an_empty_message_ends_the_input(self):
        with Server() as xr3, xr3.monitor() as monitor:
            line = self.line(xr3)
            line.send(b"F?E?")
            line.send(b"")
            self.assertEqual(b"  ", line.read(2))
            self.assertEqual((NORMAL, "the line is closed"), line.closed())
            self.assertEqual([], monitor.call("lines")["lines"])

    def test_a_line_ends_with_its_connection(self):
        with Server() as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            with LineWebsocket(xr3) as line:
                line.send(b"E?")
                line.read(1)
            while monitor.read().get("event") != "line_close":
                pass
            self.assertEqual([], monitor.call("lines")["lines"])

    def test_faults_of_lines_act_on_it(self):
        with Server() as xr3, xr3.monitor() as monitor:
            monitor.call("fault_set", fault={"name": "cut", "kind": "line_disconnected", "after_bytes": 4})
            line = self.line(xr3)
            line.send(b"E?E?E?")
            self.assertEqual(b"  ", line.read(2))
            self.assertEqual(NORMAL, line.closed()[0])

    def test_beyond_the_limit_it_is_closed(self):
        with Server("--max-lines", "1") as xr3:
            first, second = self.line(xr3), self.line(xr3)
            self.assertEqual(NORMAL, second.closed()[0])
            first.send(b"E?")
            self.assertEqual(b" ", first.read(1))

    def test_a_client_that_reads_nothing_stops_only_its_own_line(self):
        with Server() as xr3, xr3.line() as other:
            line = self.line(xr3)
            line.socket.settimeout(0.5)
            with self.assertRaises(TimeoutError):
                for _ in range(1_000_000):
                    line.send(b"E?" * 60)
            self.assertEqual(32, other.ask("E?"))

    def test_text_is_refused(self):
        with Server() as xr3:
            line = self.line(xr3)
            line.send(b"E?")
            line.read(1)
            line.send(b"E?", TEXT)
            self.assertEqual((UNKNOWN, "a line carries binary messages"), line.closed())


class Access(Case):
    def test_it_needs_the_token(self):
        path = self.enterContext(TokenFile())
        with Server("--token-file", path) as xr3:
            good, bad, without = self.line(xr3), self.line(xr3), self.line(xr3)
            good.auth(TOKEN)
            good.send(b"E?")
            self.assertEqual(b" ", good.read(1))
            bad.auth(WRONG)
            without.send(b"E?")
            for refused in bad, without:
                self.assertEqual((POLICY, 'send {"op":"auth","token":"..."} first'), refused.closed())

    def test_a_token_that_is_not_needed_is_no_byte_of_the_line(self):
        with Server() as xr3:
            line = self.line(xr3)
            line.auth(TOKEN)
            line.send(b"E?")
            self.assertEqual(b" ", line.read(1))

    def test_each_cell_has_its_own_lines(self):
        with Server("--cell", "a=rhino-xr3", "--cell", "b=adept-one") as xr3, xr3.monitor() as monitor:
            line = self.line(xr3, "/line?cell=b")
            line.send(b"E?")
            line.read(1)
            self.assertEqual([0, 1], [len(monitor.request("call", fn="lines", cell=name)["value"]["lines"]) for name in "ab"])
            self.assertEqual(404, self.line(xr3, "/line?cell=c").status)

    def test_pages_of_other_origins_are_refused(self):
        with Server() as xr3:
            self.assertEqual(403, self.line(xr3, Origin="http://evil.example").status)
            self.assertEqual(400, self.line(xr3, Sec_WebSocket_Protocol="xr3.v1").status)


if __name__ == "__main__":
    unittest.main()
