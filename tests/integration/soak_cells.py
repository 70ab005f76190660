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
# The clients, in a process of their own. A reply has the time of its arrival in the kernel: a late client is not a late
# server.
CLIENTS = r"""
import gc, heapq, select, socket, struct, sys, time
SO_TIMESTAMPNS = 35
ports, seconds, hz, every = eval(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
socks, waits = {}, []
chosen = select.epoll()
for port in ports:
    sock = socket.create_connection(("127.0.0.1", port))
    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    sock.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
    chosen.register(sock, select.EPOLLIN)
    socks[sock.fileno()] = sock
sent = dict.fromkeys(socks, 0)
gc.disable()
start = time.monotonic() + 0.5
due = [(start + k / len(socks) / hz, 0, number) for k, number in enumerate(socks)]
heapq.heapify(due)
end = start + seconds
while (now := time.monotonic()) < end:
    while due[0][0] <= now:
        at, count, number = heapq.heappop(due)
        if not sent[number]:
            data = b"E?"
            if count % every == 0:
                data = (b"E+60\rD-60\rC+60\r" if count // every % 2 == 0 else b"E-60\rD+60\rC-60\r") + data
            sent[number] = time.time_ns()
            socks[number].send(data)
        heapq.heappush(due, (at + 1 / hz, count + 1, number))
    for number, _ in chosen.poll(max(0, due[0][0] - time.monotonic())):
        data, notes, _, _ = socks[number].recvmsg(256, 64)
        if not data:
            sys.exit("a line was closed")
        s, ns = struct.unpack("qq", notes[0][2])
        waits.append(s * 10**9 + ns - sent[number])
        sent[number] = 0
waits.sort()
print(*(waits[min(len(waits) - 1, int(len(waits) * rank))] / 1e6 for rank in (0.5, 0.99, 1.0)), len(waits))
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
        print(f"{cells} cells, {count:.0f} replies: half within {half:.2f} ms, 99 of 100 within {p99:.2f} ms, all "
              f"within {worst:.1f} ms; the server used {100 * load:.0f} % of a processor")
    return p99 > BOUND_MS


if __name__ == "__main__":
    sys.exit(main())
