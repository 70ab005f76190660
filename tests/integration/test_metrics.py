"""The values of /metrics about the server itself: refusals, failures to accept, clients that are no robot
programs, the delay of the event loop, memory and descriptors."""

import os
import pathlib
import resource
import signal
import socket
import unittest
import urllib.request

from support import LOCALHOST, Server, connect

PAUSED_S = 0.4
SEEN_S = 0.25  # the least delay that a pause of the process causes
HTTP = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"


def metrics(xr3):
    """The samples: values by name and labels."""
    with urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}/metrics") as answer:
        rows = answer.read().decode().splitlines()
    return {name: float(value) for name, value in (row.rsplit(" ", 1) for row in rows if not row.startswith("#"))}


def of_cell(name, **labels):
    return name + "{" + ",".join(f'{label}="{value}"' for label, value in {"cell": "main", **labels}.items()) + "}"


class Refusals(unittest.TestCase):
    def test_lines_beyond_the_limit(self):
        with Server("--max-lines", 1) as xr3:
            xr3.line().ask("E?")
            self.assertEqual(0, metrics(xr3)[of_cell("xr3_lines_refused_total")])
            for _ in range(3):
                self.assertEqual(b"", xr3.line().read_to_end())
            now = metrics(xr3)
            self.assertEqual(3, now[of_cell("xr3_lines_refused_total")])
            self.assertEqual(1, now[of_cell("xr3_lines_total")])

    def test_monitor_connections_beyond_the_limit(self):
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, (soft, hard))
        with Server() as xr3, connect(xr3.monitor_port) as kept, kept.makefile("rb") as file:
            kept.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")
            file.readline()  # this connection is one of the 1024
            others = [connect(xr3.monitor_port) for _ in range(1023 + 2)]
            for refused in others[-2:]:
                refused.sendall(b"{}\n")
                self.assertIn(b'"full"', refused.recv(65536))
            for other in others:
                other.close()
            text = self.metrics_on(kept, file)
            self.assertIn('\nxr3_viewers_refused_total{cell="main"} 2\n', text)

    def metrics_on(self, sock, file):
        """/metrics on a connection that is open already; the answer to /healthz is not read yet."""
        sock.sendall(b"GET /metrics HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        return file.read().decode()

    def test_clients_that_are_no_robot_programs(self):
        with Server() as xr3:
            for _ in range(2):
                line = xr3.line()
                line.send(HTTP)
                self.assertEqual(b"", line.read_to_end())
            line = xr3.line()
            line.ask("E?")
            line.finish_sending()
            self.assertEqual(b"", line.read_to_end())
            now = metrics(xr3)
            self.assertEqual(2, now[of_cell("xr3_lines_closed_total", reason="stranger")])
            self.assertEqual(1, now[of_cell("xr3_lines_closed_total", reason="client_closed")])


class Process(unittest.TestCase):
    def test_memory_descriptors_and_processor(self):
        with Server() as xr3:
            first = metrics(xr3)
            lines = [xr3.line() for _ in range(20)]
            for line in lines:
                line.ask("E?")
            now = metrics(xr3)
            # (The kernel closes a connection of HTTP a little later than its client.)
            self.assertAlmostEqual(20, now["process_open_fds"] - first["process_open_fds"], delta=1)
            self.assertAlmostEqual(len(os.listdir(f"/proc/{xr3.pid}/fd")), now["process_open_fds"], delta=1)
            self.assertEqual(resource.prlimit(xr3.pid, resource.RLIMIT_NOFILE)[0], now["process_max_fds"])
            resident = pathlib.Path(f"/proc/{xr3.pid}/statm").read_text(encoding="ascii").split()[1]
            self.assertAlmostEqual(int(resident) * os.sysconf("SC_PAGESIZE"), now["process_resident_memory_bytes"],
                                   delta=8 << 20)
            self.assertGreaterEqual(now["process_cpu_seconds_total"], first["process_cpu_seconds_total"])
            self.assertGreater(now["process_cpu_seconds_total"], 0)

    def test_delay_of_the_event_loop(self):
        with Server() as xr3, socket.create_server((LOCALHOST, 0)) as silent:
            silent.settimeout(PAUSED_S)
            xr3.line().ask("E?")  # there is work: a measurement begins
            os.kill(xr3.pid, signal.SIGSTOP)
            try:
                with self.assertRaises(TimeoutError):
                    silent.accept()
            finally:
                os.kill(xr3.pid, signal.SIGCONT)
            while metrics(xr3)[of_cell("xr3_event_loop_lag_seconds")] < SEEN_S:
                pass


if __name__ == "__main__":
    unittest.main()
