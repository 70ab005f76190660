"""A server that may open few files: full ports, health checks, and recovery."""
# labels: release serial full

import os
import resource
import socket
import unittest
import urllib.error
import urllib.request

from support import DEADLINE_S, LOCALHOST, XR3, MonitorError, Server, connect, run_xr3
from test_line_websocket import CLOSE, LineWebsocket

FEW = 64
ALMOST_NO_CPU = 0.05


def cpu_s(pid):
    """Seconds of processor time that a process has used."""
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def status(port, path):
    try:
        with urllib.request.urlopen(f"http://{LOCALHOST}:{port}{path}", timeout=DEADLINE_S) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code


def closed_by_peer(sock):
    """Whether the server closes the connection without a byte."""
    try:
        return sock.recv(1) == b""
    except ConnectionResetError:
        return True


def answers(sock):
    """Whether a robot answers; it closes further lines without a byte."""
    try:
        sock.sendall(b"E?")
        return sock.recv(1) == b" "
    except (ConnectionResetError, BrokenPipeError):
        return False


class FewDescriptors(unittest.TestCase):
    def setUp(self):
        command = ("prlimit", f"--nofile={FEW}:{FEW}", XR3, "serve")
        self.xr3 = self.enterContext(Server(command=command))
        self.socks = []
        self.addCleanup(self.close_all)

    def test_lines_over_websocket_leave_descriptors_for_health_checks(self):
        opened = 0
        for _ in range(FEW):
            line = LineWebsocket(self.xr3)
            self.socks.append(line)
            if line.status != 101:
                break
            line.send(b"E?")
            kind, _ = line.frame()
            if kind == CLOSE:
                break
            opened += 1
        self.assertGreater(opened, 1)
        self.assertLess(opened, FEW // 6, "each takes two of the monitor port, and one of the robot port")
        self.assertEqual(200, status(self.xr3.monitor_port, "/healthz"))
        self.assertNotIn("socketpair", self.xr3.log())

    def close_all(self):
        for sock in self.socks:
            sock.close()
        self.socks = []

    def fill(self, port, count=80):
        self.socks += [connect(port) for _ in range(count)]

    def test_the_limits_are_reported(self):
        self.xr3.wait_log(f"limit of {FEW} open files allows only \\d+ lines and \\d+ monitor connections")

    def test_full_ports_answer_health_checks(self):
        self.fill(self.xr3.robot_port)
        self.fill(self.xr3.monitor_port)
        self.assertEqual(200, status(self.xr3.monitor_port, "/healthz"))
        self.assertEqual(503, status(self.xr3.monitor_port, "/state"))
        full = run_xr3("healthcheck", "--monitor-port", self.xr3.monitor_port)
        self.assertEqual(4, full.returncode, full.stderr)
        self.assertIn("every line is in use", full.stderr)
        self.assertTrue(closed_by_peer(self.socks[79]), "the last line is refused")

    def test_a_full_server_does_not_spin(self):
        self.fill(self.xr3.robot_port)
        self.fill(self.xr3.monitor_port)
        self.assertEqual(200, status(self.xr3.monitor_port, "/healthz"))
        before = cpu_s(self.xr3.pid)
        with socket.socket() as silent:  # an idle second: nothing arrives on this socket
            silent.bind((LOCALHOST, 0))
            silent.listen()
            silent.settimeout(1)
            with self.assertRaises(TimeoutError):
                silent.accept()
        self.assertLess(cpu_s(self.xr3.pid) - before, ALMOST_NO_CPU)

    def test_recovers_when_clients_leave(self):
        self.fill(self.xr3.robot_port)
        self.fill(self.xr3.monitor_port)
        self.assertEqual(503, status(self.xr3.monitor_port, "/state"))
        self.close_all()
        while status(self.xr3.monitor_port, "/state") != 200:  # until it has noticed
            pass
        with connect(self.xr3.robot_port) as line:
            line.sendall(b"E?")
            self.assertEqual(b" ", line.recv(1))
        self.assertEqual(0, run_xr3("healthcheck", "--monitor-port", self.xr3.monitor_port).returncode)


class Branches(unittest.TestCase):
    def test_the_server_works_with_all_branches_that_it_can_have_and_all_their_lines(self):
        command = ("prlimit", "--nofile=256:256", XR3, "serve")
        socks, ports = [], []
        with Server("--cells", 6, command=command) as xr3:
            with xr3.monitor() as monitor:
                self.assertRaisesRegex(MonitorError, "open files", self.branch_all, monitor, ports)
                self.assertGreater(len(ports), 3)
            try:
                for port in [*ports, xr3.robot_port, xr3.monitor_port]:
                    socks += [connect(port) for _ in range(40)]
                self.assertEqual(200, status(xr3.monitor_port, "/healthz"))
                self.assertEqual(8, sum(answers(sock) for sock in socks[:40]), "lines of a branch")
            finally:
                for sock in socks:
                    sock.close()

    def branch_all(self, monitor, ports):
        """Adds the ports of four branches of each cell to `ports`."""
        for cell in monitor.hello["cells"]:
            monitor.request("call", cell=cell, fn="step", args={"ticks": 50})
            for _ in range(4):
                branch = monitor.request("call", cell=cell, fn="branch", args={"tick": 20})
                ports.append(branch["value"]["robot_port"])


class ManyDescriptors(unittest.TestCase):
    def test_a_full_monitor_port_answers_health_checks(self):
        """1,024 silent connections were enough to make /healthz answer 503."""
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, (soft, hard))
        with Server() as xr3:
            socks = [connect(xr3.monitor_port) for _ in range(1024)]
            try:
                for path in ("/healthz", "/readyz"):
                    self.assertEqual(200, status(xr3.monitor_port, path))
                self.assertEqual(503, status(xr3.monitor_port, "/state"))
                checked = run_xr3("healthcheck", "--monitor-port", xr3.monitor_port)
                self.assertEqual(0, checked.returncode, checked.stderr)
            finally:
                for sock in socks:
                    sock.close()


if __name__ == "__main__":
    unittest.main(verbosity=2)
