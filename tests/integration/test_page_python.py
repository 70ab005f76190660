"""The stand-ins of the page for sockets, select and clocks, as a program sees them."""

import datetime
import errno
import os
import select
import selectors
import socket
import time
import types
import unittest

from page_python import Case, connected, forked, in_page, install
from page_robots import START_S, ScriptedRobot


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
                               (["localhost", 9600], TypeError), (("localhost", 9600.0), TypeError),
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
            self.assertIs(socket.socket, socket.SocketType)
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
            self.assertIn("use select.select() or selectors.DefaultSelector()",
                          self.assertFails(errno.EOPNOTSUPP, kind))


if __name__ == "__main__":
    unittest.main()
