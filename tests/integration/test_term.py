"""`xr3 term` with real servers: in a script, in a pseudo-terminal, by RFC 2217, and on a serial device, for which a
pseudo-terminal of the test stands."""

import contextlib
import fcntl
import os
import pathlib
import pty
import re
import select
import signal
import socket
import subprocess
import tempfile
import termios
import threading
import unittest

from support import DEADLINE_S, LOCALHOST, ROOT, XR3, Server, motors, run_xr3
from terminal import Terminal

NO_ANSWER = 4
IN_USE = 3
BREAK_ON, BREAK_OFF = b"\xff\xfa\x2c\x05\x05\xff\xf0", b"\xff\xfa\x2c\x05\x06\xff\xf0"
PATIENCE = ("--timeout", str(DEADLINE_S))


def address(xr3):
    return f"{LOCALHOST}:{xr3.robot_port}"


def term(xr3, typed, *options):
    """Runs `xr3 term` in a script; `typed` is text or bytes."""
    typed = typed if isinstance(typed, bytes) else typed.encode()
    return subprocess.run([XR3, "term", address(xr3), *PATIENCE, *options], input=typed, capture_output=True,
                          timeout=2 * DEADLINE_S, check=False)


def console(peer, *options, **how):
    return Terminal([XR3, "term", peer, *PATIENCE, *options], **how)


@contextlib.contextmanager
def listener():
    with socket.create_server((LOCALHOST, 0)) as server:
        server.settimeout(DEADLINE_S)
        yield server, f"{LOCALHOST}:{server.getsockname()[1]}"


class Device:
    """A pseudo-terminal: its path is what a program opens, the test is the robot at the other end."""

    def __init__(self):
        self.robot, self._slave = pty.openpty()
        self.path = os.ttyname(self._slave)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for end in self.robot, self._slave:
            with contextlib.suppress(OSError):
                os.close(end)

    def read(self, count):
        data = b""
        while len(data) < count:
            assert select.select([self.robot], [], [], DEADLINE_S)[0], f"only {data!r} came"
            data += os.read(self.robot, count - len(data))
        return data

    def settings(self):
        return termios.tcgetattr(self._slave)


class Script(unittest.TestCase):
    def test_replies_are_lines(self):
        with Server() as xr3:
            done = term(xr3, "E+50\rE?ETEVIJKA*2,3*")
            self.assertEqual((0, b""), (done.returncode, done.stderr))
            self.assertEqual(["82  E: 50 counts to go", "50  E: error counter 50", "0  E: microswitch open",
                              "32  no microswitch closed", "32  no microswitch closed; no input line high",
                              "32  no input line high", "32  pixel in column 2, row 3: 0, no block"],
                             done.stdout.decode().splitlines())

    def test_all_bytes_act_before_it_ends(self):
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertEqual(0, term(xr3, "E+50\rF-7\r").returncode)
            by_label = motors(monitor.get())
            self.assertEqual((50, -7), (by_label["E"]["error"], by_label["F"]["error"]))

    def test_no_input_is_no_error(self):
        with Server() as xr3:
            done = term(xr3, "")
            self.assertEqual((0, b"", b""), (done.returncode, done.stdout, done.stderr))

    def test_raw_and_hex(self):
        with Server() as xr3:
            self.assertEqual(b"  \x00", term(xr3, "E?F?ET", "--raw").stdout)
            lines = term(xr3, "E?ET", "--hex").stdout.decode().splitlines()
            self.assertEqual("> 45 3f 45 54", lines[0])
            self.assertEqual("2000", "".join(lines[1:]).replace("<", "").replace(" ", ""))

    def test_ignored_bytes_are_explained(self):
        with Server() as xr3:
            done = term(xr3, "E+200\r(((E?")
            self.assertEqual((0, b"32  E: 0 counts to go\n"), (done.returncode, done.stdout))
            self.assertIn(b"E+200: a move is -128...127 counts; ignored", done.stderr)
            self.assertIn(b"(3 in a row)", done.stderr)
            self.assertEqual(b"", term(xr3, "E+200\r", "--raw").stderr)

    def test_another_robot_and_profile(self):
        with Server("--robot", "adept-one", "--compat", "mark3") as xr3:
            done = term(xr3, "I", "--robot", "adept-one", "--compat", "mark3")
            self.assertEqual(b"95  no microswitch closed\n", done.stdout)

    def test_a_large_input_does_not_block(self):
        """Far more inquiries than either side buffers, and replies that are not read meanwhile."""
        with Server() as xr3:
            done = term(xr3, "E?" * 100_000, "--raw")
            self.assertEqual((0, b" " * 100_000), (done.returncode, done.stdout))

    def test_files_and_devices_as_input(self):
        with Server() as xr3, tempfile.TemporaryFile() as file:
            file.write(b"E?" * 5000)
            file.seek(0)
            done = subprocess.run([XR3, "term", address(xr3), *PATIENCE], stdin=file, capture_output=True,
                                  timeout=DEADLINE_S, check=False)
            self.assertEqual((0, 5000), (done.returncode, done.stdout.count(b"\n")))
            self.assertEqual(0, run_xr3("term", address(xr3), stdin=subprocess.DEVNULL).returncode)

    def test_no_reply_in_time(self):
        with Server() as xr3:
            done = run_xr3("term", address(xr3), "--timeout", "0.3", input="A@E?F?")
            self.assertEqual((NO_ANSWER, ""), (done.returncode, done.stdout))
            self.assertIn("no reply to E? and 1 more within 0.3 s", done.stderr)

    def test_inquiries_wait_for_replies(self):
        """A peer that reads but never replies gets a bounded number of inquiries at a time."""
        with listener() as (server, peer):
            def swallow():
                with server.accept()[0] as robot:
                    while robot.recv(65536):
                        pass
            thread = threading.Thread(target=swallow)
            thread.start()
            done = run_xr3("term", peer, "--timeout", "0.3", input="E?" * 2500)
            thread.join()
        missing = [int(more) + 1 for more in re.findall(r"no reply to E\? and (\d+) more", done.stderr)]
        self.assertEqual((NO_ANSWER, 2500), (done.returncode, sum(missing)), done.stderr)
        self.assertLess(max(missing), 1300)

    def test_a_signal_is_not_success(self):
        with listener() as (server, peer):
            with subprocess.Popen([XR3, "term", peer], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
                with server.accept()[0]:
                    process.send_signal(signal.SIGTERM)
                    self.assertEqual(-signal.SIGTERM, process.wait(DEADLINE_S))

    def test_lost_output_is_an_error(self):
        with Server() as xr3, open("/dev/full", "wb") as full:
            done = subprocess.run([XR3, "term", address(xr3)], input=b"E?", stdout=full, stderr=subprocess.PIPE,
                                  timeout=DEADLINE_S, check=False)
            self.assertEqual(1, done.returncode)
            self.assertIn(b"standard output cannot be written", done.stderr)


class Errors(unittest.TestCase):
    def refused(self, code, words, *arguments, **how):
        done = run_xr3("term", *arguments, **{"input": "E?", **how})
        self.assertEqual((code, ""), (done.returncode, done.stdout), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_nothing_listens(self):
        with socket.socket() as taken:
            taken.bind((LOCALHOST, 0))
            self.refused(NO_ANSWER, ["nothing listens", "xr3 serve"], f"{LOCALHOST}:{taken.getsockname()[1]}")

    def test_a_file_without_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "rhino.invalid").touch()
            self.refused(NO_ANSWER, ["no address is known", "a path begins with"], "rhino.invalid", cwd=folder)

    def test_the_monitor_port(self):
        with Server() as xr3:
            done = run_xr3("term", f"{LOCALHOST}:{xr3.monitor_port}", "--timeout", "0.3", input="E?\r")
            self.assertIn("is no robot port", done.stderr)
            self.assertEqual(NO_ANSWER, done.returncode)

    def test_a_peer_that_closes(self):
        with listener() as (server, peer):
            def close():
                sock, _ = server.accept()
                sock.recv(1)
                sock.close()
            thread = threading.Thread(target=close)
            thread.start()
            self.refused(NO_ANSWER, ["has ended"], peer)
            thread.join()

    def test_a_peer_that_does_not_read(self):
        with listener() as (server, peer):
            self.refused(NO_ANSWER, ["has accepted no byte within 0.3 s"], peer, "--timeout", "0.3",
                         input="E+1 " * 4_000_000)
            server.accept()[0].close()

    def test_paths(self):
        with tempfile.TemporaryDirectory() as folder:
            missing, file = pathlib.Path(folder, "no"), pathlib.Path(folder, "file")
            file.touch()
            self.refused(2, ["there is no such device"], missing)
            self.refused(2, ["no serial device"], file)
            self.refused(2, ["no serial device"], "/dev/null")
            self.refused(2, [], folder)

    def test_no_permission(self):
        """The group of a pseudo-terminal is tty; a user without privileges opens it."""
        nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        with Device() as device:
            os.chmod(device.path, 0)
            self.refused(2, ["permission denied"], device.path, **nobody)

    def test_a_device_in_use(self):
        with Device() as device:
            other = os.open(device.path, os.O_RDWR | os.O_NOCTTY)
            fcntl.flock(other, fcntl.LOCK_EX)
            self.refused(IN_USE, ["in use by another program"], device.path)
            os.close(other)

    def test_an_impossible_speed(self):
        with Device() as device:
            self.refused(2, ["no device has 1234567 baud"], device.path, "--line-settings", "1234567-8n1")

    def test_arguments(self):
        self.refused(2, ["HOST:PORT"], "localhost:")
        self.refused(2, ["no-such-robot"], "localhost:1", "--robot", "no-such-robot")


class Console(unittest.TestCase):
    def check_end(self, terminal, code=0):
        self.assertEqual(code, terminal.wait_end(), terminal.process.stderr.read())
        self.assertTrue(terminal.is_as_before(), "the terminal's settings are restored")

    def test_a_session_as_in_the_documentation(self):
        page = pathlib.Path(ROOT, "docs", "term.md").read_text(encoding="utf-8")
        shown = re.search(r"((?:^    .*\n)+)", page, re.MULTILINE)[1]
        expected = [line[4:] for line in shown.splitlines()]
        with Server() as xr3, console(address(xr3), columns=100) as terminal:
            expected[0] = expected[0].replace("localhost:9600", address(xr3))
            terminal.wait_text("~? is help")
            terminal.press("E+50\r")
            terminal.press("E?")
            terminal.wait_text("counts to go")
            terminal.press("I")
            terminal.wait_text("no microswitch")
            terminal.press("E+200\r")
            terminal.wait_text("ignored")
            self.assertEqual(expected, terminal.text().rstrip("\n").split("\n"))
            terminal.press("~.")
            self.check_end(terminal)

    def test_keys_act_at_once(self):
        with Server() as xr3, xr3.monitor() as monitor, console(address(xr3)) as terminal:
            terminal.wait_text("connected")
            terminal.press("E?")
            terminal.wait_text("32  E: 0 counts to go")
            terminal.press("\x1b[A\x7f")
            terminal.wait_text("--line")
            terminal.press("E+5\rI")
            terminal.wait_text("no microswitch")
            self.assertEqual(5, motors(monitor.get())["E"]["error"])
            self.assertEqual([], [text for text in xr3.log().splitlines() if "skipped" in text])
            terminal.press("\x03")
            self.check_end(terminal)

    def test_escapes(self):
        with Server() as xr3, tempfile.TemporaryDirectory() as folder, console(address(xr3)) as terminal:
            file = pathlib.Path(folder, "f")
            file.write_bytes(b"\xff\x00~.E?" + b"E?" * 100)
            terminal.wait_text("connected")
            terminal.press("~?")
            terminal.wait_text("~s FILE  send a file")
            terminal.press("~b")
            terminal.wait_text("not possible here")
            terminal.press(f"~s {file}\r")
            terminal.wait_for(lambda _: b"206 bytes" in terminal.bytes
                              and terminal.bytes.count(b"32  E: 0 counts to go") == 101, "the report and all replies")
            terminal.press("~s /no/such\r")
            terminal.wait_text("/no/such: there is no such file")
            terminal.press(f"~s {folder}\r")
            terminal.wait_text("not a file")
            terminal.press("~~")
            terminal.wait_text("~: no command begins like this here")
            terminal.press("~.")
            self.check_end(terminal)

    def test_lines_are_edited(self):
        with Server() as xr3, xr3.monitor() as monitor, console(address(xr3), "--line") as terminal:
            terminal.wait_text("\n>")
            terminal.press("F+70\x1b[D\x7f5")
            terminal.wait_text("> F+50")
            self.assertEqual(0, motors(monitor.get())["F"]["error"])
            terminal.press("\rF?\r")
            terminal.wait_text("82  F: 50 counts to go")
            terminal.press("\x1b[A\x1b[A")
            terminal.wait_for(lambda text: text.rstrip().endswith("> F+50"))
            terminal.press("\x03half a li")
            terminal.wait_for(lambda text: text.endswith("> half a li") or "> half a li\n" in text)
            terminal.press("\x15F?\r~.\r")
            self.check_end(terminal)

    def test_a_reply_comes_above_the_edited_line(self):
        with listener() as (server, peer), console(peer, "--line") as terminal:
            robot, _ = server.accept()
            with robot:
                terminal.wait_text("\n>")
                terminal.press("F?\rE+5")
                self.assertEqual(b"F?\r", robot.recv(3))
                terminal.wait_text("> E+5")
                robot.sendall(b"-")
                terminal.wait_for(lambda text: re.search(r"> F\?\n +45  F: 13 counts to go\n> E\+5$", text.rstrip()))
                terminal.press("\x03\x04")
                self.check_end(terminal)

    def test_the_end_of_a_file_is_reported_below_its_replies(self):
        with tempfile.NamedTemporaryFile() as file, listener() as (server, peer), console(peer) as terminal:
            file.write(b"E?F?")
            file.flush()
            robot, _ = server.accept()
            with robot:
                terminal.wait_text("connected")
                terminal.press(f"~s {file.name}\r")
                self.assertEqual(b"E?F?", robot.recv(4, socket.MSG_WAITALL))
                robot.sendall(b"!")
                terminal.wait_text("E: 1 count to go")
                self.assertNotIn("sent ", terminal.text())
                robot.sendall(b'"')
                terminal.wait_for(lambda text: re.search(r"F: 2 counts to go\nsent \S+: 4 bytes", text))
                terminal.press("~.")
                self.check_end(terminal)

    def test_hexadecimal(self):
        with Server() as xr3, console(address(xr3), "--hex") as terminal:
            terminal.wait_text("connected")
            terminal.press("E?")
            terminal.wait_for(lambda text: "> 45\n> 3f\n< 20" in text or "> 45 3f\n< 20" in text)
            terminal.press("~.")
            self.check_end(terminal)

    def test_the_user_can_quit_while_the_peer_does_not_read(self):
        with tempfile.NamedTemporaryFile() as file, listener() as (server, peer), console(peer) as terminal:
            file.write(b"E+1 " * 4_000_000)
            file.flush()
            robot, _ = server.accept()
            with robot:
                terminal.wait_text("connected")
                terminal.press(f"~s {file.name}\r")
                self.assertTrue(robot.recv(1))
                terminal.press("~.")
                self.check_end(terminal)

    def test_the_peer_ends(self):
        with Server() as xr3, console(address(xr3)) as terminal:
            terminal.wait_text("connected")
            terminal.press("E?")
            terminal.wait_text("counts to go")
            xr3.stop(signal.SIGINT)
            self.check_end(terminal, NO_ANSWER)
            self.assertIn("has ended", terminal.text())

    def test_signals_restore_the_terminal(self):
        for number in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
            with self.subTest(number), Server() as xr3, console(address(xr3)) as terminal:
                terminal.wait_text("connected")
                terminal.signal(number)
                self.check_end(terminal)

    def test_no_reply_in_time(self):
        with Server() as xr3, Terminal([XR3, "term", address(xr3), "--timeout", "0.3"]) as terminal:
            terminal.wait_text("connected")
            terminal.press("A@\rE?")
            terminal.wait_text("no reply to E? within 0.3 s")
            terminal.press("~.")
            self.check_end(terminal)


class Rfc2217(unittest.TestCase):
    def test_settings_and_a_break(self):
        with Server() as xr3, xr3.monitor() as monitor:
            with console(address(xr3), "--rfc2217", "--line-settings", "1200-8n1") as terminal:
                terminal.wait_text("RFC 2217, 1200-8n1")
                line, = monitor.call("lines")["lines"]
                self.assertEqual(("rfc2217", "1200-8n1"), (line["kind"], line["serial"]))
                terminal.press("E?")
                terminal.wait_text("32  E: 0 counts to go")
                terminal.press("~b")
                terminal.wait_text("break sent")
                terminal.press("~.")
                self.assertEqual(0, terminal.wait_end())

    def test_in_a_script_data_is_8_bit_clean(self):
        with Server() as xr3:
            done = term(xr3, b"E-1\rET", "--rfc2217", "--raw")
            self.assertEqual((0, b"\xff", b""), (done.returncode, done.stdout, done.stderr))

    def test_the_bytes_of_a_break(self):
        with listener() as (server, peer), console(peer, "--rfc2217") as terminal:
            robot, _ = server.accept()
            with robot:
                robot.settimeout(DEADLINE_S)
                robot.sendall(b"\xff\xfd\x2c")
                received = self.read_until(robot, b"", b"\xff\xfa\x2c\x05\x01\xff\xf0")
                for code, value in (1, b"\0\0\x25\x80"), (2, b"\7"), (3, b"\3"), (4, b"\1"), (5, b"\1"):
                    robot.sendall(b"\xff\xfa\x2c" + bytes([100 + code]) + value + b"\xff\xf0")
                terminal.wait_text("has set 9600-7e1 instead of 9600-7e2")
                terminal.press("~b")
                self.read_until(robot, received, BREAK_OFF)
                terminal.wait_text("break sent")

    def read_until(self, robot, received, end):
        while not received.endswith(end):
            part = robot.recv(4096)
            self.assertTrue(part, received)
            received += part
        if end == BREAK_OFF:
            self.assertTrue(received.endswith(BREAK_ON + BREAK_OFF), received)
        return received

    def test_a_server_suspends_the_data(self):
        suspend, resume = b"\xff\xfa\x2c\x6c\xff\xf0", b"\xff\xfa\x2c\x6d\xff\xf0"
        with listener() as (server, peer), console(peer, "--rfc2217") as terminal:
            robot, _ = server.accept()
            with robot:
                robot.settimeout(DEADLINE_S)
                robot.sendall(b"\xff\xfe\x2c" + suspend)  # COM-PORT is refused, so no settings follow
                terminal.wait_text("has refused COM-PORT")
                while not robot.recv(4096).endswith(b"\xff\xfb\x2c"):
                    pass
                robot.sendall(b"!")  # behind the suspension
                terminal.wait_text("not asked for: !")
                terminal.press("E?\r~?")
                terminal.wait_text("this help")
                self.assertEqual([], select.select([robot], [], [], 0)[0], "nothing is sent")
                robot.sendall(resume)
                self.assertEqual(b"E?\r", robot.recv(3))


class SerialDevice(unittest.TestCase):
    def test_a_session(self):
        with Device() as device, console(device.path, "--line-settings", "1200-8n1") as terminal:
            terminal.wait_text(f"{device.path} is open, 1200-8n1")
            settings = device.settings()
            self.assertEqual(termios.B1200, settings[4])
            self.assertFalse(settings[3] & (termios.ECHO | termios.ICANON))
            terminal.press("E?")
            self.assertEqual(b"E?", device.read(2))
            os.write(device.robot, b"-")
            terminal.wait_text("45  E: 13 counts to go")
            terminal.press("~b")
            terminal.wait_text("a pseudo-terminal has no break")
            os.write(device.robot, b"\xff\r\n")
            terminal.wait_text(r"not asked for: \xff\r\n")
            terminal.press("~.")
            self.assertEqual(0, terminal.wait_end())
            self.assertTrue(terminal.is_as_before())

    def test_a_script(self):
        with Device() as device:
            robot = threading.Thread(target=lambda: (device.read(2), os.write(device.robot, b"-")))
            robot.start()
            done = run_xr3("term", device.path, *PATIENCE, input="E?")
            robot.join()
            self.assertEqual((0, "45  E: 13 counts to go\n", ""), (done.returncode, done.stdout, done.stderr))

    def test_two_sessions_exclude_each_other(self):
        with Device() as device, console(device.path) as terminal:
            terminal.wait_text("is open")
            done = run_xr3("term", device.path, input="")
            self.assertEqual(IN_USE, done.returncode)
            self.assertIn("in use", done.stderr)

    def test_the_own_terminal_is_refused(self):
        terminal = Terminal([XR3, "term", "/dev/tty"])
        with terminal:
            self.assertEqual(2, terminal.process.wait(DEADLINE_S))
            self.assertIn(b"/dev/tty", terminal.process.stderr.read())


if __name__ == "__main__":
    unittest.main()
