"""Subscribers that are slow or do not read, and lines that send garbage: the server closes none of them, it
reports lost messages with exact counts (`lag`), and it uses little memory and time for them."""
# labels: release serial full

import time
import unittest

from garbage import pour_garbage
from support import NO_QUARANTINE, Monitor, Server

RING = 4096  # events
MIB = 1024  # in KiB, the unit of /proc
SMALL_BUFFER = 4096


def check_gaps(test, messages, channel):
    """Checks that each message of the channel is present or reported by one `lag`; returns the number of missing
    messages. (If more is lost before the next message is sent, another `lag` continues the first.)"""
    missing = 0
    expected = None
    for message in messages:
        if message["op"] == "lag" and message["channel"] == channel:
            missing += message["missed"]
            test.assertEqual(message["missed"], message["to_seq"] - message["from_seq"] + 1)
            if expected is not None:
                test.assertEqual(expected, message["from_seq"])
            expected = message["to_seq"] + 1
        elif message["op"] == channel:
            if expected is not None:
                test.assertEqual(expected, message["seq"])
            expected = message["seq"] + 1
    return missing


class Overflow(unittest.TestCase):
    def stuck(self, xr3, channel):
        viewer = self.enterContext(Monitor(xr3.monitor_port, buffer_bytes=SMALL_BUFFER))
        viewer.subscribe(channel)
        return viewer

    def test_lost_events_are_reported(self):
        with Server("--log-level", "warn") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            monitor.step(0, after=line, fields=[])
            viewer = self.stuck(xr3, "event")
            first = monitor.recall("event")[-1]["seq"]
            for _ in range(40):
                line.send("E+1\rE-1\r" * 400)
                monitor.step(0, after=line, fields=[])
            newest = monitor.recall("event")[-1]["seq"]
            received = viewer.read_until(lambda message: message.get("seq") == newest)
            self.assertEqual(first + 1, received[0].get("seq") or received[0]["from_seq"])
            missing = check_gaps(self, received, "event")
            self.assertGreater(missing, 1000)
            self.assertEqual(newest - first, missing + [message["op"] for message in received].count("event"))
            line.send("E+1\r")
            monitor.step(0, after=line, fields=[])
            self.assertEqual(newest + 1, viewer.read()["seq"], "no further gap")

    def test_since_before_the_oldest_message_gives_a_lag(self):
        with Server("--log-level", "warn") as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E+1\rE-1\r" * 4000)
            monitor.step(0, after=line, fields=[])
            held = monitor.recall("event", since=0)
            held = [message for message in held if message["op"] == "event"]
            self.assertEqual(RING, len(held))
            monitor.subscribe("event", since=1)
            lag = monitor.read()
            self.assertEqual(("lag", 1, held[0]["seq"] - 1), (lag["op"], lag["from_seq"], lag["to_seq"]))
            self.assertEqual(held[0]["seq"], monitor.read()["seq"])


class Garbage(unittest.TestCase):
    POURED_S = 3.0

    def test_subscribers_survive_garbage(self):
        with Server("--log-level", "warn", clock="real") as xr3, xr3.monitor() as good:
            viewers = {channel: xr3.monitor() for channel in ("event", "line")}
            for channel, viewer in viewers.items():
                viewer.subscribe(channel)
            with pour_garbage(xr3.robot_port, self.POURED_S) as pouring:
                seen = {channel: [] for channel in viewers}
                while pouring.poll() is None:
                    self.assertEqual("pong", good.request("ping")["op"])
                    for channel, viewer in viewers.items():
                        viewer.send({"op": "ping", "id": "now"})
                        seen[channel] += viewer.read_until(lambda message: message["op"] == "pong")
            for channel, messages in seen.items():
                self.assertGreater(len(messages), 10)
                check_gaps(self, messages, channel)
                viewers[channel].close()
            codes = {message.get("code", "lag") for message in seen["event"]}
            self.assertTrue(codes & {"lag", "suppressed"}, codes)


class Stuck(unittest.TestCase):
    WANTED = 100_000
    STUCK_TURNS = 100

    def ask_for_images(self, viewer, good):
        """Sends requests without reading the answers, until all are sent or the server reads no more,
        although it has had many turns. Returns the number of bytes sent and the sorted times that `good`
        waited for answers meanwhile, in seconds."""
        request = b'{"op":"get","channel":"image"}\n'
        pending = memoryview(request * self.WANTED)
        viewer.socket.setblocking(False)
        turns = 0
        waits_s = []
        while pending and turns < self.STUCK_TURNS:
            try:
                pending = pending[viewer.socket.send(pending[:65536]):]
                turns = 0
            except BlockingIOError:
                turns += 1
                started = time.monotonic()
                good.request("ping")
                waits_s.append(time.monotonic() - started)
        return len(request) * self.WANTED - len(pending), sorted(waits_s)

    def test_a_client_that_never_reads_its_images(self):
        with Server("--log-level", "warn", environment=NO_QUARANTINE) as xr3, xr3.monitor() as good:
            for _ in range(300):
                good.look("image")
            warm = self.enterContext(Monitor(xr3.monitor_port, buffer_bytes=SMALL_BUFFER))
            self.ask_for_images(warm, good)
            before = xr3.status("VmRSS")
            stuck = self.enterContext(Monitor(xr3.monitor_port, buffer_bytes=SMALL_BUFFER))
            _, waits_s = self.ask_for_images(stuck, good)
            # (All the images are 3 GiB; the allocator's own pages are some hundred KiB.)
            self.assertLessEqual(xr3.status("VmRSS") - before, MIB)
            self.assertLess(waits_s[len(waits_s) // 2], 0.05)


if __name__ == "__main__":
    unittest.main()
