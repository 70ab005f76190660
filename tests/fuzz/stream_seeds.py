"""Seeds of the fuzzers of byte streams, in the format of common/pieces.hpp. Used by make_seeds.py."""

import json
import struct

MOST_BYTES = 0xf0       # maximum of one piece
RUN_UNIT = 32 * 1024    # bytes
MOST_RUNS = 16
HOST = b"Host: localhost:9601\r\n"
UPGRADE = (b"Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
           b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: xr3.v1\r\n")
BYTE_ORDER_MARK = b"\xef\xbb\xbf"
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
REQUESTS = (
    {"op": "ping", "id": 1}, {"op": "get", "channel": "state", "fields": ["moving"], "id": "a"},
    {"op": "get", "channel": "event", "since": 1}, {"op": "sub", "channel": "state", "max_hz": 10},
    {"op": "sub", "channel": "line"}, {"op": "unsub", "channel": "state"},
    {"op": "call", "fn": "step", "args": {"ticks": 5}})


def pieces(*parts):
    """Each part is bytes, sent at once if they fit in one piece, or (byte, size): a run of at least size."""
    result = b""
    for part in parts:
        if isinstance(part, tuple):
            byte, size = part
            units = -(-size // RUN_UNIT)
            for at in range(0, units, MOST_RUNS):
                result += bytes([MOST_BYTES - 1 + min(MOST_RUNS, units - at)]) + byte
            continue
        for at in range(0, len(part), MOST_BYTES):
            piece = part[at:at + MOST_BYTES]
            result += bytes([len(piece) - 1]) + piece
    return result


def get(target=b"/healthz", fields=HOST, method=b"GET", version=b"HTTP/1.1"):
    return method + b" " + target + b" " + version + b"\r\n" + fields + b"\r\n"


def heads():
    """Request heads by name."""
    yield "healthz", [get()]
    yield "split", [get()[:20], get()[20:40], get()[40:]]
    yield "state", [get(b"/state?cell=main")]
    yield "view", [get(b"/view.svg?a=b&vector=1%2c-9,0")]
    yield "page_of_a_cell", [get(b"/cell/main")]
    yield "no_camera", [get(b"/camera.pbm", method=b"HEAD")]
    yield "metrics", [get(b"/metrics", version=b"HTTP/1.0")]
    yield "origin", [get(fields=HOST + b"Origin: http://localhost:9601\r\n")]
    yield "address_v6", [get(fields=b"Host: [::1]:80\r\nOrigin: null\r\n")]
    yield "address_v4", [get(fields=b"Host: 127.0.0.1\r\nConnection: close\r\n")]
    yield "wrong_host", [get(fields=b"Host: evil.example\r\n")]
    yield "post", [get(b"/state", HOST + b"Content-Length: 5\r\n", b"POST"), b"12345"]
    yield "chunked", [get(fields=HOST + b"Transfer-Encoding: chunked\r\n"), b"0\r\n\r\n"]
    yield "absolute", [get(b"http://localhost/healthz")]
    yield "folded", [get(fields=HOST + b"A: b\r\n folded\r\n")]
    yield "version", [get(b"*", b"", b"PRI", b"HTTP/2.0")]
    yield "long_target", [b"GET /", (b"a", RUN_UNIT)]
    yield "long_line", [(b"A", RUN_UNIT)]
    yield "fields", [b"GET / HTTP/1.1\r\n" + HOST + b"A: b\r\n" * 64 + b"\r\n"]
    yield "upgrade", [get(b"/ws", HOST + UPGRADE)]


def lines():
    """Streams of the monitor port that are not HTTP, by name."""
    text = b"".join(json.dumps(request, separators=(",", ":")).encode() + b"\n" for request in REQUESTS)
    yield "lines", [text]
    yield "each", text.splitlines(keepends=True)
    yield "crlf", [text.replace(b"\n", b"\r\n\r\n")]
    yield "mark", [b" " + BYTE_ORDER_MARK[:2], BYTE_ORDER_MARK[2:] + b"\r\n" + text[:-1]]
    yield "half_mark", [BYTE_ORDER_MARK[:2] + text]
    yield "too_long", [text, b"{", (b"a", 256 * 1024), b"}\n", text]
    yield "not_json", [text, b"GET / HTTP/1.1\r\n"]
    yield "invalid", [b'{"op":\n{"op":"none"}\n{"op":"ping","id":"\xff"}\n']
    yield "tls", [b"\x16\x03\x01\x02\x00"]


def frame(opcode, payload=b"", final=True, size=None):
    """A client's frame; its mask of zeros keeps the payload readable."""
    size = len(payload) if size is None else size
    short = size if size < 126 else 126 if size < 65536 else 127
    length = b"" if short < 126 else struct.pack(">H" if short == 126 else ">Q", size)
    return bytes([opcode | (0x80 if final else 0), short | 0x80]) + length + bytes(4) + payload


def conversations():
    """Frames after a handshake, by name."""
    texts = [json.dumps(request, separators=(",", ":")).encode() for request in REQUESTS]
    yield "requests", [b"".join(frame(TEXT, text) for text in texts)]
    yield "each", [frame(TEXT, text) for text in texts]
    yield "fragments", [frame(TEXT, texts[0][:5], False), frame(PING, b"abc"), frame(0, texts[0][5:])]
    yield "masked", [bytes([0x81, 0x82]) + b"abcd" + bytes([ord("{") ^ ord("a"), ord("}") ^ ord("b")])]
    yield "pings", [frame(PING, b"1") + frame(PING) + frame(PONG, b"3") + frame(TEXT, texts[0])]
    yield "close", [frame(TEXT, texts[0]) + frame(CLOSE, struct.pack(">H", 1001) + b"bye")]
    yield "close_empty", [frame(CLOSE), frame(TEXT, texts[0])]
    yield "close_bad", [frame(CLOSE, struct.pack(">H", 1005))]
    yield "binary", [frame(BINARY, b"\0\xff")]
    yield "utf8", [frame(TEXT, '{"op":"é"}'.encode()), frame(TEXT, b'{"op":"\xc3"}')]
    yield "utf8_close", [frame(TEXT, b"\xe9\xed", False), frame(CLOSE, struct.pack(">H", 3000))]
    yield "long", [frame(TEXT, b"{" + b" " * 200 + b"}")]
    yield "largest", [frame(TEXT, size=256 * 1024), (b" ", 256 * 1024), frame(PING)]
    yield "too_large", [frame(TEXT, size=256 * 1024 + 1), (b" ", 256 * 1024)]
    yield "too_large_sum", [frame(TEXT, b"ab", False), frame(0, size=256 * 1024 - 1)]
    yield "huge", [frame(TEXT, size=2**63)]
    yield "unmasked", [b"\x81\x02{}"]
    yield "reserved", [b"\xc1\x80" + bytes(4)]


def telnet_streams():
    """Bytes of serial lines, by name."""
    yield "commands", [b"E+5\rE?IJKAT", b"F-3\rA$A@A@AR1,2,3\r"]
    yield "options", [b"\xff\xfd\x01\xff\xfb\x18", b"\xff\xfd\x06I\xff\xfe\x03\xff\xfc\x05J"]
    yield "subnegotiation", [b"\xff\xfa\x18\0xterm\xff\xff", b"\xff\xf0I"]
    yield "long_subnegotiation", [b"\xff\xfa", b"a" * 520, b"I"]
    yield "escaped", [b"\xff\xfd\x01\xff", b"\xff\xffAE+\xff\xf45\r"]
    yield "interrupt", [b"\xff\xf4\xff\xfd\x06I"]
    yield "http", [b"GET ", b"/ HTTP/1.1\r\n"]
    yield "connect", [b"CONNECT a.example:443 HTTP/1.1\r\n"]
    yield "tls", [b"\x16\x03\x01"]
    yield "stun", [b"\0\x01\0\x08\x21\x12\xa4\x42"]
    yield "almost_http", [b"GET I", b"OPTIONSJ"]
    yield "camera", [b"A**A*1*A*1,2*"]
    yield "com_port", [b"\xff\xfb,\xff\xfd,", b"\xff\xfa,\1\0\0\x25\x80\xff\xf0", b"\xff\xfa,\5\0\xff\xf0E?"]
    yield "suspend", [b"\xff\xfb,\xff\xfa,\x08\xff\xf0FTE?", b"A**", b"\xff\xfa,\x0c\1\xff\xf0I",
                      b"\xff\xfa,\x09\xff\xf0"]


def streams():
    """(fuzzer, name, input) of every seed."""
    for name, parts in heads():
        yield "http", name, pieces(*parts)
        yield "monitor_connection", "http_" + name, pieces(*parts, get(b"/nothing"))
        yield "opening", "http_" + name, pieces(*parts)
    for name, parts in lines():
        yield "opening", name, pieces(*parts)
        yield "monitor_connection", name, pieces(*parts)
    for name, parts in conversations():
        yield "websocket", name, pieces(*parts)
        yield "monitor_connection", "websocket_" + name, pieces(get(b"/ws", HOST + UPGRADE), *parts)
    for number, (name, parts) in enumerate(telnet_streams()):
        yield "telnet", name, bytes([number % 4]) + pieces(*parts)
