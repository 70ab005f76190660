"""Serial lines: too many, half closed, reset, closed in the middle of a number, flooding, and two hundred at
the same time. No line disturbs another one."""

import unittest

from support import DEADLINE_S, NO_QUARANTINE, MonitorError, Server, connect, counts, motors

MIB = 1024  # in KiB, the unit of /proc


class Lines(unittest.TestCase):
    def test_lines_above_the_maximum_are_closed(self):
        with Server("--max-lines", 2) as xr3, xr3.line() as first, xr3.line() as second:
            self.assertEqual((32, 32), (first.ask("E?"), second.ask("E?")))
            for _ in range(3):
                with xr3.line() as refused:
                    self.assertEqual(b"", refused.read_to_end())
            self.assertIn("max-lines", xr3.wait_log("refused"))
            self.assertEqual((32, 32), (first.ask("E?"), second.ask("E?")))
            first.close()
            xr3.wait_log(r"line 1 .*closed by its client")
            self.assertEqual(1, xr3.log().count("refused"), "logged once, until a line ends")
            with xr3.line() as third, xr3.line() as refused:
                self.assertEqual(32, third.ask("E?"))
                self.assertEqual(b"", refused.read_to_end())
            xr3.wait_log("refused", 2)

    def test_lines_one_after_another_are_never_refused(self):
        with Server("--max-lines", 1) as xr3:
            for _ in range(500):
                with connect(xr3.robot_port) as sock:
                    sock.sendall(b"E?")
                    self.assertEqual(b" ", sock.recv(1))

    def test_a_half_closed_line_gets_its_replies(self):
        for data, replies in [(b"E+5\rE?", b"%"), (b"E?" * 5000, b" " * 5000), (b"E+5\r", b""), (b"", b""),
                              (b"E+5", b""), (b"D", b""), (b"GET", b""), (b"\xff\xfd\x06", b"\xff\xfb\x06")]:
            with self.subTest(data[:10]), Server() as xr3, xr3.line() as line:
                line.send(data)
                line.finish_sending()
                self.assertEqual(replies, line.read_to_end())

    def test_an_incomplete_number_at_the_close_is_ignored(self):
        with Server() as xr3, xr3.monitor() as monitor:
            for end in "finish_sending", "close", "abort":
                with self.subTest(end):
                    line = xr3.line()
                    line.send("E+5\rF+7")
                    monitor.step(0, after=line)
                    getattr(line, end)()
                    if end == "finish_sending":
                        line.read_to_end()
                        line.close()
                    xr3.wait_log(rf"line {line.number} .*(closed|lost)")
            self.assertEqual("E15", counts(monitor.settle()))

    def test_a_reset_does_not_disturb_other_lines(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as good:
            for _ in range(20):
                bad = xr3.line()
                bad.send("E?" * 1000 + "D+1\r")
                monitor.step(0, after=bad)
                bad.abort()
                self.assertEqual(32, good.ask("E?"))
            xr3.wait_log(r"line \d+ .*(closed|lost)", times=20)
            self.assertEqual("D20", counts(monitor.settle(after=good)))

    def test_two_hundred_lines_at_once(self):
        with Server("--max-lines", 200) as xr3, xr3.monitor() as monitor:
            lines = [xr3.line() for _ in range(200)]
            for line in lines:
                line.send("E+1\r" if line.number % 2 else "D-1\r")
            for line in lines:
                line.send("F?")
            self.assertEqual({b" "}, {line.read(1) for line in lines})
            state = monitor.get()
            self.assertEqual((100, -100), tuple(motors(state)[label]["error"] for label in "ED"))
            self.assertEqual("E100 D-100", counts(monitor.settle()))
            for line in lines:
                self.assertEqual(b"", line.unread())
                line.close()

    def test_each_line_has_its_own_parser(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as first, xr3.line() as second:
            for line, piece in [(first, "E+"), (second, "D-"), (first, "1"), (second, "2\r"), (first, "2\r")]:
                line.send(piece)
                monitor.step(0, after=line)
            self.assertEqual("E12 D-2", counts(monitor.settle()))

    def test_raw_bytes(self):
        """A line without telnet transmits every reply byte unchanged, and FF once."""
        with Server() as xr3, xr3.monitor(), xr3.line() as line:
            line.send("F-1\rFT")
            self.assertEqual(b"\xff", line.read(1))
            line.send("F-9\rFT?")
            self.assertEqual(b"\xf6*", line.read(2))
            self.assertEqual(32, line.ask("E?"))
            self.assertEqual(b"", line.unread())


class Flood(unittest.TestCase):
    """A client sends inquiries without end and never reads: the server stops reading from it."""

    INQUIRIES = b"I" * 65536  # every byte is an inquiry with a one-byte reply
    KERNEL_BYTES = 16 << 20  # more than the kernel buffers for both directions of a connection
    STUCK_TURNS = 100

    def flood(self, line, good):
        """Sends until the server reads no more, although it has had many turns; returns the bytes sent."""
        poured = turns = 0
        self.assertEqual(32, line.ask("E?"))  # thousands of letters alone would look like an HTTP method
        line.socket.setblocking(False)
        while turns < self.STUCK_TURNS:
            try:
                poured += line.socket.send(self.INQUIRIES)
                turns = 0
            except BlockingIOError:
                turns += 1
                self.assertEqual(32, good.ask("E?"))
            self.assertLess(poured, self.KERNEL_BYTES, "the server does not stop reading")
        line.socket.settimeout(DEADLINE_S)
        return poured

    def test_a_line_that_never_reads_its_replies_is_not_read(self):
        """Memory grows once by the size of a read buffer, and by one outbox for each such line."""
        with Server(environment=NO_QUARANTINE) as xr3, xr3.line() as good:
            for _ in range(4):  # the allocator keeps some memory of each size for itself
                self.flood(xr3.line(buffer_bytes=16384), good)
            before = xr3.status("VmRSS")
            for _ in range(3):
                self.assertGreater(self.flood(xr3.line(buffer_bytes=16384), good), 100_000)
            self.assertLess(xr3.status("VmRSS") - before, 2 * MIB)
            for line in xr3.lines[1:]:
                line.abort()
            self.assertEqual(32, good.ask("E?"))

    def test_all_replies_arrive_when_the_client_reads(self):
        with Server() as xr3, xr3.line() as good, xr3.line(buffer_bytes=16384) as line:
            poured = self.flood(line, good)
            line.finish_sending()
            self.assertEqual(b" " * poured, line.read_to_end())

    def test_pending_replies_are_sent_at_shutdown(self):
        """The outbox of a line is full, and the client begins to read when the server shuts down."""
        with Server() as xr3, xr3.monitor() as monitor, xr3.line(buffer_bytes=16384) as line:
            line.ask("I")  # thousands of letters alone would look like an HTTP method
            with self.assertRaises(MonitorError):  # the server stops reading the line
                while line.sent < self.KERNEL_BYTES:
                    line.send(self.INQUIRIES[:32768])
                    monitor.call("step", ticks=0, fields=["moving"],
                                 after={"line": 1, "bytes_in": line.sent, "within_ms": 100})
            replies = []
            self.assertEqual(0, xr3.stop(meanwhile=lambda: replies.append(line.read_to_end())))
            count = 1 + len(replies[0])
            self.assertGreaterEqual(count, line.sent - 32768)
            self.assertIn(f"{count} bytes in, {count} out", xr3.log())


if __name__ == "__main__":
    unittest.main()
