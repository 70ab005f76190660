"""An hour of a busy robot as an MCAP file: its size, the memory of the conversion, and what Foxglove's reader finds."""
# labels: full

import threading
import unittest

from mcap_file import Converted
from support import Server

SECONDS = 3600
INQUIRY_MS = 20
MOST_BYTES = 50_000_000
MOST_KIB = 64 * 1024
# A second: three joints move, and a program asks fifty times where they are.
THERE = b"F+99\rE+80\rD-60\r" + b"F?" * (1000 // INQUIRY_MS)
BACK = b"F-99\rE-80\rD+60\r" + b"F?" * (1000 // INQUIRY_MS)


class Hour(Converted):
    def record_an_hour(self):
        replies = SECONDS * (1000 // INQUIRY_MS)
        with Server("--record", self.recording, clock=f"bytes:{INQUIRY_MS}") as xr3, xr3.line() as line:
            sender = threading.Thread(target=line.send, args=((THERE + BACK) * (SECONDS // 2),))
            sender.start()
            line.read(replies)
            sender.join()

    def test_an_hour(self):
        self.record_an_hour()
        file = self.convert()
        print(f"{self.file.stat().st_size / 1e6:.1f} MB, of {self.recording.stat().st_size / 1e6:.1f} MB; {self.memory_kib} KiB")
        self.assertLess(self.file.stat().st_size, MOST_BYTES)
        self.assertLess(self.memory_kib, MOST_KIB)
        self.assertGreater(file.head["chunkCount"], 10)
        self.assertGreaterEqual(file.head["messageEndTime"], SECONDS * 10**9)
        times = [each["logTime"] for each in file.messages]
        self.assertEqual(times, sorted(times))
        self.assertEqual(len(times), file.head["messageCount"])
        self.assertGreater(len(file.by_topic["/tf"]), SECONDS * 8)
        self.assertEqual(SECONDS * 1000 // INQUIRY_MS, sum(data["message"].startswith("< ") for _, data in file.by_topic["/wire"]))


if __name__ == "__main__":
    unittest.main()
