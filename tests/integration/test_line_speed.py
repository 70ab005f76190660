"""--line-speed over real sockets, pyserial and pseudo-terminals: bytes take their time, none is lost, and in the
manual clock each run is the same."""

import os
import tempfile
import threading
import unittest

from support import DEADLINE_S, Server, run_xr3
from test_rfc2217 import pyserial, serial

MILLISECONDS_OF_200 = 229  # 200 characters of 11 bits at 9600 baud: 229.17 ms


def ticks(monitor):
    return monitor.get("tick")["tick"]


def line_of(monitor):
    line, = monitor.call("lines")["lines"]
    return line


class ManualClock(unittest.TestCase):
    def inquiries(self, count):
        """Makes inquiries, each after the reply to the one before; returns the tick and the byte of each reply."""
        with Server("--line-speed", "9600-7e2") as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            transcript = []
            for _ in range(count):
                line.send("I")
                monitor.step(1, after=line)
                while not line_of(monitor)["bytes_out"] > len(transcript):
                    monitor.step(1)
                transcript.append((ticks(monitor), line.read(1)))
            return transcript

    def test_200_inquiries_take_their_time_and_the_same_on_every_run(self):
        first = self.inquiries(200)
        self.assertGreaterEqual(first[-1][0], 2 * MILLISECONDS_OF_200)  # each byte of 200, there and back
        self.assertEqual(first[:50], self.inquiries(50))

    def test_a_burst_acts_byte_by_byte(self):
        with Server("--line-speed", "9600-7e2") as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.send("I" * 200)
            monitor.step(MILLISECONDS_OF_200, after=line)
            self.assertEqual(199, line_of(monitor)["bytes_acted"])
            self.assertEqual((200, "9600-7e2"), (line_of(monitor)["bytes_in"], line_of(monitor)["speed"]))
            monitor.step(2)
            self.assertEqual(200, len(line.read(200)))


class RealClock(unittest.TestCase):
    def test_200_inquiries(self):
        with Server("--line-speed", "9600-7e2", clock="real") as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            begin = ticks(monitor)
            for _ in range(200):
                line.ask("I")
            self.assertGreaterEqual(ticks(monitor) - begin, 2 * MILLISECONDS_OF_200)

    def test_a_megabyte_is_slowed_and_none_is_lost(self):
        """At 100 times 115200 baud a megabyte takes 0.87 s, or longer, since the bytes of a millisecond are limited."""
        with Server("--line-speed", "115200-8n1:100", clock="real") as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            flood = b"E?" + b"I" * 1_000_000
            begin = ticks(monitor)
            writer = threading.Thread(target=line.send, args=(flood,), daemon=True)
            writer.start()
            line.read(len(flood) - 1)
            writer.join(DEADLINE_S)
            self.assertGreaterEqual(ticks(monitor) - begin, 868)
            self.assertEqual(len(flood), line_of(monitor)["bytes_acted"])

    def test_a_fast_writer_waits(self):
        """The bytes that are not yet due are bounded: the rest stays with the client."""
        with Server("--line-speed", "300-8n1", clock="real") as xr3, xr3.monitor() as monitor:
            line = xr3.line(buffer_bytes=4096)
            line.send("E?")  # else a flood of I would not be taken for a robot program
            line.ask("I")
            line.socket.setblocking(False)
            sent = 0
            with self.assertRaises(BlockingIOError):
                while sent < 64 << 20:
                    sent += line.socket.send(b"I" * 65536)
            state = line_of(monitor)
            self.assertLessEqual(state["bytes_in"] - state["bytes_acted"], 4096)

    def test_the_speed_of_a_client(self):
        if not serial:
            self.skipTest("pyserial is not installed (Debian package python3-serial)")
        with Server("--line-speed", "auto", clock="real") as xr3, xr3.monitor() as monitor:
            with pyserial(xr3, baudrate=1200, bytesize=7, parity="E", stopbits=2) as port:
                begin = ticks(monitor)
                port.write(b"I" * 30)
                self.assertEqual(30, len(port.read(30)))
                self.assertGreaterEqual(ticks(monitor) - begin, 31 * 11 * 1000 // 1200)
                self.assertEqual("1200-7e2", line_of(monitor)["speed"])

    def test_a_pseudo_terminal_has_the_speed_of_its_program(self):
        if not serial:
            self.skipTest("pyserial is not installed (Debian package python3-serial)")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "rhino")
            with Server("--line-speed", "auto", "--pty", path, clock="real") as xr3, xr3.monitor() as monitor:
                with serial.Serial(path, 1200, timeout=DEADLINE_S) as port:
                    begin = ticks(monitor)
                    port.write(b"I" * 30)
                    self.assertEqual(30, len(port.read(30)))
                    self.assertGreaterEqual(ticks(monitor) - begin, 31 * 11 * 1000 // 1200)


class Options(unittest.TestCase):
    def test_wrong_speeds(self):
        for text in "fast", "9600", "9600-9n1", "0-8n1", "9600-8n1-rtscts", "9600-8n1:", "9600-8n1:0", "auto:x":
            with self.subTest(text):
                result = run_xr3("serve", "--line-speed", text)
                self.assertEqual(2, result.returncode)
                self.assertRegex(result.stderr, "9600-7e2|0.001...100000")

    def test_a_device_has_its_own_speed(self):
        result = run_xr3("serve", "--line-speed", "auto", "--serial", "/dev/null")
        self.assertEqual((2, True), (result.returncode, "speed of its own" in result.stderr))


if __name__ == "__main__":
    unittest.main()
