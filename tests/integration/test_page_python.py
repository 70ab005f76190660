"""The Python package of the page, which stands in for sockets, pyserial, clocks and input of a program. Each test runs in
a child process of its own, in which the package has replaced Python's modules."""

import builtins
import datetime
import errno
import faulthandler
import functools
import io
import os
import pathlib
import re
import select
import selectors
import socket
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import types
import unittest
import warnings

from page_robots import START_S, ScriptedRobot, ServerRobot

DEADLINE_S = 20.0
XR3 = os.environ.get("XR3")
CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
CLIENTS = CHECKOUT / "clients" / "python"
EXPECTED = CHECKOUT / "tests" / "clients" / "expected"
PROGRESS = re.compile(r"^  .*\d+ counts to go\n", re.MULTILINE)  # these lines depend on timing

sys.path.insert(0, str(CHECKOUT / "clients" / "web" / "src" / "python"))
import xr3_page.run  # noqa: E402


def forked(work):
    """Runs work() in a child process, in a folder of its own. Raises AssertionError with the child's traceback."""
    reads, writes = os.pipe()
    with tempfile.TemporaryDirectory(prefix="xr3-") as folder:
        child = os.fork()
        if child == 0:
            os.close(reads)
            text = ""
            faulthandler.dump_traceback_later(DEADLINE_S, exit=True)
            try:
                os.chdir(folder)
                work()
            except BaseException:
                text = traceback.format_exc()
            os.write(writes, text.encode()[:60000])  # fits into a pipe
            os._exit(0)
        os.close(writes)
        with open(reads, encoding="utf-8") as pipe:
            text = pipe.read()
        _, status = os.waitpid(child, 0)
    if text or status:
        raise AssertionError(f"in the child process, which ended with {status}:\n{text}")


def in_page(test):
    """Runs a test in a child process with the package; the test is given a robot, which it may script."""
    @functools.wraps(test)
    def wrapper(self):
        def work():
            robot = ScriptedRobot()
            install(robot)
            test(self, robot)
        forked(work)
    return wrapper


def install(robot):
    warnings.simplefilter("error")
    xr3_page.folder.PATH = os.path.abspath("program")
    xr3_page.install(robot)


def run(files, name="main.py", argv=(), environ=None):
    """Runs a program; returns its exit code, and what it wrote to its standard output and error."""
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = written = io.StringIO(), io.StringIO()
    try:
        code = xr3_page.run.run({name: files} if isinstance(files, str) else files, name, argv, environ or {})
    finally:
        sys.stdout, sys.stderr = before
    return (code, *(file.getvalue() for file in written))


def connected(port=9600, timeout=None):
    return socket.create_connection(("localhost", port), timeout)


class Case(unittest.TestCase):
    def assertFails(self, code, function, *arguments, **named):
        """Calls a function, which must raise OSError with this code; returns its text."""
        with self.assertRaises(OSError) as caught:
            function(*arguments, **named)
        self.assertEqual(errno.errorcode[code], errno.errorcode.get(caught.exception.errno), caught.exception)
        return caught.exception.strerror


class Clock(Case):
    @in_page
    def test_sleep_and_clocks_are_simulated(self, robot):
        started = os.times().elapsed
        time.sleep(1000)
        self.assertLess(os.times().elapsed - started, 100)
        self.assertEqual([("sleep", 1_000_000.0)], robot.calls)
        self.assertEqual((1000.0, 1000.0), (time.monotonic(), time.perf_counter()))
        self.assertEqual((10**12, 10**12), (time.monotonic_ns(), time.perf_counter_ns()))
        self.assertEqual((START_S + 1000, int((START_S + 1000) * 10**9)), (time.time(), time.time_ns()))
        self.assertIsInstance(time.monotonic_ns(), int)

    @in_page
    def test_what_sleep_refuses(self, robot):
        with self.assertRaisesRegex(ValueError, "must be non-negative"):
            time.sleep(-0.1)
        with self.assertRaisesRegex(ValueError, "NaN"):
            time.sleep(float("nan"))
        with self.assertRaises(TypeError):
            time.sleep("1")
        self.assertEqual([], robot.calls)

    @in_page
    def test_the_calendar_is_wall_time(self, robot):
        year = datetime.datetime.now().year
        self.assertEqual(str(year), time.strftime("%Y"))
        self.assertGreater(year, 2023, "the year of START_S")


class Connecting(Case):
    @in_page
    def test_any_host_and_port_is_the_robot(self, robot):
        for host, port in ("localhost", 9600), ("192.168.7.7", "4000"), ("robot.example", 1):
            with socket.create_connection((host, port)) as line:
                self.assertEqual(int(port), line.getpeername()[1])
        self.assertEqual(["open"] * 3, [name for name, _ in robot.calls if name.startswith("open")])
        self.assertEqual([1, 2, 3], [line for name, line in robot.calls if name == "close"])

    @in_page
    def test_the_port_of_the_monitor(self, robot):
        connected(9601)
        os.environ["XR3_MONITOR_PORT"] = "7001"
        connected(7001)
        connected(9601)
        self.assertEqual(["open_monitor", "open_monitor", "open"],
                         [name for name, _ in robot.calls if name.startswith("open")])

    @in_page
    def test_errors_of_connect(self, robot):
        line = socket.socket()
        self.assertFails(errno.ENOTCONN, line.recv, 1)
        self.assertFails(errno.ENOTCONN, line.sendall, b"")
        self.assertFails(errno.ENOTCONN, line.getpeername)
        self.assertFails(errno.ENOTCONN, line.shutdown, socket.SHUT_WR)
        self.assertEqual(("0.0.0.0", 0), line.getsockname())
        for address, error in ((("localhost", "9600"), TypeError), ("localhost:9600", TypeError), ((1, 2), TypeError),
                               (("localhost", 65536), OverflowError)):
            with self.subTest(address), self.assertRaises(error):
                line.connect(address)
        line.connect(("localhost", 9600))
        self.assertFails(errno.EISCONN, line.connect, ("localhost", 9600))
        self.assertEqual(errno.EISCONN, line.connect_ex(("localhost", 9600)))
        self.assertEqual(0, socket.socket().connect_ex(("localhost", 9600)))

    @in_page
    def test_names(self, robot):
        self.assertEqual([(socket.AF_INET, socket.SOCK_STREAM, 6, "", ("127.0.0.1", 9600))],
                         socket.getaddrinfo("robot", "9600"))
        self.assertEqual(("::1", 0, 0, 0), socket.getaddrinfo("robot", None, socket.AF_INET6)[0][4])
        self.assertEqual("127.0.0.1", socket.gethostbyname("robot"))
        self.assertEqual(("robot", [], ["127.0.0.1"]), socket.gethostbyname_ex("robot"))
        self.assertEqual("localhost", socket.gethostbyaddr("127.0.0.1")[0])
        with self.assertRaises(socket.gaierror):
            socket.getaddrinfo("robot", "nine")

    def test_constants_that_python_may_lack(self):
        def work():
            del socket.TCP_NODELAY, socket.MSG_PEEK
            install(ScriptedRobot())
            self.assertEqual((1, 2), (socket.TCP_NODELAY, socket.MSG_PEEK))
        forked(work)

    @in_page
    def test_a_program_cannot_listen(self, robot):
        line = socket.socket()
        for call in (lambda: line.bind(("", 9600)), line.listen, line.accept, lambda: socket.create_server(("", 9600)),
                     lambda: socket.create_connection(("localhost", 9600), source_address=("", 1))):
            self.assertIn("a program in the page cannot listen: run it beside `xr3 serve`",
                          self.assertFails(errno.EOPNOTSUPP, call))

    @in_page
    def test_only_tcp(self, robot):
        line = socket.socket(socket.AF_INET6, socket.SOCK_STREAM | socket.SOCK_CLOEXEC)
        self.assertEqual((socket.AF_INET6, socket.SOCK_STREAM, 0), (line.family, line.type, line.proto))
        for call in (lambda: socket.socket(type=socket.SOCK_DGRAM), lambda: socket.socket(socket.AF_UNIX),
                     lambda: line.sendto(b"", ("", 1)), lambda: line.recvfrom(1), socket.socketpair):
            self.assertIn("TCP to the robot only", self.assertFails(errno.EOPNOTSUPP, call))
        for call in (lambda: socket.socket(fileno=1), line.dup, line.detach):
            self.assertIn("no file descriptor", self.assertFails(errno.EOPNOTSUPP, call))


class Bytes(Case):
    @in_page
    def test_send_and_receive(self, robot):
        robot.answers = {b"E?": b"!", b"I": b" 2"}
        line = connected()
        self.assertEqual(2, line.send(b"E?"))
        self.assertEqual(b"!", line.recv(100))
        line.sendall(bytearray(b"I"))
        buffer = bytearray(b"....")
        self.assertEqual(1, line.recv_into(buffer, 1))
        self.assertEqual(1, line.recv_into(memoryview(buffer)[1:]))
        self.assertEqual(b" 2..", buffer)
        self.assertEqual(b"E?I", robot.sent[1])

    @in_page
    def test_arguments(self, robot):
        line = connected()
        for call in (line.send, line.sendall):
            with self.assertRaises(TypeError):
                call("E?")
        with self.assertRaises(ValueError):
            line.recv(-1)
        with self.assertRaises(ValueError):
            line.recv_into(bytearray(2), 3)
        self.assertEqual(b"", line.recv(0))

    @in_page
    def test_peek_leaves_the_bytes(self, robot):
        robot.arrives(1, b"abc")
        line = connected()
        self.assertEqual((b"ab", b"abc"), (line.recv(2, socket.MSG_PEEK), line.recv(9)))

    @in_page
    def test_wait_for_all(self, robot):
        for at_ms, part in enumerate((b"ab", b"cd", b"ef", b"")):
            robot.arrives(1, part, at_ms)
        line = connected()
        self.assertEqual(b"abcde", line.recv(5, socket.MSG_WAITALL))
        self.assertEqual(b"f", line.recv(5, socket.MSG_WAITALL))

    @in_page
    def test_end_of_the_line(self, robot):
        robot.arrives(1, b"a")
        robot.arrives(1, b"")
        line = connected()
        self.assertEqual([b"a", b"", b""], [line.recv(9) for _ in range(3)])
        with self.assertRaises(ConnectionResetError) as caught:
            line.send(b"E?")
        self.assertEqual(errno.ECONNRESET, caught.exception.errno)

    @in_page
    def test_shutdown(self, robot):
        robot.arrives(1, b"a")
        line = connected()
        line.shutdown(socket.SHUT_WR)
        line.shutdown(socket.SHUT_WR)
        self.assertEqual([("open", 1), ("finish", 1)], robot.calls)
        with self.assertRaises(BrokenPipeError):
            line.send(b"E?")
        self.assertEqual(b"a", line.recv(9))
        line.shutdown(socket.SHUT_RD)
        self.assertEqual(b"", line.recv(9))
        self.assertFails(errno.EINVAL, line.shutdown, 7)
        other = connected()
        other.shutdown(socket.SHUT_RDWR)
        self.assertEqual(b"", other.recv(9))
        self.assertEqual(("finish", 2), robot.calls[-1])

    @in_page
    def test_an_error_of_the_robot(self, robot):
        with self.assertRaisesRegex(OSError, "^nothing more can arrive$"):
            connected().recv(1)


class Timeouts(Case):
    @in_page
    def test_receive(self, robot):
        robot.arrives(1, b"a", 300)
        line = connected(timeout=0.25)
        with self.assertRaisesRegex(TimeoutError, "^timed out$"):
            line.recv(1)
        self.assertEqual(0.25, time.monotonic())
        self.assertEqual(b"a", line.recv(1))
        self.assertEqual(0.3, time.monotonic())
        self.assertEqual(0.25, line.timeout)

    @in_page
    def test_none_waits(self, robot):
        robot.arrives(1, b"a", 3_600_000)
        line = connected(timeout=None)
        self.assertEqual(b"a", line.recv(1))
        self.assertIn(("receive", 1, 1, -1, False), robot.calls)

    @in_page
    def test_zero_does_not_wait(self, robot):
        robot.arrives(1, b"a", 5)
        line = connected(timeout=0)
        with self.assertRaises(BlockingIOError) as caught:
            line.recv(1)
        self.assertEqual(errno.EAGAIN, caught.exception.errno)
        line.setblocking(True)
        with self.assertRaises(BlockingIOError):
            line.recv(1, socket.MSG_DONTWAIT)
        self.assertEqual(0, time.monotonic())

    @in_page
    def test_send(self, robot):
        robot.room = 3
        line = connected(timeout=2)
        self.assertEqual(3, line.send(b"abcdef"))
        with self.assertRaises(TimeoutError):
            line.send(b"def")
        self.assertEqual(2, time.monotonic())
        line.settimeout(0)
        with self.assertRaises(BlockingIOError):
            line.sendall(b"def")
        line.setblocking(True)
        with self.assertRaises(BlockingIOError):
            line.send(b"def", socket.MSG_DONTWAIT)

    @in_page
    def test_sendall_has_one_timeout_for_all(self, robot):
        line = connected(timeout=2)
        taken = []

        def slow(number, data, timeout):
            taken.append(timeout)
            robot.now_ms += min(800, timeout)
            return 1 if timeout >= 800 else 0
        robot.send = slow
        with self.assertRaises(TimeoutError):
            line.sendall(b"abcdef")
        self.assertEqual([2000, 1200, 400], taken)

    @in_page
    def test_setting(self, robot):
        line = socket.socket()
        self.assertEqual((None, True), (line.gettimeout(), line.getblocking()))
        line.settimeout(3)
        self.assertEqual((3.0, True), (line.gettimeout(), line.getblocking()))
        line.setblocking(False)
        self.assertEqual((0.0, False), (line.gettimeout(), line.getblocking()))
        line.setblocking(True)
        self.assertIsNone(line.gettimeout())
        for value, error in ((-1, ValueError), (float("nan"), ValueError), ("1", TypeError)):
            with self.subTest(value), self.assertRaises(error):
                line.settimeout(value)
        socket.setdefaulttimeout(7)
        self.assertEqual((7.0, 7.0), (socket.socket().gettimeout(), socket.create_connection(("a", 1)).gettimeout()))


class Closing(Case):
    @in_page
    def test_close(self, robot):
        line = connected()
        self.assertGreaterEqual(line.fileno(), 1000)
        line.close()
        line.close()
        self.assertEqual([("open", 1), ("close", 1)], robot.calls)
        self.assertEqual(-1, line.fileno())
        for call in (lambda: line.recv(1), lambda: line.send(b"a"), lambda: line.connect(("localhost", 1)),
                     lambda: line.setsockopt(6, 1, 1), line.getsockname):
            self.assertFails(errno.EBADF, call)

    @in_page
    def test_context_and_garbage(self, robot):
        with connected() as line:
            self.assertIsInstance(line, socket.socket)
        connected()
        self.assertEqual([("open", 1), ("close", 1), ("open", 2), ("close", 2)], robot.calls)

    @in_page
    def test_options(self, robot):
        line = connected()
        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.assertEqual((0, b"\0\0"), (line.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR), line.getsockopt(1, 2, 2)))
        self.assertEqual("127.0.0.1", line.getsockname()[0])

    @in_page
    def test_the_last_file_closes_the_socket(self, robot):
        robot.arrives(1, b"one\ntwo\n")
        with connected() as line:
            first, second = line.makefile("rb"), line.makefile("w")
        self.assertEqual(b"one\n", first.readline(), "the socket is open as long as its files")
        first.close()
        first.close()
        self.assertEqual([], [call for call in robot.calls if call[0] == "close"])
        second.close()
        self.assertEqual(("close", 1), robot.calls[-1])
        self.assertFails(errno.EBADF, line.recv, 1)


class Files(Case):
    @in_page
    def test_text(self, robot):
        robot.arrives(1, "ä\r\nb\n".encode())
        robot.arrives(1, b"", 5)
        file = connected().makefile("rw", encoding="utf-8", newline="\n")
        file.write("E?\n")
        self.assertEqual(b"", robot.sent[1], "buffered")
        file.flush()
        self.assertEqual(b"E?\n", robot.sent[1])
        self.assertEqual(["ä\r\n", "b\n"], list(file))

    @in_page
    def test_binary(self, robot):
        robot.arrives(1, b"abcdef")
        robot.arrives(1, b"")
        line = connected()
        self.assertEqual(b"a", line.makefile("rb", buffering=0).read(1))
        self.assertEqual(b"bcdef", line.makefile("rb").read())
        with connected().makefile("wb", buffering=2) as file:
            self.assertTrue(file.writable())
            file.write(b"E?I")
            self.assertEqual(b"E?I", robot.sent[2])
        with self.assertRaises(ValueError):
            line.makefile("a")

    @in_page
    def test_a_timeout_ends_a_file(self, robot):
        file = connected(timeout=1).makefile("rb")
        with self.assertRaises(TimeoutError):
            file.readline()
        with self.assertRaisesRegex(OSError, "cannot read from timed out object"):
            file.readline()
        raw = connected(timeout=0).makefile("rb", buffering=0)
        self.assertIsNone(raw.read(1))


class Selecting(Case):
    @in_page
    def test_one_line(self, robot):
        robot.arrives(1, b"a", 700)
        line = connected()
        self.assertEqual(([], [], []), select.select([line], [], [line], 0.5))
        self.assertEqual(0.5, time.monotonic())
        self.assertEqual(([line], [], []), select.select([line], [], []))
        self.assertEqual(0.7, time.monotonic())
        self.assertEqual(b"a", line.recv(9))
        self.assertEqual(([], [], []), select.select([line], [], [], 0))
        with self.assertRaisesRegex(OSError, "nothing more can arrive"):
            select.select([line], [], [])

    @in_page
    def test_several_lines(self, robot):
        robot.arrives(1, b"a", 20)
        robot.arrives(2, b"", 10)
        first, second = connected(), connected(9601)
        self.assertEqual(([second], [], []), select.select([first, second], [], []), "the end counts")
        self.assertEqual(([], [second], []), select.select([first], [second], [], 5))
        time.sleep(0.02)
        self.assertEqual([first, second], select.select([first, second], [], [])[0])

    @in_page
    def test_whatever_has_a_fileno(self, robot):
        robot.arrives(1, b"a")
        line = connected()
        file = line.makefile("rb")
        holder = types.SimpleNamespace(fileno=line.fileno)
        everything = [line, file, holder, line.fileno()]
        self.assertEqual(everything, select.select(everything, [], [])[0])
        unconnected = socket.socket()
        self.assertEqual([unconnected], select.select([unconnected], [], [])[0])
        with self.assertRaises(TypeError):
            select.select(["line"], [], [])
        with self.assertRaises(ValueError):
            select.select([line], [], [], -1)
        number = unconnected.fileno()
        unconnected.close()
        self.assertIn("connections to the robot only", self.assertFails(errno.EBADF, select.select, [number], [], []))
        with self.assertRaises(ValueError):
            select.select([], [unconnected], [])
        self.assertIn("robot only", self.assertFails(errno.EBADF, select.select, [], [], [0]))

    @in_page
    def test_nothing_is_a_sleep(self, robot):
        self.assertEqual(([], [], []), select.select([], [], [], 2.5))
        self.assertEqual(2.5, time.monotonic())
        robot.sleep = lambda ms: (_ for _ in ()).throw(KeyboardInterrupt)
        with self.assertRaises(KeyboardInterrupt):
            select.select([], [], [])

    @in_page
    def test_deadlines_end_though_sums_are_inexact(self, robot):
        robot.now_ms = 1e9 + 0.1
        first, second = connected(), connected()
        for _ in range(20):
            select.select([first, second], [], [], 0.0123)
        self.assertAlmostEqual(1e6 + 0.0001 + 20 * 0.0123, time.monotonic(), 6)

    @in_page
    def test_selectors(self, robot):
        robot.arrives(2, b"a", 100)
        first, second = connected(), connected()
        for kind in selectors.DefaultSelector, selectors.SelectSelector:
            with kind() as selector:
                selector.register(first, selectors.EVENT_READ, "first")
                key = selector.register(second, selectors.EVENT_READ | selectors.EVENT_WRITE, "second")
                self.assertEqual([(key, selectors.EVENT_WRITE if time.monotonic() < 0.1 else 3)], selector.select())
                key = selector.modify(second, selectors.EVENT_READ)
                self.assertEqual([(key, selectors.EVENT_READ)], selector.select(1))
                selector.unregister(second)
                self.assertEqual([], selector.select(0.5))
        self.assertAlmostEqual(1.1, time.monotonic())

    @in_page
    def test_no_poll(self, robot):
        for kind in (select.poll, select.epoll, selectors.PollSelector, selectors.EpollSelector):
            self.assertIn("use select.select() or selectors.DefaultSelector()", self.assertFails(errno.EOPNOTSUPP, kind))


class SerialPort(Case):
    @in_page
    def test_ports(self, robot):
        import serial
        for name in "/dev/ttyUSB0", "COM3", "rfc2217://localhost:9600", "socket://robot:4000/x", "socket://robot:9601":
            with serial.serial_for_url(name, 9600, bytesize=7, parity="E", stopbits=2) as port:
                self.assertEqual((name, name, True, 7), (port.name, port.portstr, port.is_open, port.bytesize))
        self.assertEqual(["open"] * 4 + ["open_monitor"],
                         [name for name, _ in robot.calls if name.startswith("open")])
        for name, text in ("loop://", "is no port"), ("spy:///dev/ttyUSB0", "is no port"), ("socket://robot", "no port number"):
            with self.subTest(name), self.assertRaisesRegex(serial.SerialException, text):
                serial.serial_for_url(name)

    @in_page
    def test_open_and_close(self, robot):
        import serial
        port = serial.Serial()
        with self.assertRaisesRegex(serial.SerialException, "must be configured"):
            port.open()
        self.assertFalse(port.isOpen())
        port.port = "COM3"
        port.open()
        with self.assertRaisesRegex(serial.SerialException, "already open"):
            port.open()
        port.close()
        port.close()
        for call in (port.read, lambda: port.write(b""), lambda: port.in_waiting, lambda: port.out_waiting, port.flush,
                     port.fileno, port.reset_input_buffer, port.reset_output_buffer, port.send_break):
            with self.assertRaisesRegex(serial.PortNotOpenError, "not open"):
                call()
        with port:
            self.assertTrue(port.is_open, "opened again")
        self.assertFalse(serial.serial_for_url("COM3", do_not_open=True).is_open)
        robot.open = lambda: (_ for _ in ()).throw(OSError("another line is open"))
        with self.assertRaisesRegex(serial.SerialException, "could not open port COM3: another line is open"):
            port.open()
        self.assertFalse(port.is_open)

    @in_page
    def test_settings(self, robot):
        import serial
        port = serial.Serial("robot")
        for name, value in (("bytesize", 9), ("parity", "X"), ("parity", "NE"), ("stopbits", 3), ("baudrate", 0),
                            ("timeout", -1), ("write_timeout", -1), ("inter_byte_timeout", -1)):
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"Not a valid {name}: {value!r}"):
                setattr(port, name, value)
        port.timeout, port.parity = 3, serial.PARITY_ODD
        self.assertEqual((3, "O", 9600, serial.STOPBITS_ONE, serial.EIGHTBITS),
                         (port.timeout, port.parity, port.baudrate, port.stopbits, port.bytesize))
        self.assertEqual((True, True, True, False), (port.cts, port.dsr, port.cd, port.ri))

    @in_page
    def test_read(self, robot):
        import serial
        for at_ms, part in (0, b"ab"), (400, b"cd"), (5000, b"efgh"):
            robot.arrives(1, part, at_ms)
        port = serial.Serial("robot", timeout=1)
        self.assertEqual((2, 2, 0), (port.in_waiting, port.inWaiting(), port.out_waiting))
        self.assertEqual(b"abcd", port.read(5))
        self.assertEqual(1, time.monotonic(), "one timeout for all")
        port.timeout = 0
        self.assertEqual(b"", port.read(2))
        self.assertEqual(1, time.monotonic())
        port.timeout = None
        self.assertEqual(b"ef", port.read(2))
        self.assertEqual(b"gh", port.read_all())
        self.assertEqual(5, time.monotonic())

    @in_page
    def test_time_between_bytes(self, robot):
        import serial
        for at_ms, part in (500, b"a"), (550, b"b"), (700, b"c"):
            robot.arrives(1, part, at_ms)
        port = serial.Serial("robot", inter_byte_timeout=0.1)
        self.assertEqual(b"ab", port.read(9))
        port.timeout = 0.2
        self.assertEqual(b"c", port.read(9))
        self.assertAlmostEqual(0.8, time.monotonic())

    @in_page
    def test_lines(self, robot):
        import serial
        robot.arrives(1, b"one\ntwo;three\nfour\nfi")
        port = serial.Serial("robot", timeout=1)
        self.assertEqual(b"one\n", port.readline())
        self.assertEqual(b"two;", port.read_until(b";"))
        self.assertEqual(b"thr", port.read_until(size=3))
        self.assertEqual([b"ee\n", b"four\n"], [next(port), next(port)])
        self.assertEqual(b"fi", port.readline())
        robot.arrives(1, b"\0\1\n")
        wrapper = io.TextIOWrapper(io.BufferedReader(port, 1))
        self.assertEqual("\0\1\n", wrapper.readline())
        for call in port.reset_input_buffer, port.flushInput:
            robot.arrives(1, b"left over")
            call()
            self.assertEqual(0, port.in_waiting)

    @in_page
    def test_read_until_has_one_timeout_for_all(self, robot):
        import serial
        for number in range(20):
            robot.arrives(1, b"a", 400 * number)
        port = serial.Serial("robot", timeout=1)
        self.assertEqual(b"aaaa", port.read_until(b"b"))
        self.assertEqual(1.2, time.monotonic(), "the byte that came after the timeout is the last")

    @in_page
    def test_write(self, robot):
        import serial
        robot.room = 6
        port = serial.Serial("robot", write_timeout=2)
        self.assertEqual((2, 1, 2), (port.write(b"E?"), port.write([73]), port.write(memoryview(b"E?"))))
        self.assertEqual(b"E?IE?", robot.sent[1])
        port.flush()
        port.flushOutput()
        with self.assertRaisesRegex(TypeError, "encode to bytes: 'E.'"):
            port.write("E?")
        with self.assertRaisesRegex(serial.SerialTimeoutException, "Write timeout"):
            port.write(b"E?")
        self.assertEqual(2, time.monotonic())
        port.send_break(0.5)
        self.assertEqual(2.5, time.monotonic())
        self.assertTrue(issubclass(serial.SerialTimeoutException, serial.SerialException))
        self.assertTrue(issubclass(serial.SerialException, OSError))

    @in_page
    def test_closed_by_the_robot(self, robot):
        import serial
        robot.arrives(1, b"a")
        robot.arrives(1, b"")
        port = serial.Serial("robot")
        self.assertEqual(b"a", port.read_all())
        self.assertEqual(0, port.in_waiting)
        with self.assertRaisesRegex(serial.SerialException, "has closed the line"):
            port.read()
        with self.assertRaisesRegex(serial.SerialException, "write failed: .*reset"):
            port.write(b"E?")

    @in_page
    def test_select(self, robot):
        import serial
        robot.arrives(1, b"a")
        port = serial.Serial("robot")
        self.assertEqual([port], select.select([port], [], [])[0])

    @in_page
    def test_modules(self, robot):
        import serial.tools.list_ports
        from serial.serialutil import SerialException
        from serial.tools.list_ports import comports, grep
        self.assertIs(serial.SerialException, SerialException)
        port, = comports()
        self.assertEqual(("robot", "The robot of the page", "n/a"), tuple(port))
        self.assertEqual(("robot", "robot - The robot of the page"), (port.device, str(port)))
        self.assertEqual((1, 0), (len(list(grep("ROB"))), len(list(grep("usb")))))
        self.assertTrue(serial.Serial(serial.tools.list_ports.comports()[0].device).is_open)
        with self.assertRaises(ModuleNotFoundError):
            import serial.threaded

    @in_page
    def test_constants_are_those_of_pyserial(self, robot):
        import serial
        self.assertEqual(("NEOMS", (1, 1.5, 2), (5, 6, 7, 8)), (
            serial.PARITY_NONE + serial.PARITY_EVEN + serial.PARITY_ODD + serial.PARITY_MARK + serial.PARITY_SPACE,
            (serial.STOPBITS_ONE, serial.STOPBITS_ONE_POINT_FIVE, serial.STOPBITS_TWO),
            (serial.FIVEBITS, serial.SIXBITS, serial.SEVENBITS, serial.EIGHTBITS)))


class Asking(Case):
    @in_page
    def test_input(self, robot):
        robot.typed = ["seven", ""]
        self.assertEqual(("seven", ""), (input("how many? "), input()))
        with self.assertRaises(EOFError):
            input(3)
        self.assertEqual([("ask", "how many? "), ("ask", ""), ("ask", "3")], robot.calls)

    @in_page
    def test_standard_input(self, robot):
        robot.typed = ["first", "second", "third", "fourth"]
        self.assertTrue(sys.stdin.isatty() and sys.stdin.readable())
        self.assertEqual("first\n", sys.stdin.readline())
        self.assertEqual(("se", "cond\n"), (sys.stdin.readline(2), sys.stdin.readline()))
        self.assertEqual("thi", sys.stdin.read(3))
        self.assertEqual("rd\nfourth\n", sys.stdin.read())
        self.assertEqual([], list(sys.stdin))

    @in_page
    def test_the_output_is_shown_before(self, robot):
        shown = []
        sys.stdout = types.SimpleNamespace(flush=lambda: shown.append(len(robot.calls)))
        robot.typed = ["a", "b"]
        input()
        sys.stdin.readline()
        self.assertEqual([0, 1], shown)

    @in_page
    def test_a_program_may_replace_standard_input(self, robot):
        sys.stdin, sys.stdout = io.StringIO("mine\n"), io.StringIO()
        self.assertEqual("mine", input("? "))
        self.assertEqual([], robot.calls)


class Absent(Case):
    @in_page
    def test_threads(self, robot):
        import _thread
        import concurrent.futures
        for call in (threading.Thread(target=print).start, threading.Timer(1, print).start,
                     lambda: _thread.start_new_thread(print, ()),
                     lambda: concurrent.futures.ThreadPoolExecutor().submit(print)):
            with self.assertRaisesRegex(RuntimeError, "a program in the page has no threads"):
                call()

    @in_page
    def test_a_wait_for_other_threads_is_a_sleep(self, robot):
        event = threading.Event()
        self.assertFalse(event.wait(0.5))
        self.assertEqual(0.5, time.monotonic())
        with self.assertRaisesRegex(RuntimeError, "for ever.*no threads"):
            event.wait()
        event.set()
        self.assertTrue(event.wait())
        with self.assertRaisesRegex(RuntimeError, "un-acquired"):
            threading.Condition().wait(1)

    @in_page
    def test_processes(self, robot):
        for call in (lambda: subprocess.run(["true"]), lambda: subprocess.check_output("true", shell=True),
                     lambda: os.system("true"), lambda: os.popen("true")):
            self.assertIn("a program in the page cannot start others", self.assertFails(errno.EOPNOTSUPP, call))


class Installing(Case):
    @in_page
    def test_again_with_another_robot(self, robot):
        first = connected()
        before = [socket.socket, time.sleep, builtins.input, select.select]
        other = ScriptedRobot(typed=["typed"])
        install(other)
        self.assertEqual(before, [socket.socket, time.sleep, builtins.input, select.select])
        time.sleep(1)
        connected()
        self.assertEqual("typed", input())
        self.assertEqual([("open", 1)], robot.calls)
        self.assertEqual(4, len(other.calls))
        del first

    def test_javascript(self):
        """With Pyodide's module, values are converted, promises awaited, and errors translated."""
        def work():
            sys.modules["pyodide"] = types.SimpleNamespace(ffi=FakeFfi)
            for name in [name for name in sys.modules if name.startswith("xr3_page")]:
                del sys.modules[name]
            import xr3_page.run
            robot = ScriptedRobot(typed=["typed"])
            robot.arrives(1, b"abc")
            xr3_page.install(JavaScriptRobot(robot))
            line = connected(timeout=1)
            line.sendall(b"E?")
            self.assertEqual(b"E?", robot.sent[1])
            self.assertEqual(b"abc", line.recv(9))
            self.assertEqual(("typed", 0.0), (input(), time.monotonic()))
            with self.assertRaises(TimeoutError):
                line.recv(9)
            line.settimeout(None)
            with self.assertRaisesRegex(OSError, "^nothing more can arrive$"):
                line.recv(9)
            robot.sleep = lambda ms: (_ for _ in ()).throw(JsError("KeyboardInterrupt", "stopped"))
            with self.assertRaises(KeyboardInterrupt):
                time.sleep(1)
            files = JsValue({"main.py": "import os, sys\nsys.exit(os.environ['CODE'] == sys.argv[1] == '3')"})
            self.assertEqual(1, xr3_page.run.run(files, "main.py", JsValue(["3"]), JsValue({"CODE": "3"})))
        forked(work)


class JsValue:
    """A JavaScript object, such as a Uint8Array."""

    def __init__(self, value):
        self.value = value

    def to_py(self):
        return memoryview(self.value) if isinstance(self.value, bytes) else self.value


class Promise:
    def __init__(self, function):
        self.then = function


class JsError(Exception):
    def __init__(self, name, message):
        super().__init__(f"{name}: {message}")
        self.name, self.message = name, message


class FakeFfi:
    """The names of pyodide.ffi that the package uses."""

    JsException = JsError
    to_js = JsValue

    @staticmethod
    def run_sync(promise):
        return promise.then()


class JavaScriptRobot:
    """A robot with JavaScript's values, whose functions return promises."""

    monitor_port = 9601.0

    def __init__(self, robot):
        self._robot = robot

    def __getattr__(self, name):
        def call(*arguments):
            return Promise(lambda: self._call(name, arguments))
        return call

    def _call(self, name, arguments):
        try:
            value = getattr(self._robot, name)(*(each.value if isinstance(each, JsValue) else each for each in arguments))
        except OSError as error:
            raise JsError("Error", str(error)) from None
        return JsValue(value) if isinstance(value, bytes) else value


class Running(Case):
    @in_page
    def test_main(self, robot):
        program = ("import sys, os, __main__\n"
                   "print(__name__, sys.argv, os.path.basename(__file__), os.environ['XR3_POLL_MS'], __main__.os is os)\n"
                   "with open('notes.txt') as file: print(file.read(), end='')\n")
        here, path, main = os.getcwd(), list(sys.path), sys.modules["__main__"]
        self.assertEqual((0, "__main__ ['main.py', 'a', 'b'] main.py 0 True\nseven\n", ""),
                         run({"main.py": program, "notes.txt": b"seven\n"}, argv=["a", "b"], environ={"XR3_POLL_MS": "0"}))
        self.assertEqual((here, path), (os.getcwd(), sys.path))
        self.assertNotIn("XR3_POLL_MS", os.environ)
        self.assertIs(main, sys.modules["__main__"])

    @in_page
    def test_each_run_is_fresh(self, robot):
        main = "import sys, socket, time\nimport helper, parts.one\nprint(helper.seven + parts.one.eight, 'x' in globals())\n"
        spoil = "x = 1\nhelper.seven = 0\ntime.sleep = print\nsocket.setdefaulttimeout(3)\nsys.stdout = None\n"
        files = {"main.py": main + spoil, "helper.py": "seven = 7", "parts/one.py": "eight = 8"}
        self.assertEqual("15 False\n", run(files)[1])
        self.assertNotIn("helper", sys.modules)
        self.assertNotIn("parts", sys.modules)
        files["helper.py"] = "seven = 9"
        self.assertEqual("17 False\n", run(files)[1], "a change within a second counts")
        self.assertEqual((0, "None\n", ""), run("import time, socket\ntime.sleep(1)\nprint(socket.getdefaulttimeout())"))
        del files["helper.py"]
        self.assertIn("No module named 'helper'", run(files)[2])
        self.assertEqual("[]\n", run("import os\nprint([name for name in os.listdir() if name.startswith('helper')])")[1])

    @in_page
    def test_files_of_the_program_stay(self, robot):
        run("with open('log.txt', 'w') as file: file.write('kept')")
        self.assertEqual((0, "kept\n", ""), run("with open('log.txt') as file: print(file.read())"))

    @in_page
    def test_exit_codes(self, robot):
        for ending, code, error in (("", 0, ""), ("sys.exit()", 0, ""), ("sys.exit(3)", 3, ""),
                                    ("sys.exit('no robot')", 1, "no robot\n"), ("raise SystemExit", 0, ""),
                                    ("raise KeyboardInterrupt", 130, "stopped\n")):
            with self.subTest(ending):
                self.assertEqual((code, "", error), run("import sys\n" + ending))

    @in_page
    def test_stop_while_a_program_waits(self, robot):
        robot.sleep = lambda ms: (_ for _ in ()).throw(KeyboardInterrupt)
        program = ("import time\nwhile True:\n  try:\n    time.sleep(1)\n"
                   "  except Exception: pass\n  finally: print('tidy')\n")
        self.assertEqual((130, "tidy\n", "stopped\n"), run(program))

    @in_page
    def test_lines_left_open_are_closed(self, robot):
        run("import socket, builtins\nbuiltins.kept = socket.create_connection(('', 9600))\nbuiltins.file = kept.makefile()")
        self.assertEqual([("open", 1), ("close", 1)], robot.calls)
        run("import socket\nline = socket.create_connection(('', 9600))\nfile = line.makefile()\nline.close()\n1 / 0")
        self.assertEqual(("close", 2), robot.calls[-1])

    @in_page
    def test_traceback_has_the_programs_own_frames(self, robot):
        files = {"main.py": "import helper\n\nhelper.ask()\n",
                 "helper.py": "import socket\n\ndef ask():\n    socket.create_connection(('', 1), 1).recv(1)\n"}
        code, _, error = run(files)
        self.assertEqual((1, ['File "main.py", line 3, in <module>', 'File "helper.py", line 4, in ask']),
                         (code, re.findall(r"File .*", error)))
        self.assertRegex(error, r"\ATraceback \(most recent call last\):\n")
        self.assertRegex(error, r"    helper.ask\(\)\n")
        self.assertRegex(error, r"\nTimeoutError: timed out\n\Z")

    @in_page
    def test_traceback_of_a_chain(self, robot):
        _, _, error = run("import json\ntry:\n    json.loads('')\nexcept ValueError as error:\n    raise KeyError(7) from error\n")
        self.assertEqual(["File \"main.py\", line 3, in <module>", "File \"main.py\", line 5, in <module>"],
                         re.findall(r"File .*", error))
        self.assertIn("JSONDecodeError", error)
        self.assertIn("direct cause", error)
        self.assertRegex(error, r"KeyError: 7\n\Z")

    @in_page
    def test_traceback_without_own_frames(self, robot):
        try:
            int("x")
        except ValueError as error:
            self.assertEqual("ValueError: invalid literal for int() with base 10: 'x'\n", xr3_page.report.text_of(error))

    @unittest.skipIf(sys.version_info < (3, 11), "exception groups came with Python 3.11")
    @in_page
    def test_traceback_of_a_group(self, robot):
        _, _, error = run("import json\ntry:\n    json.loads('')\nexcept ValueError as error:\n"
                          "    raise ExceptionGroup('all', [error])\n")
        self.assertNotIn("decoder.py", error)
        self.assertIn("JSONDecodeError", error)

    @in_page
    def test_syntax_errors(self, robot):
        code, _, error = run("print(1\n")
        self.assertEqual(1, code)
        self.assertRegex(error, r"\A  File \"main.py\", line 1\n    print\(1\n +\^\nSyntaxError: ")
        _, _, error = run({"main.py": "import helper\n", "helper.py": "x = = 1\n"})
        self.assertEqual(["main.py", "helper.py"], re.findall(r'File "(.*?)"', error))
        self.assertRegex(error, "SyntaxError: invalid syntax\n")

    @in_page
    def test_a_program_that_reads_a_bad_file_name(self, robot):
        self.assertIn("FileNotFoundError", run("open('none.txt')")[2])


@unittest.skipUnless(XR3, "XR3 names no program")
class Examples(Case):
    """Every example of clients/python, unmodified, with a real server at the other end."""

    def test_examples(self):
        from support import Server
        for path in sorted(CLIENTS.glob("[1-9]*.py")):
            with self.subTest(path.name), Server(clock="bytes") as xr3:
                if path.stem == "6_find_and_pick":
                    with xr3.monitor() as monitor:
                        monitor.call("block_move", name="red", xyz_mm=[285, 25, 20], yaw_deg=35)
                forked(lambda path=path, xr3=xr3: self.check(path, ServerRobot(xr3.robot_port, xr3.monitor_port)))

    def check(self, path, robot):
        install(robot)
        sys.path.append(str(CLIENTS))
        code, output, error = run(path.read_text(encoding="utf-8"), path.name, environ={"XR3_POLL_MS": "0"})
        expected = (EXPECTED / f"{path.stem}.txt").read_text(encoding="utf-8")
        self.assertEqual((0, PROGRESS.sub("", expected), ""), (code, PROGRESS.sub("", output), error))


if __name__ == "__main__":
    unittest.main()
