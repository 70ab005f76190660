"""`xr3 serve --pty PATH`: programs open a pseudo-terminal as they would a serial port."""

import contextlib
import os
import pathlib
import random
import re
import select
import signal
import stat
import subprocess
import sys
import tempfile
import termios
import unittest

from support import DEADLINE_S, ROOT, Server, run_xr3

try:
    import serial
except ImportError:
    serial = None

INQUIRY, REPLY = b"E+50\rE?", b"R"


class Port:
    """A serial port as a program opens it: no settings are made, reads have a deadline."""

    def __init__(self, path):
        self.file = os.open(path, os.O_RDWR | os.O_NOCTTY)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.file)

    def write(self, data):
        while data:
            data = data[os.write(self.file, data):]

    def is_readable(self, within_s=DEADLINE_S):
        return bool(select.select([self.file], [], [], within_s)[0])

    def read(self, count):
        data = b""
        while len(data) < count:
            if not self.is_readable():
                raise TimeoutError(f"only {data!r}")
            data += os.read(self.file, count - len(data))
        return data

    def modes(self):
        return termios.tcgetattr(self.file)


class Ptys(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = str(self.folder / "rhino")

    @contextlib.contextmanager
    def server(self, *options):
        with Server("--pty", self.path, *options) as xr3:
            yield xr3


def next_event(monitor, kind):
    """The next event of this kind. Precondition: the monitor subscribes to events."""
    return monitor.read_until(lambda message: message.get("event") == kind)[-1]


def fill_both_directions(path):
    """A program that asks as long as it can, reads no reply, and leaves."""
    with Port(path) as port:
        os.set_blocking(port.file, False)
        with contextlib.suppress(BlockingIOError):
            while select.select([], [port.file], [], 0.2)[1]:
                os.write(port.file, b"E?" * 1000)


class APort(Ptys):
    def test_a_program_that_sets_nothing(self):
        with self.server() as xr3, Port(self.path) as port:
            self.assertEqual([self.path], xr3.ptys)
            port.write(INQUIRY)
            self.assertEqual(REPLY, port.read(1))

    def test_a_port_is_raw_at_9600(self):
        with self.server(), Port(self.path) as port:
            iflag, oflag, cflag, lflag, ispeed, ospeed, _ = port.modes()
            self.assertEqual((termios.IGNBRK, 0, 0), (iflag, oflag, lflag))
            self.assertEqual(termios.CS8 | termios.CREAD | termios.CLOCAL, cflag & ~termios.CBAUD)
            self.assertEqual((termios.B9600, termios.B9600), (ispeed, ospeed))

    def test_all_byte_values_pass(self):
        """No telnet, no guard: FF, NUL, a request of HTTP and the characters of a terminal are bytes like others."""
        with self.server() as xr3, xr3.monitor() as monitor, Port(self.path) as port:
            everything = bytes(range(256)) + b"GET / HTTP/1.1\r\n\r\n" + b"\xff\xfd\x03"
            port.write(everything + b"B\rE?")
            port.read(1)
            line, = monitor.call("lines")["lines"]
            self.assertGreaterEqual(line["bytes_in"], len(everything))

    def test_lines_tells_path_and_speed(self):
        with self.server() as xr3, xr3.monitor() as monitor, Port(self.path) as port:
            for speed, text in (termios.B9600, "9600"), (termios.B1200, "1200"), (termios.B115200, "115200"):
                modes = port.modes()
                modes[4] = modes[5] = speed
                termios.tcsetattr(port.file, termios.TCSANOW, modes)
                port.write(b"E?")
                port.read(1)
                line, = monitor.call("lines")["lines"]
                self.assertEqual(("pty", self.path, text), (line["kind"], line["peer"], line["serial"]))

    def test_a_port_that_echoes_is_reported_once_a_line(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            with Port(self.path) as port:
                subprocess.run(["stty", "-F", self.path, "sane"], check=True)
                port.write(b"K\nK\n")
                self.assertEqual("pty_cooked", next_event(monitor, "warning")["code"])
            next_event(monitor, "line_close")
            with Port(self.path) as port:
                self.assertEqual(0, port.modes()[3], "raw again for the next program")
                port.write(INQUIRY)
                self.assertEqual(REPLY, port.read(1))

    @unittest.skipUnless(serial, "pyserial is not installed (Debian package python3-serial)")
    def test_pyserial(self):
        for settings in ({"bytesize": 7, "parity": "E", "stopbits": 2}, {}, {"baudrate": 115200}, {"exclusive": True},
                         {"bytesize": 7, "parity": "E"}, {"parity": "E"}, {"bytesize": 7}):
            with self.subTest(settings), self.server(), serial.Serial(self.path, timeout=DEADLINE_S, **settings) as port:
                port.write(INQUIRY)
                self.assertEqual(REPLY, port.read(1))

    def test_a_client_that_reads_nothing_is_not_read_either(self):
        with self.server() as xr3, Port(self.path) as port, xr3.line() as other:
            os.set_blocking(port.file, False)
            sent = 0
            with contextlib.suppress(BlockingIOError):
                while sent < 1 << 22:
                    sent += os.write(port.file, b"E?" * 2048)
            self.assertLess(sent, 1 << 20, "the program waits")
            self.assertEqual(b" " * 50, bytes(other.ask("F?") for _ in range(50)), "another line has its replies")
            os.set_blocking(port.file, True)
            self.assertEqual(sent // 2, len(port.read(sent // 2)), "no reply is lost")

    def test_a_megabyte_of_garbage(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            with Port(self.path) as port:
                os.set_blocking(port.file, False)
                garbage = random.Random(7).randbytes(1 << 20)
                while garbage:
                    readable, writable, _ = select.select([port.file], [port.file], [], DEADLINE_S)
                    self.assertTrue(readable or writable, "it hangs")
                    if readable:
                        os.read(port.file, 65536)
                    if writable:
                        garbage = garbage[os.write(port.file, garbage[:4096]):]
            next_event(monitor, "line_close")
            monitor.call("reset")
            with Port(self.path) as port:
                port.write(INQUIRY)
                self.assertEqual(REPLY, port.read(1))


    @unittest.skipUnless(serial, "pyserial is not installed (Debian package python3-serial)")
    def test_the_example_of_the_documentation(self):
        page = pathlib.Path(ROOT, "docs", "serial-lines.md").read_text(encoding="utf-8")
        example, = re.findall(r'^```python\n([^`]*serial\.Serial\("rhino"[^`]*)^```', page, re.MULTILINE)
        with self.server():
            done = subprocess.run([sys.executable, "-c", example], cwd=self.folder, capture_output=True, text=True,
                                  timeout=DEADLINE_S, check=False)
        self.assertEqual(("50 counts to go\n", "", 0), (done.stdout, done.stderr, done.returncode))


class OpenAndClose(Ptys):
    def test_sixty_programs_one_after_the_other_that_write_at_once(self):
        with self.server():
            for number in range(60):
                with Port(self.path) as port:
                    port.write(b"E?")
                    self.assertEqual(b" ", port.read(1), number)

    def test_bytes_of_a_program_that_leaves_at_once_act(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            with Port(self.path) as port:
                port.write(b"E+50\r")
            self.assertEqual(5, next_event(monitor, "line_close")["bytes_in"])
            self.assertEqual(REPLY[0], xr3.line().ask("E?"))

    def test_a_program_does_not_get_the_replies_of_the_one_before(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            with Port(self.path) as port:
                port.write(b"E?" * 3000)
                self.assertTrue(port.is_readable())
            next_event(monitor, "line_close")
            with Port(self.path) as port:
                self.assertFalse(port.is_readable(0))
                port.write(INQUIRY)
                self.assertEqual(REPLY, port.read(1))

    def test_half_a_command_ends_with_its_line(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            with Port(self.path) as port:
                port.write(b"E+5")
            next_event(monitor, "line_close")
            with Port(self.path) as port:
                port.write(b"0\rE?")
                self.assertEqual(b" ", port.read(1))

    def test_two_programs_share_a_line(self):
        with self.server() as xr3, xr3.monitor() as monitor, Port(self.path) as one:
            one.write(b"E+50\r")
            with Port(self.path) as other:
                other.write(b"E?")
                self.assertEqual(REPLY, other.read(1))
                self.assertEqual(1, len(monitor.call("lines")["lines"]))
            one.write(b"E?")
            self.assertEqual(REPLY, one.read(1))

    def test_a_line_that_the_server_ends_hangs_up(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            with Port(self.path) as port:
                port.write(INQUIRY)
                port.read(1)
                line, = monitor.call("lines")["lines"]
                monitor.call("line_disconnect", line=line["line"])
                self.assertTrue(port.is_readable())
                self.assertEqual(b"", os.read(port.file, 1))
            with Port(self.path) as port:
                port.write(b"E?")
                self.assertEqual(1, len(port.read(1)))

    def test_a_port_that_cannot_be_replaced_is_tried_again(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            with Port(self.path) as port:
                port.write(INQUIRY)
                port.read(1)
                away = self.folder.with_suffix(".away")
                self.folder.rename(away)
                line, = monitor.call("lines")["lines"]
                monitor.call("line_disconnect", line=line["line"])
                xr3.wait_log(f"error.*{self.path}: .* cannot be made: No such file.*; it is tried again every second")
                away.rename(self.folder)
                xr3.wait_log(f"{self.path}: the pseudo-terminal is served again")
                self.assertTrue(port.is_readable(), "hung up")
            with Port(self.path) as port:
                port.write(b"E?")
                self.assertEqual(1, len(port.read(1)))

    def test_a_step_takes_bytes_that_have_arrived(self):
        """The bytes of a program that has just opened the port are executed before the step, as on the robot port."""
        with self.server() as xr3, xr3.monitor() as monitor:
            for number in range(20):
                with Port(self.path) as port:
                    port.write(b"E-50\r" if number % 2 else b"E+50\r")
                    monitor.call("step", ticks=1000)
                    port.write(b"E?")
                    self.assertEqual(b" ", port.read(1))

    def test_a_line_ends_whose_program_has_read_no_reply(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            monitor.subscribe("event")
            fill_both_directions(self.path)
            next_event(monitor, "line_close")
            with Port(self.path) as port:
                port.write(INQUIRY)
                self.assertEqual(REPLY, port.read(1))

    def test_a_step_takes_more_bytes_than_the_kernel_hands_on_at_once(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            for number in range(20):
                with Port(self.path) as port:
                    port.write(b"\r" * 10_000 + (b"E-50\r" if number % 2 else b"E+50\r"))
                monitor.call("step", ticks=1000)
                with Port(self.path) as port:
                    port.write(b"E?")
                    self.assertEqual(b" ", port.read(1))

    def test_a_step_takes_bytes_of_the_program_after_one_that_has_left(self):
        with self.server() as xr3, xr3.monitor() as monitor:
            for number in range(20):
                with Port(self.path) as port:
                    port.write(b"E?")
                    port.read(1)
                with Port(self.path) as port:
                    port.write(b"E-50\r" if number % 2 else b"E+50\r")
                    monitor.call("step", ticks=1000)
                    port.write(b"E?")
                    self.assertEqual(b" ", port.read(1))

    def test_modes_that_a_program_leaves_do_not_last(self):
        """The step waits until the server knows of the program that came and went."""
        with self.server() as xr3, xr3.monitor() as monitor:
            subprocess.run(["stty", "-F", self.path, "sane", "1200"], check=True)
            monitor.call("step", ticks=1)
            with Port(self.path) as port:
                port.write(INQUIRY)
                self.assertEqual(REPLY, port.read(1))
                line, = monitor.call("lines")["lines"]
                self.assertEqual("9600", line["serial"])


class ThePath(Ptys):
    def refusal(self, *options):
        return run_xr3("serve", "--robot-port", "0", "--monitor-port", "0", *options)

    def test_the_path_is_gone_at_the_end(self):
        with self.server():
            self.assertTrue(os.path.islink(self.path))
            self.assertEqual({"rhino", "rhino.lock"}, set(os.listdir(self.folder)))
        self.assertEqual([], os.listdir(self.folder))

    def test_rights(self):
        for options, mode in ((), 0o600), (("--pty-mode", "0660"), 0o660):
            with self.subTest(options), self.server(*options):
                self.assertEqual(mode, stat.S_IMODE(os.stat(self.path).st_mode))
        self.assertIn("--pty-mode: 9: a mode has three octal digits", self.refusal("--pty-mode", "9").stderr)

    def test_several_ports(self):
        other = str(self.folder / "second")
        with self.server("--pty", other) as xr3, Port(self.path) as one, Port(other) as two:
            one.write(INQUIRY)
            self.assertEqual(REPLY, one.read(1))
            two.write(b"E?")
            self.assertEqual(1, len(two.read(1)))
            self.assertEqual([self.path, other], xr3.ptys)

    def test_something_else_at_the_path_is_kept(self):
        def a_file():
            pathlib.Path(self.path).write_text("precious", encoding="ascii")

        for make in a_file, lambda: os.symlink("/dev/null", self.path), lambda: os.mkdir(self.path):
            make()
            before = os.lstat(self.path)
            result = self.refusal("--pty", self.path)
            self.assertEqual((2, ""), (result.returncode, result.stdout))
            self.assertIn(f"xr3: {self.path}: the path for a pseudo-terminal is there already and is no link of xr3",
                          result.stderr)
            self.assertEqual(before.st_ino, os.lstat(self.path).st_ino)
            self.assertEqual(["rhino"], os.listdir(self.folder))
            os.rmdir(self.path) if os.path.isdir(self.path) else os.unlink(self.path)

    def test_two_servers_at_one_path(self):
        with self.server():
            before = os.readlink(self.path)
            result = self.refusal("--pty", self.path)
            self.assertEqual(2, result.returncode)
            self.assertIn("is in use by another xr3", result.stderr)
            self.assertEqual(before, os.readlink(self.path))

    def test_a_folder_that_is_not_there(self):
        result = self.refusal("--pty", str(self.folder / "no" / "rhino"))
        self.assertEqual(2, result.returncode)
        self.assertIn("cannot be locked", result.stderr)
        self.assertIn("No such file or directory", result.stderr)

    def test_the_link_of_a_killed_server_is_replaced(self):
        with contextlib.suppress(AssertionError), self.server() as xr3:
            xr3.process.send_signal(signal.SIGKILL)
            xr3.process.wait()
        self.assertTrue(os.path.islink(self.path), "it is still there")
        with self.server(), Port(self.path) as port:
            port.write(INQUIRY)
            self.assertEqual(REPLY, port.read(1))

    def test_a_link_that_somebody_replaced_is_kept(self):
        with self.server():
            os.unlink(self.path)
            os.symlink("/dev/null", self.path)
        self.assertEqual("/dev/null", os.readlink(self.path))


if __name__ == "__main__":
    unittest.main()
