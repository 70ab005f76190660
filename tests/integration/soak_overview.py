"""The cost of an overview of many cells for the server: prints the processor time of the same robots that move, without and
with a subscriber of the channel `overview`. Usage: soak_overview.py [CELLS [MOVING]]; MOVING (a tenth) robots move at
any time. The environment has XR3, a release executable. Exit code 1 if the overview takes more than 5 % of a core.
tests/web/overview/overview_cost.mjs measures the page."""

import resource
import statistics
import sys
import threading
import time

from soak_cells import cpu_s
from support import Server, connect

CELLS = 1000
ROUNDS = 6  # each without and with the overview
ROUND_S = 6.0
MOVE_S = 1.0  # a move of 100 counts takes about as long
MOST_PERCENT = 5.0


class Robots:
    """A connection to each cell; a group of them moves at a time, forth and back in turn."""

    def __init__(self, ports, moving):
        self.lines = [connect(port) for port in ports]
        self.moving = moving
        self.first = 0
        self.sign = "+"

    def move_for(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for line in self.lines[self.first:self.first + self.moving]:
                line.sendall(f"F{self.sign}100\r".encode())
            self.first += self.moving
            if self.first >= len(self.lines):
                self.first, self.sign = 0, "-" if self.sign == "+" else "+"
            time.sleep(MOVE_S)


class Overview:
    """A page's subscription, read and counted by a thread until the end."""

    def __init__(self, port):
        self.sock = connect(port)
        self.sock.sendall(b'{"op":"sub","channel":"overview"}\n')
        self.bytes = 0
        self.reader = threading.Thread(target=self._read)
        self.reader.start()

    def _read(self):
        while data := self.sock.recv(1 << 16):
            self.bytes += len(data)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.sock.shutdown(2)
        self.reader.join()
        self.sock.close()


def main():
    cells = int(sys.argv[1]) if len(sys.argv) > 1 else CELLS
    moving = int(sys.argv[2]) if len(sys.argv) > 2 else cells // 10
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    options = "--cells", cells, "--max-cells", cells, "--max-per-address", 10 * cells, "--log-level", "error"
    without, with_overview, received = [], [], 0
    with Server(*options, clock="real") as xr3:
        with xr3.monitor() as monitor:
            robots = Robots([each["robot_port"] for each in monitor.call("cells")["cells"]], moving)

        def percent():
            before = cpu_s(xr3.pid)
            robots.move_for(ROUND_S)
            return 100 * (cpu_s(xr3.pid) - before) / ROUND_S

        for _ in range(ROUNDS):
            without.append(percent())
            with Overview(xr3.monitor_port) as overview:
                with_overview.append(percent())
            received += overview.bytes
        for line in robots.lines:
            line.close()
    least, most = statistics.median(without), statistics.median(with_overview)
    print(f"{cells} cells, {moving} move: the server takes {least:.1f} % of a core without an overview and {most:.1f} % "
          f"with one, which receives {received / ROUNDS / ROUND_S / 1024:.0f} KiB a second")
    return most - least > MOST_PERCENT or received == 0


if __name__ == "__main__":
    sys.exit(main())
