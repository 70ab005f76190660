"""Latency of the monitor port: on an idle machine, messages arrive within 50 ms, in order. The median counts,
because the machine is not always idle."""
# labels: release serial full

import statistics
import time
import unittest

from support import Server

SOON_S = 0.050
TRIES = 40
# At these speeds E makes its first count 8 ticks after the move, F 9 ticks.
SPEEDS = "E125SF112S"


class Promptness(unittest.TestCase):
    def test_two_events_one_tick_apart(self):
        with Server(clock="real") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send(SPEEDS)
            monitor.subscribe("event")
            late_s = []
            for number in range(TRIES):
                started = time.monotonic()
                line.send("F+1\rE+1\r" if number % 2 else "F-1\rE-1\r")
                events = monitor.read_until(lambda event: (event["event"], event.get("joint")) == ("reached", "F"))
                reached = [event for event in events if event["event"] == "reached"]
                self.assertEqual(["E", "F"], [event["joint"] for event in reached])
                self.assertEqual(1, reached[1]["tick"] - reached[0]["tick"])
                late_s.append(time.monotonic() - started - 0.009)
            self.assertLess(statistics.median(late_s), SOON_S, sorted(late_s))

    def test_the_effect_of_a_byte(self):
        """A state follows with the next frame, at 60 frames a second."""
        with Server(clock="real") as xr3, xr3.monitor() as viewer, xr3.line() as line:
            viewer.subscribe("state", max_hz=60, fields=["io"])
            viewer.read()
            late_s = []
            for number in range(TRIES):
                started = time.monotonic()
                line.send("M" if number % 2 else "L")
                self.assertEqual(number % 2 == 0, viewer.read()["io"]["aux"][0])
                late_s.append(time.monotonic() - started)
            self.assertLess(statistics.median(late_s), SOON_S, sorted(late_s))


if __name__ == "__main__":
    unittest.main()
