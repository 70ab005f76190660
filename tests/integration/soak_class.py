"""A class for ten minutes: 200 students with three connections each, a program that keeps its robot moving, a page's
subscription to state and events, and one that lists the history now and then. The memory of the server must stay flat:
what it has at the end may exceed what it had after a quarter of the time by a tenth. Usage: soak_class.py [MINUTES];
the environment has XR3, a release executable."""

import json
import resource
import selectors
import sys
import time

from support import Server, connect

STUDENTS = 200
MINUTES = 10.0
ASK_EVERY_S = 0.2
LIST_EVERY_S = 20
HISTORY = "30s"
MEMORY_MIB = 96  # rings and histories may have an eighth each, which is full after a quarter of the time
MOST_GROWTH = 1.1


class Student:
    """Three sockets to one cell; what the server sends is read and dropped."""

    def __init__(self, xr3, number, robot_port):
        self.cell = str(number)
        self.turns = 0
        self.robot, self.page, self.lister = connect(robot_port), connect(xr3.monitor_port), connect(xr3.monitor_port)
        for channel in ("state", "event"):
            self.ask(self.page, {"op": "sub", "cell": self.cell, "channel": channel})

    def ask(self, sock, request):
        sock.sendall(json.dumps(request).encode() + b"\n")

    def act(self):
        self.turns += 1
        way = "+" if self.turns % 20 < 10 else "-"
        self.robot.sendall(f"E{way}20\rC{way}9\rE?C?".encode() if self.turns % 10 == 0 else b"E?V?")

    def look(self):
        self.ask(self.lister, {"op": "call", "cell": self.cell, "fn": "history"})

    def sockets(self):
        return self.robot, self.page, self.lister


def drain(selector, until):
    """Reads whatever arrives until then. Returns the number of bytes."""
    count = 0
    while (left := until - time.monotonic()) > 0:
        for key, _ in selector.select(left):
            data = key.fileobj.recv(1 << 16)
            assert data, "the server has closed a connection"
            count += len(data)
    return count


def main():
    seconds = 60 * (float(sys.argv[1]) if len(sys.argv) > 1 else MINUTES)
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    options = ("--cells", STUDENTS, "--history", HISTORY, "--max-memory", MEMORY_MIB,
               "--max-per-address", 10_000, "--log-level", "error")
    with Server(*options, clock="real") as xr3, xr3.monitor() as monitor:
        ports = {each["name"]: each["robot_port"] for each in monitor.call("cells")["cells"]}
        students = [Student(xr3, number, ports[str(number)]) for number in range(1, STUDENTS + 1)]
        selector = selectors.DefaultSelector()
        for student in students:
            for sock in student.sockets():
                selector.register(sock, selectors.EVENT_READ)
        begin = time.monotonic()
        early_kib = received = rounds = 0
        while (now := time.monotonic()) < begin + seconds:
            for student in students:
                student.act()
                if rounds % round(LIST_EVERY_S / ASK_EVERY_S) == students.index(student) % 100:
                    student.look()
            rounds += 1
            received += drain(selector, now + ASK_EVERY_S)
            if not early_kib and time.monotonic() > begin + seconds / 4:
                early_kib = xr3.status("VmRSS")
        late_kib = xr3.status("VmRSS")
    print(f"{STUDENTS} students, {seconds:.0f} s, {received / 2**20:.0f} MiB received: {early_kib} KiB after a quarter "
          f"of the time, {late_kib} KiB at the end")
    return late_kib > early_kib * MOST_GROWTH


if __name__ == "__main__":
    sys.exit(main())
