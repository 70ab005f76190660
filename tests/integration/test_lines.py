"""What may happen to lines: too many, half closed, reset, cut in the middle of a number, flooding, and
two hundred at once. Whatever one does, another goes on."""

import os
import unittest

from support import DEADLINE_S, Server, counts, motors

MIB = 1024  # KiB, in which /proc counts


class Lines(unittest.TestCase):
    def test_one_line_too_many(self):
        with Server("--max-lines", 2) as xr3, xr3.line() as first, xr3.line() as second:
            self.assertEqual((32, 32), (first.ask("E?"), second.ask("E?")))
            for _ in range(3):
                with xr3.line() as refused:
                    self.assertEqual(b"", refused.read_to_end())
            self.assertIn("max-lines", xr3.wait_log("refused", times=3))
            self.assertEqual((32, 32), (first.ask("E?"), second.ask("E?")))
            first.close()
            xr3.wait_log(r"line 1 .*closed by its client")
            with xr3.line() as third:
                self.assertEqual(32, third.ask("E?"))

    def test_half_close_gets_its_replies(self):
        for data, replies in [(b"E+5\rE?", b"%"), (b"E?" * 5000, b" " * 5000), (b"E+5\r", b""), (b"", b""),
                              (b"E+5", b""), (b"D", b""), (b"GET", b""), (b"\xff\xfd\x06", b"\xff\xfb\x06")]:
            with self.subTest(data[:10]), Server() as xr3, xr3.line() as line:
                line.send(data)
                line.finish_sending()
                self.assertEqual(replies, line.read_to_end())

    def test_a_number_that_is_open_at_the_close_is_not_obeyed(self):
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

    def test_a_reset_line_harms_nobody(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as good:
            for _ in range(20):
                bad = xr3.line()
                bad.send("E?" * 1000 + "D+1\r")
                monitor.step(0, after=bad)
                bad.abort()
                self.assertEqual(32, good.ask("E?"))
            xr3.wait_log(r"line \d+ .*(closed|lost)", times=20)
            self.assertEqual("D20", counts(monitor.settle(after=good)))

    def test_two_hundred_at_once(self):
        with Server() as xr3, xr3.monitor() as monitor:
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
        """A line that is no telnet carries every reply byte as it is, FF once."""
        with Server() as xr3, xr3.monitor(), xr3.line() as line:
            line.send("F-1\rFT")
            self.assertEqual(b"\xff", line.read(1))
            line.send("F-9\rFT?")
            self.assertEqual(b"\xf6*", line.read(2))
            self.assertEqual(32, line.ask("E?"))
            self.assertEqual(b"", line.unread())


class Flood(unittest.TestCase):
    """A client that sends inquiries without end and never reads: the server stops reading it."""

    ENVIRONMENT = {"ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=4"}

    def pour(self, line, most=64 << 20):
        """Sends until the kernel takes no more; returns how many bytes it took."""
        block, poured = b"E?I" * 20000, 0
        line.socket.setblocking(False)
        try:
            while poured < most:
                poured += line.socket.send(block)
        except BlockingIOError:
            return poured
        self.fail(f"the server took {poured} bytes and never stopped")

    def test_inquiries_that_are_never_read(self):
        with Server(environment=self.ENVIRONMENT) as xr3, xr3.line() as good:
            good.ask("E?")
            before = xr3.status("VmRSS")
            floods = [xr3.line(receive_buffer=4096) for _ in range(4)]
            poured = 0
            for _ in range(20):
                poured += sum(map(self.pour, floods))
                self.assertEqual(32, good.ask("E?"))
            self.assertGreater(poured, 100_000)
            self.assertLess(xr3.status("VmRSS") - before, 16 * MIB)
            for line in floods:
                line.close()
            self.assertEqual(32, good.ask("E?"))

    def test_all_replies_come_when_it_reads_at_last(self):
        with Server() as xr3, xr3.line(receive_buffer=4096) as line:
            poured = self.pour(line)
            line.socket.settimeout(DEADLINE_S)
            line.finish_sending()
            sent = (b"E?I" * 20000 * (poured // 60000 + 1))[:poured]
            replies = line.read_to_end()
            self.assertEqual(sent.count(b"?") + sent.count(b"I"), len(replies))
            self.assertEqual({32}, set(replies))


if __name__ == "__main__":
    unittest.main()
