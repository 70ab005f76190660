"""Several robots in one server: cells on ports of their own, cells that come with a connection, their tokens, the
owner of a port, and the overview of all cells."""

import json
import os
import pathlib
import re
import socket
import stat
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

from support import DEADLINE_S, LOCALHOST, ROOT, Line, MonitorError, Server, connect, counts, run_xr3

sys.path.insert(0, os.path.join(ROOT, "clients", "python"))
from xr3 import Monitor as python_monitor  # noqa: E402

OTHER_ADDRESS = "127.0.0.2"
HTTP = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"
TLS = b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03"
TOKEN = "sixteen letters!"
LONG_S, SHORT_S = 3600, 0.05  # values of --linger


def cell_ports(monitor):
    return {cell["name"]: cell["robot_port"] for cell in monitor.call("cells")["cells"]}


def line_to(port, source=None, address=LOCALHOST):
    sock = socket.socket()
    sock.settimeout(DEADLINE_S)
    if source:
        sock.bind((source, 0))
    sock.connect((address, port))
    return Line(sock, 1)


def get(xr3, path):
    with urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}{path}") as answer:
        return answer.read().decode()


def samples(xr3):
    rows = get(xr3, "/metrics").splitlines()
    return {name: float(value) for name, value in (row.rsplit(" ", 1) for row in rows if not row.startswith("#"))}


class Request:
    """Requests to one cell over a monitor client."""

    def __init__(self, monitor, cell):
        self.monitor, self.cell = monitor, cell

    def call(self, fn, **arguments):
        return self.monitor.request("call", cell=self.cell, fn=fn, args=arguments)["value"]

    def state(self):
        return self.monitor.request("get", cell=self.cell, channel="state")

    def settle(self, line):
        after = {"line": line.number, "bytes_in": line.sent, "within_ms": int(DEADLINE_S * 1000)}
        self.call("step", ticks=0, after=after, fields=[])
        return self.call("run_until", idle=True, max_ticks=10**6)["state"]


class Ports(unittest.TestCase):
    def test_two_cells_do_not_see_each_other(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor:
            self.assertEqual(["1", "2"], monitor.hello["cells"])
            self.assertEqual("1", monitor.hello["cell"])
            ports = cell_ports(monitor)
            with line_to(ports["1"]) as one, line_to(ports["2"]) as two:
                one.send("E+5\r")
                two.send("E-7\r")
                self.assertEqual("E5", counts(Request(monitor, "1").settle(one)))
                self.assertEqual("", counts(Request(monitor, "2").state()), "its time stands still")
                self.assertEqual("E-7", counts(Request(monitor, "2").settle(two)))
                self.assertEqual("E5", counts(Request(monitor, "1").state()))
                self.assertEqual([1], [line["line"] for line in Request(monitor, "2").call("lines")["lines"]])

    def test_requests_without_a_cell_go_to_that_of_hello(self):
        with Server("--cells", 3) as xr3, xr3.monitor() as monitor:
            self.assertEqual("1", monitor.get()["cell"])
            self.assertEqual("3", Request(monitor, "3").state()["cell"])
            with self.assertRaises(MonitorError) as caught:
                Request(monitor, "33").state()
            self.assertEqual("unknown_cell", caught.exception.code)
            self.assertIn('perhaps "3" was meant', caught.exception.hint)

    def test_cells_have_consecutive_ports(self):
        first = free_ports(3)
        server = Server("--cells", 3)
        server.options[server.options.index("--robot-port") + 1] = str(first)
        with server as xr3, xr3.monitor() as monitor:
            self.assertEqual({"1": first, "2": first + 1, "3": first + 2}, cell_ports(monitor))
            self.assertEqual(first, xr3.robot_port)

    def test_cells_may_have_their_own_robot_and_port(self):
        port = free_ports(1)
        with Server("--cells", 2, "--cell", "2=adept-one,adept-one", "--cell",
                    f"arm_a=intelledex-660,intelledex-660,{port}") as xr3, xr3.monitor() as monitor:
            cells = {cell["name"]: cell for cell in monitor.call("cells")["cells"]}
            self.assertEqual(["1", "2", "arm_a"], list(cells))
            self.assertEqual(["Rhino XR-3", "Adept One", "Intelledex 660"],
                             [cell["robot"] for cell in cells.values()])
            self.assertEqual(port, cells["arm_a"]["robot_port"])

    def test_clashes_and_too_high_ports_are_refused(self):
        for options, message in [
                (["--cells", 2, "--robot-port", 65535], "65535 is the highest"),
                (["--cells", 2, "--robot-port", 9601], "would both have the port 9601"),
                (["--cell", "a=rhino-xr3,rhino-xr3,9800", "--cell", "b=rhino-xr3,rhino-xr3,9800"],
                 "would both have the port 9800"),
                (["--cell", "a=rhino-xr3,", "--cell", "a=rhino-xr3,"], "given twice"),
                (["--cell", "a/b=rhino-xr3,"], "a cell is NAME=ROBOT,WORKCELL"),
                (["--cells", 5, "--max-cells", 4], "--max-cells is 4"),
                (["--cells", 2, "--cell-per-connection"], "cannot be used with --cells"),
                (["--cells", 2, "--pty", "robot"], "--pty needs a server of one cell"),
                (["--cell-per-connection", "--bind-peer"], "cannot be used with --cell-per-connection")]:
            with self.subTest(options):
                done = run_xr3("serve", *options)
                self.assertEqual(2, done.returncode)
                self.assertIn(message, done.stderr)

    def test_the_port_file_lists_the_cells(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "ports.json")
            with Server("--cells", 2, "--port-file", path) as xr3, xr3.monitor() as monitor:
                ports = json.loads(path.read_text(encoding="ascii"))
                self.assertEqual(cell_ports(monitor), {cell["name"]: cell["robot"] for cell in ports["cells"]})
                self.assertEqual(xr3.robot_port, ports["robot"])

    def test_http_shows_the_cell_in_the_query(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor, line_to(cell_ports(monitor)["2"]) as line:
            line.send("E+5\r")
            Request(monitor, "2").settle(line)
            self.assertEqual("", counts(json.loads(get(xr3, "/state"))))
            self.assertEqual("E5", counts(json.loads(get(xr3, "/state?cell=2"))))
            with self.assertRaises(urllib.error.HTTPError) as caught:
                get(xr3, "/state?cell=3")
            self.assertEqual(404, caught.exception.code)
            caught.exception.close()
            self.assertEqual(get(xr3, "/"), get(xr3, "/cell/2"))

    def test_metrics_are_sums(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor:
            ports = cell_ports(monitor)
            with line_to(ports["1"]) as one, line_to(ports["2"]) as two:
                one.ask("E?")
                two.ask("E?")
                now = samples(xr3)
                self.assertEqual(2, now["xr3_lines_open"])
                self.assertEqual(4, now["xr3_bytes_in_total"])
                self.assertEqual(2, now["xr3_cells"])
                self.assertFalse([name for name in now if "cell=" in name], "few series, however many cells")

    def test_a_cell_has_its_part_of_the_lines(self):
        with Server("--cells", 2, "--max-lines", 4) as xr3, xr3.monitor() as monitor:
            ports = cell_ports(monitor)
            with line_to(ports["1"]) as one, line_to(ports["1"]) as two:
                self.assertEqual((32, 32), (one.ask("E?"), two.ask("E?")))
                with line_to(ports["1"]) as refused:
                    self.assertEqual(b"", refused.read_to_end())
                with line_to(ports["2"]) as other:
                    self.assertEqual(32, other.ask("E?"))

    def test_the_server_is_ready_while_a_cell_has_a_line_left(self):
        with Server("--cells", 2, "--max-lines", 2) as xr3, xr3.monitor() as monitor:
            ports = cell_ports(monitor)
            with line_to(ports["1"]) as one:
                one.ask("E?")
                self.assertEqual("ok\n", get(xr3, "/readyz"))
                with line_to(ports["2"]) as two:
                    two.ask("E?")
                    with self.assertRaises(urllib.error.HTTPError) as raised:
                        get(xr3, "/readyz")
                    with raised.exception as answer:
                        self.assertIn("every line is in use: 2 are open", answer.read().decode())


def free_ports(count):
    """The first of some consecutive ports that are free now, below those that the system gives to connections. Tests
    in other processes search from elsewhere."""
    for first in range(10000 + os.getpid() * 7 % 10000, 32000, 97):
        socks = []
        try:
            for port in range(first, first + count):
                socks.append(socket.socket())
                socks[-1].bind((LOCALHOST, port))
            return first
        except OSError:
            continue
        finally:
            for sock in socks:
                sock.close()
    raise AssertionError("no free ports")


class Connections(unittest.TestCase):
    """--cell-per-connection."""

    def test_a_cell_appears_with_the_first_byte(self):
        with Server("--cell-per-connection") as xr3, xr3.monitor() as monitor:
            self.assertIsNone(monitor.hello["cell"])
            self.assertEqual([], monitor.hello["cells"])
            with self.assertRaises(MonitorError) as caught:
                monitor.get()
            self.assertEqual("unknown_cell", caught.exception.code)
            with xr3.line() as silent, xr3.line() as one, xr3.line() as two:
                self.assertEqual(32, one.ask("E?"))
                self.assertEqual({"c1": None}, cell_ports(monitor))
                self.assertEqual(32, two.ask("E?"))
                one.send("E+5\r")
                one.number = two.number = 1
                self.assertEqual("E5", counts(Request(monitor, "c1").settle(one)))
                self.assertEqual("", counts(Request(monitor, "c2").state()))
                self.assertEqual(32, silent.ask("E?"))
                self.assertEqual(["c1", "c2", "c3"], list(cell_ports(monitor)))

    def test_other_protocols_and_silence_get_no_cell(self):
        with Server("--cell-per-connection") as xr3, xr3.monitor() as monitor:
            for data in HTTP, TLS, b"GET /", b"":
                with xr3.line() as line:
                    line.send(data)
                    line.finish_sending()
                    self.assertEqual(b"", line.read_to_end())
            with xr3.line() as slow:  # the beginning of a request: undecided
                slow.send("GE")
                with xr3.line() as other:
                    other.ask("E?")
                self.assertEqual(["c1"], list(cell_ports(monitor)))
                slow.send("T?E?")
                slow.read(1)
                self.assertEqual(["c1", "c2"], list(cell_ports(monitor)))
            self.assertEqual("ok\n", get(xr3, "/readyz"))
            self.assertEqual(3, samples(xr3)['xr3_lines_closed_total{reason="stranger"}'])
            xr3.wait_log(rf"gets no cell; a browser belongs on the monitor port: http://localhost:{xr3.monitor_port}/")

    def test_a_cell_lingers_and_goes(self):
        with Server("--cell-per-connection", "--linger", SHORT_S) as xr3, xr3.monitor() as monitor:
            with xr3.line() as line:
                line.ask("E?")
                monitor.request("sub", cell="c1", channel="event")
                monitor.request("sub", cell="c1", channel="state")
                monitor._subscribed = True
            messages = monitor.read_until(lambda message: message.get("event") == "cell_closed")
            self.assertIn("line_close", [message.get("event") for message in messages])
            self.assertEqual({}, cell_ports(monitor))
            with self.assertRaises(MonitorError) as caught:
                Request(monitor, "c1").state()
            self.assertEqual("unknown_cell", caught.exception.code)
            with xr3.line() as line:
                line.ask("E?")
                self.assertEqual(["c2"], list(cell_ports(monitor)), "numbers are not used again")
            self.assertEqual(2, samples(xr3)["xr3_cells_opened_total"])
            self.assertEqual(2, samples(xr3)["xr3_lines_total"])

    def test_at_the_limit_the_longest_lingering_goes(self):
        with Server("--cell-per-connection", "--max-cells", 2, "--max-lines", 3, "--linger", LONG_S) as xr3, \
                xr3.monitor() as monitor:
            for _ in range(3):
                with xr3.line() as line:
                    line.ask("E?")
                    line.finish_sending()
                    line.read_to_end()
            with xr3.line() as line:
                line.ask("E?")
                self.assertEqual(["c3", "c4"], list(cell_ports(monitor)))
                with xr3.line() as other:
                    other.ask("E?")
                    with xr3.line() as refused:
                        refused.send("E?")
                        self.assertEqual(b"", refused.read_to_end())
                    self.assertEqual(1, samples(xr3)["xr3_lines_refused_total"])
            xr3.wait_log("as many cells have a line as --max-cells allows")

    def test_a_thousand_cells_leave_nothing_behind(self):
        with Server("--cell-per-connection", "--max-cells", 4, "--linger", LONG_S, "--log-level", "error") as xr3, \
                xr3.monitor() as monitor:
            monitor.request("sub", channel="overview")
            monitor._subscribed = True
            for _ in range(1000):
                with connect(xr3.robot_port) as sock:
                    sock.sendall(b"E?")
                    self.assertEqual(b" ", sock.recv(1))
            self.assertEqual(4, len(cell_ports(monitor)))
            now = samples(xr3)
            self.assertEqual(1000, now["xr3_cells_opened_total"])
            self.assertEqual(1000, now["xr3_lines_total"])
            self.assertLess(len(os.listdir(f"/proc/{xr3.pid}/fd")), 40)


class Overview(unittest.TestCase):
    def read(self, monitor, is_last):
        """Reads overview messages until the cells, as a client knows them, fulfil a condition."""
        cells = {}
        while not is_last(cells):
            message = monitor.read()
            self.assertEqual("overview", message["op"])
            if message["whole"]:
                cells.clear()
            for cell in message["cells"]:
                cells[cell["name"]] = cell
            for name in message["closed"]:
                cells.pop(name)
        return cells

    def test_shows_all_cells_and_then_changes(self):
        with Server("--cells", 3) as xr3, xr3.monitor() as monitor, xr3.monitor() as viewer:
            self.assertEqual({"channel": "overview", "max_hz": 4.0}, viewer.subscribe("overview", max_hz=60))
            first = viewer.read()
            self.assertTrue(first["whole"])
            self.assertEqual(["1", "2", "3"], sorted(cell["name"] for cell in first["cells"]))
            with line_to(cell_ports(monitor)["2"]) as line:
                line.send("E+5\r")
                Request(monitor, "2").settle(line)
                changes = []
                while not changes or changes[-1]["cells"][0]["last_input_tick"] is None \
                        or changes[-1]["cells"][0]["tick"] == 0:
                    changes.append(viewer.read())
                self.assertEqual({"2"}, {cell["name"] for message in changes for cell in message["cells"]})
                self.assertFalse(changes[-1]["whole"])
                self.assertEqual(1, changes[-1]["cells"][0]["lines"])

    def test_shows_cells_that_come_and_go(self):
        with Server("--cell-per-connection", "--linger", SHORT_S) as xr3, xr3.monitor() as viewer:
            viewer.subscribe("overview")
            with xr3.line() as line:
                line.ask("E?")
                cells = {}
                while "c1" not in cells:
                    cells.update({cell["name"]: cell for cell in viewer.read()["cells"]})
            closed = []
            while "c1" not in closed:
                closed += viewer.read()["closed"]

    def test_get_answers_with_all_cells(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor:
            message = monitor.look("overview")
            self.assertEqual((True, ["1", "2"]), (message["whole"], [cell["name"] for cell in message["cells"]]))


class Tokens(unittest.TestCase):
    """--private: each cell has a token of its own."""

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())
        self.path = pathlib.Path(self.folder, "ports.json")
        self.xr3 = self.enterContext(Server("--cells", 2, "--private", "--port-file", self.path,
                                            environment={"XR3_TOKEN": TOKEN}))
        listed = json.loads(self.path.read_text(encoding="ascii"))["cells"]
        self.tokens = {cell["name"]: cell["token"] for cell in listed}

    def test_only_the_owner_can_read_the_file(self):
        self.assertEqual(0o600, stat.S_IMODE(self.path.stat().st_mode))
        self.assertEqual(2, len(set(self.tokens.values())))

    def test_a_token_opens_one_cell(self):
        with self.xr3.monitor() as monitor:
            self.assertNotIn("cells", monitor.hello)
            value = monitor.request("auth", token=self.tokens["2"])["value"]
            self.assertEqual({"access": "control", "cell": "2"}, value)
            hello = monitor.read()
            self.assertEqual((["2"], "2"), (hello["cells"], hello["cell"]))
            self.assertEqual("2", monitor.get()["cell"])
            Request(monitor, "2").call("reset")
            for request in (lambda: Request(monitor, "1").state(), lambda: Request(monitor, "1").call("reset"),
                            lambda: monitor.request("sub", cell="1", channel="event")):
                with self.assertRaises(MonitorError) as caught:
                    request()
                self.assertEqual(("unknown_cell", 'there is "2"'), (caught.exception.code, caught.exception.hint))
            cells = monitor.call("cells")["cells"]
            self.assertEqual(["2"], [cell["name"] for cell in cells])
            self.assertNotIn("token", cells[0])
            self.assertEqual(["2"], [cell["name"] for cell in monitor.look("overview")["cells"]])

    def test_a_client_may_give_several_tokens(self):
        with self.xr3.monitor() as monitor:
            monitor.request("auth", token=self.tokens["2"])
            monitor.read()
            monitor.subscribe("overview")
            self.assertEqual(["2"], [cell["name"] for cell in monitor.read()["cells"]])
            monitor.request("auth", token=self.tokens["1"])
            messages = monitor.read_until(lambda message: message["op"] == "overview")
            self.assertEqual(["1", "2"], messages[0]["cells"])
            self.assertEqual(["1", "2"], sorted(cell["name"] for cell in messages[-1]["cells"]))

    def test_the_main_token_opens_all_and_reads_the_others(self):
        with self.xr3.monitor() as monitor:
            monitor.request("auth", token=TOKEN)
            self.assertEqual(["1", "2"], monitor.read()["cells"])
            self.assertEqual(self.tokens, {cell["name"]: cell["token"] for cell in monitor.call("cells")["cells"]})

    def test_tokens_are_not_logged(self):
        with self.xr3.monitor() as monitor:
            monitor.request("auth", token=self.tokens["1"])
            monitor.read()  # hello
            with self.assertRaises(MonitorError):
                monitor.request("auth", token="x" * 24)
        self.xr3.wait_log("wrong token")
        for token in self.tokens.values():
            self.assertNotIn(token, self.xr3.log())


class BindPeer(unittest.TestCase):
    def test_the_first_address_that_speaks_keeps_the_port(self):
        with Server("--cells", 2, "--bind-peer", "--linger", LONG_S) as xr3, xr3.monitor() as monitor:
            port = cell_ports(monitor)["1"]
            with line_to(port, OTHER_ADDRESS) as silent, line_to(port) as first:
                self.assertEqual(32, first.ask("E?"))
                self.assertEqual(b"", silent.read_to_end(), "it has not spoken")
                with line_to(port, OTHER_ADDRESS) as other:
                    other.send("E+50\r")
                    self.assertEqual(b"", other.read_to_end())
                with line_to(port) as again:
                    self.assertEqual(32, again.ask("E?"))
                with line_to(cell_ports(monitor)["2"], OTHER_ADDRESS) as free:
                    self.assertEqual(32, free.ask("E?"), "each port has its own owner")
            self.assertEqual("", counts(Request(monitor, "1").state()))
            self.assertEqual(2, samples(xr3)["xr3_other_peers_total"])
            self.assertRegex(xr3.wait_log("--bind-peer"), r"cell 1: 127\.0\.0\.2 is disconnected")

    def test_the_owner_is_shown_and_can_be_released(self):
        with Server("--bind-peer", "--linger", LONG_S) as xr3, xr3.monitor() as monitor:
            self.assertIsNone(monitor.call("cells")["cells"][0]["owner"])
            with line_to(xr3.robot_port, OTHER_ADDRESS) as first:
                first.ask("E?")
                self.assertEqual(OTHER_ADDRESS, monitor.call("cells")["cells"][0]["owner"])
                self.assertEqual(OTHER_ADDRESS, monitor.call("peer_release")["owner"])
                self.assertEqual(b"", first.read_to_end())
            with line_to(xr3.robot_port) as second:
                self.assertEqual(32, second.ask("E?"))
                self.assertEqual("127.0.0.1", monitor.request("get", channel="overview")["cells"][0]["owner"])
            monitor.call("peer_release")
            self.assertIsNone(monitor.call("peer_release")["owner"])

    def test_the_address_of_this_machine_in_the_network_is_this_machine(self):
        with Server("--bind-peer", "--listen", "0.0.0.0", "--insecure") as xr3, xr3.monitor() as monitor:
            with line_to(xr3.robot_port, OTHER_ADDRESS, OTHER_ADDRESS) as line:
                line.ask("E?")
                self.assertEqual("127.0.0.1", monitor.call("cells")["cells"][0]["owner"])
                with line_to(xr3.robot_port) as second:
                    self.assertEqual(32, second.ask("E?"))

    def test_a_port_without_lines_is_free_after_a_while(self):
        with Server("--bind-peer", "--linger", SHORT_S) as xr3:
            with line_to(xr3.robot_port) as first:
                first.ask("E?")
            until = time.monotonic() + DEADLINE_S
            while time.monotonic() < until:
                with line_to(xr3.robot_port, OTHER_ADDRESS) as other:
                    try:
                        if other.ask("E?") == 32:
                            return
                    except (EOFError, ConnectionError):
                        pass
            self.fail("the port is still bound")


class Clients(unittest.TestCase):
    def test_the_python_package_speaks_to_a_cell(self):
        with Server("--cells", 2) as xr3, python_monitor(port=xr3.monitor_port, cell="2") as monitor:
            monitor.call("send", text="E+5\r")
            monitor.settle()
            self.assertEqual(5, monitor.counts()["E"])
            self.assertEqual("2", monitor.state("moving")["cell"])
            with python_monitor(port=xr3.monitor_port) as other:
                self.assertEqual(0, other.counts()["E"])

    def test_watch_shows_a_cell(self):
        with Server("--cells", 2, "--cell", "2=adept-one,adept-one") as xr3:
            address = f"localhost:{xr3.monitor_port}"
            self.assertIn("Adept One", run_xr3("watch", address, "--once", "--cell", "2").stdout)
            self.assertIn("Rhino XR-3", run_xr3("watch", address, "--once").stdout)


class Log(unittest.TestCase):
    def test_names_the_cell_if_there_are_several(self):
        with Server("--cells", 2) as xr3, xr3.monitor() as monitor, line_to(cell_ports(monitor)["2"]) as line:
            line.ask("E?")
            xr3.wait_log(r"cell 2: cell @0: line 1 opened")
        self.assertFalse(re.search("cell 1: ", xr3.log()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
