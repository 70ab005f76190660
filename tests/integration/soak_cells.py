"""A server of many cells at rest: prints the memory of a cell, and what the server costs. Usage: soak_cells.py [CELLS];
the environment has XR3, a release executable. Exit code 1 if a cell takes more than 16 KiB, or the server works.
tests/bench/cells.cpp measures the replies of robots that move."""

import os
import resource
import sys
import time

from support import Server

CELLS = 1000
BOUND_KIB = 16.0
REST_S = 2
MOST_WAKE_UPS = 5  # for this client


def cpu_s(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main():
    cells = int(sys.argv[1]) if len(sys.argv) > 1 else CELLS
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    with Server("--log-level", "error", clock="real") as xr3:
        one_kib = xr3.status("VmRSS")
    with Server("--cells", cells, "--max-cells", cells, "--log-level", "error", clock="real") as xr3:
        each_kib = (xr3.status("VmRSS") - one_kib) / max(1, cells - 1)
        idle, started = cpu_s(xr3.pid), xr3.status("voluntary_ctxt_switches")
        time.sleep(REST_S)
        wake_ups = xr3.status("voluntary_ctxt_switches") - started
        print(f"memory of a cell at rest: {each_kib:.1f} KiB")
        print(f"at rest, in {REST_S} s: {cpu_s(xr3.pid) - idle:.2f} s of the processor, {wake_ups} wake-ups")
    return each_kib > BOUND_KIB or wake_ups > MOST_WAKE_UPS


if __name__ == "__main__":
    sys.exit(main())
