"""HTTP, TLS and STUN clients of the robot port: no bytes that they send, however split, change the state of the
robot, and another line is not disturbed."""

import shutil
import subprocess
import unittest

from support import DEADLINE_S, LOCALHOST, MonitorError, Server, machine

METHODS = ["GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "CONNECT"]
TLS_HELLO = bytes.fromhex("1603010200010001fc0303") + bytes(range(256)) * 2
STUN_BINDING = bytes.fromhex("0001001c2112a442") + b"LPNOLRMNPLNO" + b"\x00\x06\x00\x18////E+50/C+33/P1/R2/LN\rI"
STUN = [len(STUN_BINDING).to_bytes(2, "big") + STUN_BINDING, STUN_BINDING,  # ICE over TCP, and without a frame
        bytes.fromhex("000300082112a442") + b"LPNOLRMNPLNO" + bytes.fromhex("0019000411000000")]  # TURN
BODY = "F+100\r"
# The bytes of HTTP method names are commands that switch aux ports (L M N O) and output lines (P R): both
# initial states are tried.
EVERYTHING_HIGH = "LNP1P2P3P4P5P6P7P8E+30\r"
EVERYTHING_LOW = "MOR1R2R3R4R5R6R7R8E+30\r"


def request(method, target="/"):
    return (f"{method} {target} HTTP/1.1\r\nHost: {LOCALHOST}\r\nUser-Agent: L\rN\rP1\r\n"
            f"Content-Length: {len(BODY)}\r\n\r\n{BODY}").encode()


OTHERS = [request("GET", f"http://{LOCALHOST}/"), request("POST", "https://localhost/"), request("OPTIONS", "*"),
          request("CONNECT", "e+50.l:443"), b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", *STUN]
BEGINNINGS = [data[:24] for data in OTHERS]


class Robot:
    """A robot in the middle of a move, with all outputs high or low, and a line that sends inquiries."""

    def __init__(self, setup, clock="manual"):
        self.server = Server("--max-lines", 5000, "--log-level", "warn", clock=clock)
        self.setup = setup

    def __enter__(self):
        self.server.__enter__()
        self.monitor = self.server.monitor()
        self.good = self.server.line()
        self.good.send(self.setup)
        self.monitor.step(100, after=self.good)
        self.before = machine(self.monitor.get())
        return self

    def __exit__(self, *problem):
        self.good.close()
        self.monitor.close()
        self.server.__exit__(*problem)

    def client(self):
        return self.server.line()

    def arrived(self, line):
        """Waits until the server has read all bytes sent on the line, or has closed it."""
        try:
            self.monitor.step(0, after=line, fields=["moving"])
        except MonitorError as error:
            if error.code != "no_such_line":
                raise

    def assert_untouched(self, test, what=None):
        test.assertEqual(32 + 19, self.good.ask("E?"), what)
        test.assertEqual(self.before, machine(self.monitor.get()), what)


class OtherProtocols(unittest.TestCase):
    def each_way(self):
        for setup in EVERYTHING_HIGH, EVERYTHING_LOW:
            with Robot(setup) as robot:
                yield robot

    def test_complete_requests(self):
        for robot in self.each_way():
            for data in [*map(request, METHODS), TLS_HELLO, *OTHERS]:
                with robot.client() as line:
                    line.send(data)
                    self.assertEqual(b"", line.read_to_end())
                robot.assert_untouched(self, data)

    def test_requests_cut_after_each_byte(self):
        for robot in self.each_way():
            for data in [*map(request, METHODS), TLS_HELLO[:20], *BEGINNINGS]:
                for length in range(1, len(data)):
                    with robot.client() as line:
                        line.send(data[:length])
                        line.finish_sending()
                        self.assertEqual(b"", line.read_to_end())
                robot.assert_untouched(self, data)

    def test_requests_with_a_pause_after_each_byte(self):
        for robot in self.each_way():
            for data in [*map(request, METHODS), TLS_HELLO[:20], *BEGINNINGS]:
                for length in range(1, 12):
                    with robot.client() as line:
                        line.send(data[:length])
                        robot.arrived(line)
                        self.send_rest(line, data[length:])
                        self.assertEqual(b"", line.read_to_end())
                    robot.assert_untouched(self, data[:length])

    def send_rest(self, line, rest):
        try:
            line.send(rest)
        except (BrokenPipeError, ConnectionResetError):
            pass  # the server has closed the line already

    def test_requests_byte_by_byte(self):
        """Each byte arrives separately, up to the one that identifies the request as HTTP."""
        for robot in self.each_way():
            for method in METHODS:
                with robot.client() as line:
                    for letter in f"{method} ":
                        line.send(letter)
                        robot.arrived(line)
                    robot.assert_untouched(self, method)
                    self.send_rest(line, b"/ HTTP/1.1\r\n\r\n" + BODY.encode())
                    self.assertEqual(b"", line.read_to_end())
                robot.assert_untouched(self, method)

    def test_commands_that_begin_like_a_request_are_executed(self):
        """At the first byte that differs from a request, all held bytes are executed in order."""
        for data, replies in [(b"D?", b" "), (b"DE?", b" "), (b"DELE?", b" "), (b"PUT?", b""), (b"P1E?", b" "),
                              (b"POST E?", b" "), (b"GET E?", b"\0 "), (b"H?", b" "), (b"C?", b" "), (b"\x16E?", b" "),
                              (b"T?A?", b" "), (b"CONNE?", b" "), (b"O/E?", b" "),
                              (b"\0E?", b" "), (b"\0\0E?", b" "), (b"\0D?", b" "), (b"\0K", b" "), (b"\0L\0E?", b" "),
                              (b"\xff\xfb\x01E?", b"\xff\xfe\x01 "), (b"\xf0\xe9\x80E?", b" "),
                              (b"CONNECT 9600 E?", b"\0 "), (b"PR1E?", b" ")]:
            with self.subTest(data), Server() as xr3, xr3.line() as line:
                line.send(data)
                self.assertEqual(replies, line.read(len(replies)))
                self.assertEqual(32, line.ask("\rE?"))
                self.assertEqual(b"", line.unread())

    def test_the_log_names_the_port_for_browsers(self):
        with Server() as xr3, xr3.line() as line:
            line.send(request("GET"))
            self.assertEqual(b"", line.read_to_end())
            xr3.wait_log(rf"were executed; .*a browser belongs on the monitor port: http://localhost:{xr3.monitor_port}/")

    def test_no_bytes_are_held_later_on_a_line(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            self.assertEqual(32, line.ask("E?"))
            line.send("\rPOST / HTTP/1.1\r\n\r\nF+9\r")
            self.assertEqual(b"\0\0", line.read(2), "two T inquiries for H, which has no motor")
            self.assertEqual(9, monitor.settle(after=line)["joints"][0]["count"])
            self.assertEqual(32, line.ask("E?"))


@unittest.skipUnless(shutil.which("curl"), "curl is not installed (Debian package curl)")
class Curl(unittest.TestCase):
    def test_every_method(self):
        for setup in EVERYTHING_HIGH, EVERYTHING_LOW:
            with Robot(setup) as robot:
                url = f"http://{LOCALHOST}:{robot.server.robot_port}/"
                for options in [["-X", "POST", "-d", BODY], ["-X", "POST", "--data-binary", BODY], ["-G"],
                                ["--head"], *(["-X", method] for method in METHODS[3:]),
                                ["--http0.9"], ["--http1.0"],
                                ["-T", "/dev/null"], ["-F", f"x={BODY}"]]:
                    done = subprocess.run(["curl", "-sS", "-m", str(DEADLINE_S), *options, url],
                                          capture_output=True, check=False)
                    self.assertEqual((b"", False), (done.stdout, done.returncode == 0), options)
                    robot.assert_untouched(self, options)

    def test_tls(self):
        with Robot(EVERYTHING_HIGH) as robot:
            url = f"https://{LOCALHOST}:{robot.server.robot_port}/"
            done = subprocess.run(["curl", "-ksS", "-m", str(DEADLINE_S), url], capture_output=True, check=False)
            self.assertNotEqual(0, done.returncode)
            robot.assert_untouched(self)


if __name__ == "__main__":
    unittest.main()
