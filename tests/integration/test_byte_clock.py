"""--clock bytes over real sockets: the same bytes give the same transcript, commands of one line are executed at a time, and nothing
but bytes moves time."""

import os
import socket
import tempfile
import threading
import time
import unittest

from support import DEADLINE_S, MonitorError, Server, counts, run_xr3

PROGRAM = ["E+50\r", "E?", "E?", "D-20\r", "I", "J", "E?", "A*3,4*", "F+10\r", "F?", "EX", "K", "A**", "E?"]
CHARACTER_US = 1146
INQUIRY_US = 20000


def ticks(monitor):
    return monitor.get("tick")["tick"]


def replies_to(inquiry):
    """The number of bytes of the reply, with the Rhino's camera of 192 x 192 pixels."""
    if inquiry == "A**":
        return 192 * 192 // 6
    return 1 if inquiry[-1] in "?IJK*" else 0


def play(xr3, pieces=None):
    """Runs PROGRAM on a line of its own, asking again only after each reply; returns the replies."""
    heard = b""
    with xr3.line() as line:
        for command in PROGRAM:
            for byte in [command] if pieces is None else list(command):
                line.send(byte)
                if pieces is not None:
                    pieces()
            heard += line.read(replies_to(command))
    return heard


def wait_until(condition):
    """Waits for news that no message announces."""
    end = time.monotonic() + DEADLINE_S
    while not condition():
        assert time.monotonic() < end, "it does not happen"
        time.sleep(0.01)


def closed(monitor):
    """Waits until no line is open; returns the transcript."""
    wait_until(lambda: not monitor.call("lines")["lines"])
    return monitor.call("transcript")


def next_event(monitor, kind):
    return monitor.read_until(lambda message: message.get("event") == kind)[-1]


class Transcripts(unittest.TestCase):
    def test_the_same_program_has_the_same_transcript(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            self.assertEqual("bytes", monitor.hello["clock"]["mode"])
            first, before = play(xr3), closed(monitor)
            self.assertEqual([], before["marks"])
            self.assertEqual((1, sum(map(len, PROGRAM)), len(first)),
                             (before["lines"], before["bytes_in"], before["bytes_out"]))
            monitor.call("reset")
            second, after = play(xr3, lambda: time.sleep(0.003)), closed(monitor)
            self.assertEqual(first, second)
            self.assertEqual(before["sha256"], after["sha256"], "however slowly it comes")
            self.assertEqual((before["tick"], []), (after["tick"], after["marks"]))
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            play(xr3)
            self.assertEqual(before["sha256"], closed(monitor)["sha256"], "in another server")
            with xr3.line() as line:
                line.ask("E?")
            self.assertNotEqual(before["sha256"], closed(monitor)["sha256"])

    def test_connections_without_bytes_do_not_count(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            for _ in range(3):
                xr3.line().close()
            with xr3.line() as browser:
                browser.send("GET / HTTP/1.1\r\n\r\n")
                self.assertEqual(b"", browser.read_to_end())
            nothing = closed(monitor)
            self.assertEqual((0, 0, 0, []), (nothing["tick"], nothing["lines"], nothing["bytes_in"], nothing["marks"]))
            play(xr3)
            self.assertEqual(1, closed(monitor)["lines"])

    def test_aborted_connections_and_calls_are_marked(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.ask("E?")
            line.abort()
            self.assertEqual(["not_bytes_alone"], closed(monitor)["marks"])
            for call in ("pause", {}), ("home", {}), ("input", {"input": 1, "value": True}):
                monitor.call("reset")
                self.assertEqual([], monitor.call("transcript")["marks"])
                monitor.call(call[0], **call[1])
                self.assertEqual(["not_bytes_alone"], monitor.call("transcript")["marks"], call)

    def test_other_clocks_have_none(self):
        for clock in "real", "manual":
            with Server(clock=clock) as xr3, xr3.monitor() as monitor:
                with self.assertRaisesRegex(MonitorError, "no_transcript"):
                    monitor.call("transcript")


class Turns(unittest.TestCase):
    def test_the_second_client_waits(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            first = xr3.line()
            first.ask("E?")
            second = xr3.line()
            second.send("E-5\rE?")
            waiting = next_event(monitor, "line_turn")
            self.assertEqual(("line_waits", 2, 1), (waiting["code"], waiting["line"], waiting["waits_for"]))
            first.send("E+100\r")
            first.ask("E?")
            lines = monitor.call("lines")["lines"]
            self.assertEqual([None, 1], [line.get("waits_for") for line in lines])
            self.assertEqual([2 + 6 + 2, 0], [line["bytes_in"] for line in lines])
            self.assertEqual(["9600-7e2"] * 2, [line["speed"] for line in lines])
            self.assertEqual(b"", second.unread())
            first.send("E+5\r")
            first.close()
            self.assertEqual(32 + 5 - 2, second.read(1)[0], "the robot was at rest, and made 2 counts in 22 ms")
            turn = next_event(monitor, "line_turn")
            self.assertEqual(("line_turn", 2, None), (turn["code"], turn["line"], turn["waits_for"]))
            second.close()
            self.assertEqual([], closed(monitor)["marks"])
            self.assertEqual("E100", counts(monitor.get()))

    def test_a_client_that_has_gone_still_has_its_turn(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            first = xr3.line()
            first.ask("E?")
            with xr3.line() as second:
                second.send("D+5\r")
            first.close()
            self.assertEqual(2, closed(monitor)["lines"])
            self.assertEqual("D5", counts(monitor.get()))

    def test_a_waiting_line_is_closed_if_its_connection_breaks(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            first = xr3.line()
            first.ask("E?")
            second = xr3.line()
            second.send("D+5\r")
            wait_until(lambda: len(monitor.call("lines")["lines"]) == 2)
            second.abort()
            wait_until(lambda: [1] == [line["line"] for line in monitor.call("lines")["lines"]])
            self.assertEqual(32, first.ask("E?"))
            first.close()
            self.assertEqual(["not_bytes_alone"], closed(monitor)["marks"])
            self.assertEqual("", counts(monitor.get()))

    def test_line_disconnect_ends_a_silent_line(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            first, second = xr3.line(), xr3.line()
            wait_until(lambda: len(monitor.call("lines")["lines"]) == 2)
            second.send("E?")
            monitor.call("line_disconnect", line=1)
            self.assertEqual(b" ", second.read(1))
            self.assertEqual(b"", first.read_to_end())
            self.assertEqual(["not_bytes_alone"], monitor.call("transcript")["marks"])

    def test_a_waiting_line_costs_nothing_and_does_not_delay_the_end(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            first, second = xr3.line(), xr3.line()
            first.ask("E?")
            second.send("E?" * 1000)
            wait_until(lambda: len(monitor.call("lines")["lines"]) == 2)
            before = xr3.status("voluntary_ctxt_switches")
            time.sleep(0.3)
            self.assertLess(xr3.status("voluntary_ctxt_switches") - before, 10)
            self.assertEqual(0, xr3.stop())
            self.assertEqual(b"", second.read_to_end())

    def test_waiting_lines_are_bounded(self):
        with Server("--max-lines", "3", clock="bytes") as xr3:
            first = xr3.line()
            first.ask("E?")
            waiting = [xr3.line() for _ in range(2)]
            self.assertEqual(b"", xr3.line().read_to_end())
            waiting[0].send("E?")
            first.close()
            self.assertEqual(b" ", waiting[0].read(1))

    def test_send_has_a_turn_too(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            with xr3.line() as line:
                line.ask("E?")
                with self.assertRaisesRegex(MonitorError, "line_waits"):
                    monitor.call("send", text="E?")
            wait_until(lambda: not monitor.call("lines")["lines"])
            self.assertEqual("%", monitor.call("send", text="E+7\rE?")["text"])
            line = xr3.line()
            line.send("E?")
            self.assertEqual('#', monitor.call("send", text="E?")["text"])
            with xr3.monitor() as other:
                with self.assertRaisesRegex(MonitorError, "line_waits"):
                    other.call("send", text="E?")
            monitor.close()
            self.assertEqual(b" ", line.read(1))

    def test_send_takes_its_bytes_however_slow_the_machine_is(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            sent = monitor.call("send", text="E?" * 2000)
            self.assertNotIn("taken", sent)
            self.assertEqual("20" * 2000, sent["hex"])

    def test_a_line_closed_during_a_send_is_told(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor, xr3.monitor() as other:
            def is_told():
                monitor.send({"op": "call", "id": "send", "fn": "send", "args": {"text": "E?" * 2000}})
                for line in other.call("lines")["lines"]:
                    other.call("line_disconnect", line=line["line"])
                answer = monitor.read_until(lambda message: message.get("id") == "send")[-1]
                return answer.get("error", {}).get("code") == "no_such_line"

            wait_until(is_told)  # the send may also end before its line is closed
            self.assertIn("text", monitor.call("send", text="E?"))

    def test_concurrent_lines(self):
        with Server("--concurrent-lines", clock="bytes") as xr3, xr3.monitor() as monitor:
            first, second = xr3.line(), xr3.line()
            for line in first, second, first:
                line.ask("E?")
            self.assertEqual(["arrival_order"], monitor.call("transcript")["marks"])


class Time(unittest.TestCase):

    def test_wall_time_moves_nothing(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+100\r")
            line.ask("E?")
            before = monitor.get()
            time.sleep(0.1)
            self.assertEqual(before, {**monitor.get(), "id": before["id"]})

    def test_a_delay_passes_at_once(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write('{"faults": [{"name": "late", "kind": "reply_delayed", "delay_ms": 60000, "from_tick": 0}]}')
            file.flush()
            with Server("--fault", file.name, clock="bytes:5") as xr3, xr3.monitor() as monitor:
                started = time.monotonic()
                with xr3.line() as line:
                    for _ in range(10):
                        line.ask("E?")
                self.assertLess(time.monotonic() - started, DEADLINE_S)
                self.assertEqual([], closed(monitor)["marks"])
                self.assertGreater(ticks(monitor), 600000)

    def test_a_pseudo_terminal(self):
        found = set()
        for _ in range(2):
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "rhino")
                with Server("--pty", path, clock="bytes") as xr3, xr3.monitor() as monitor:
                    port = os.open(path, os.O_RDWR | os.O_NOCTTY)
                    os.write(port, b"E+20\rE?")
                    self.assertEqual(1, len(os.read(port, 1)))
                    os.close(port)
                    found.add(closed(monitor)["sha256"])
                    self.assertEqual("E20", counts(monitor.get()))
        self.assertEqual(1, len(found))

    def test_silence_runs_the_robot_to_rest(self):
        with Server(clock="bytes:20,settle=20") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+50\r")
            wait_until(lambda: counts(monitor.get()) == "E50")
            self.assertEqual(["silence"], monitor.call("transcript")["marks"])
            self.assertEqual(32, line.ask("E?"))

    def test_bytes_act_before_a_step_however_slow_the_machine_is(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.ask("E?")
            line.send("E?" * 1999)
            before_step = 2000 * (3 * CHARACTER_US + INQUIRY_US) // 1000
            self.assertEqual(before_step + 1, monitor.call("step", ticks=1)["tick"])

    def test_a_program_that_sleeps_is_told(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            monitor.subscribe("event")
            line.send("E+1\r" * 20)
            event = next_event(monitor, "warning")
            self.assertEqual("byte_clock_hurry", event["code"])
            self.assertIn("--clock real", event["message"])
            line.send("E+1\r" * 20)
            line.ask("E?")
            self.assertEqual(1, xr3.log().count("byte_clock_hurry"))

    def test_a_time_that_is_too_short_for_the_motors_is_told(self):
        with Server(clock="bytes:1") as xr3:
            xr3.wait_log("slowest motor")
        with Server(clock="bytes") as xr3:
            self.assertNotIn("slowest motor", xr3.log())

    def test_watch_shows_the_mode(self):
        with Server(clock="bytes") as xr3:
            shown = run_xr3("watch", f"localhost:{xr3.monitor_port}", "--once").stdout
            self.assertIn("bytes", shown)


class Load(unittest.TestCase):
    def test_a_flood_stops_neither_calls_nor_the_end(self):
        with Server(clock="bytes") as xr3, xr3.monitor() as monitor:
            flood = socket.create_connection(("127.0.0.1", xr3.robot_port), DEADLINE_S)
            moves = ("".join(f"{joint}+100\r{joint}-100\r" for joint in "FEDCB") + "IJK") * 500
            sender = threading.Thread(target=lambda: self.send_until_closed(flood, moves.encode()))
            sender.start()
            reader = threading.Thread(target=lambda: self.read_until_closed(flood))
            reader.start()
            wait_until(lambda: ticks(monitor) > 1000)
            for _ in range(50):
                self.assertEqual(1, len(monitor.call("lines")["lines"]))
            self.assertEqual(0, xr3.stop(within_s=DEADLINE_S))
            sender.join()
            reader.join()
            flood.close()

    @staticmethod
    def send_until_closed(sock, data):
        try:
            while True:
                sock.sendall(data)
        except OSError:
            pass

    @staticmethod
    def read_until_closed(sock):
        try:
            while sock.recv(65536):
                pass
        except OSError:
            pass


if __name__ == "__main__":
    unittest.main()
