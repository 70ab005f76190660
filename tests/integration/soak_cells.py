"""Many cells with moving robots, and a client for each that asks twenty times a second: prints how long the replies
take, what the server costs, and the memory of a cell at rest. Usage: soak_cells.py [CELLS [SECONDS]]; the environment
has XR3, a release executable. Exit code 1 if 99 of 100 replies take longer than 10 ms."""

import os
import resource
import subprocess
import sys
import time

from support import ROOT, Server

CELLS, SECONDS = 1000, 20
ASKED_HZ = 20
BOUND_MS = 10.0
MOVE_EVERY = 20  # inquiries
CLIENTS = r"""
import heapq, selectors, socket, sys, time
ports, seconds, hz, every = eval(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
socks, sent, waits = [], {}, []
chosen = selectors.DefaultSelector()
for port in ports:
    sock = socket.create_connection(("127.0.0.1", port))
    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    chosen.register(sock, selectors.EVENT_READ)
    socks.append(sock)
start = time.monotonic() + 0.5
due = [(start + k / len(socks) / hz, 0, k) for k in range(len(socks))]
heapq.heapify(due)
end = start + seconds
while due:
    now = time.monotonic()
    if now >= end:
        break
    while due and due[0][0] <= now:
        at, number, k = heapq.heappop(due)
        sock = socks[k]
        if sock not in sent:
            data = b"E?"
            if number % every == 0:
                data = (b"E+60\rD-60\rC+60\r" if number // every % 2 == 0 else b"E-60\rD+60\rC-60\r") + data
            sent[sock] = time.monotonic()
            sock.sendall(data)
        heapq.heappush(due, (at + 1 / hz, number + 1, k))
        now = time.monotonic()
    for key, _ in chosen.select(max(0, due[0][0] - time.monotonic())):
        arrived = time.monotonic()
        if not key.fileobj.recv(4096):
            sys.exit("a line was closed")
        if key.fileobj in sent:
            waits.append(arrived - sent.pop(key.fileobj))
waits.sort()
print(*(round(1000 * waits[min(len(waits) - 1, int(len(waits) * rank))], 3) for rank in (0.5, 0.99, 1.0)), len(waits))
"""


def cpu_s(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_kib(options):
    with Server(*options, clock="real") as xr3:
        return xr3.status("VmRSS")


def main():
    cells = int(sys.argv[1]) if len(sys.argv) > 1 else CELLS
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else SECONDS
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    options = ["--cells", cells, "--max-cells", cells, "--log-level", "error"]
    each_kib = (resident_kib(options) - resident_kib(["--log-level", "error"])) / max(1, cells - 1)
    print(f"memory of a cell at rest: {each_kib:.1f} KiB")
    with Server(*options, clock="real") as xr3, xr3.monitor() as monitor:
        idle, started = cpu_s(xr3.pid), xr3.status("voluntary_ctxt_switches")
        time.sleep(2)
        print(f"at rest, in 2 s: {cpu_s(xr3.pid) - idle:.2f} s of the processor, "
              f"{xr3.status('voluntary_ctxt_switches') - started} wake-ups")
        ports = [cell["robot_port"] for cell in monitor.request("call", fn="cells", args={})["value"]["cells"]]
        before, began = cpu_s(xr3.pid), time.monotonic()
        done = subprocess.run([sys.executable, "-c", CLIENTS, repr(ports), str(seconds), str(ASKED_HZ),
                               str(MOVE_EVERY)], capture_output=True, text=True, check=False, cwd=ROOT)
        if done.returncode != 0:
            sys.exit(done.stderr)
        half, p99, worst, count = map(float, done.stdout.split())
        load = (cpu_s(xr3.pid) - before) / (time.monotonic() - began)
        print(f"{cells} cells, {count:.0f} replies: half within {half} ms, 99 of 100 within {p99} ms, all within "
              f"{worst} ms; the server used {100 * load:.0f} % of a processor")
    return p99 > BOUND_MS


if __name__ == "__main__":
    sys.exit(main())
