"""`xr3 watch` in a pseudo-terminal with a real server: the screen, keys, sizes, and its exit."""

import os
import pathlib
import re
import signal
import socket
import subprocess
import tempfile
import threading
import unittest

from support import DEADLINE_S, LOCALHOST, XR3, Server, run_xr3
from terminal import Terminal

NO_SERVER = 4
TOKEN = "a token of no meaning"


def watch(port, *options, **how):
    return Terminal([XR3, "watch", f"localhost:{port}", *options], **how)


def row_of(label, screen):
    """The row of a joint in the table; "" if it is not displayed yet."""
    row = re.search(rf"^ {label} .*$", screen, re.MULTILINE)
    return row[0] if row else ""


class Watch(unittest.TestCase):
    def leave(self, terminal, key="q"):
        terminal.press(key)
        self.check_end(terminal)

    def check_end(self, terminal):
        self.assertEqual(0, terminal.wait_end(), terminal.process.stderr.read())
        self.assertTrue(terminal.is_as_before(), "the terminal's settings are restored")

    def test_shows_moves_and_warnings(self):
        with Server(clock="real:20") as xr3, watch(xr3.monitor_port) as terminal:
            terminal.wait_for(lambda text: re.search(r"-140 █.*-90\.00 deg.*rests", row_of("E", text)))
            terminal.wait_text("magenta")
            terminal.wait_for(lambda text: "camera 192 x 192" in text and re.search("[▀▄]", text))
            line = xr3.line()
            line.send("E+50\rE+200\r")
            terminal.wait_for(lambda text: "-84.33 deg" in row_of("E", text) and "rests" in row_of("E", text))
            terminal.wait_text("E+200")
            self.leave(terminal)

    def test_follows_the_window_size(self):
        with Server() as xr3, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("camera")
            for rows, columns in (60, 200), (10, 40), (24, 80):
                with self.subTest(rows=rows, columns=columns):
                    terminal.resize(rows, columns)
                    terminal.wait_for(lambda text, is_large=columns > 79: (
                        text.startswith(" xr3 watch") and text.split("\n")[-1].startswith(" q quit")
                        and "-90.00 deg" in row_of("E", text) and ("camera" in text) == is_large))
            self.leave(terminal, "\x1b")

    def test_keys_pause_step_and_home(self):
        with Server(clock="real") as xr3, xr3.monitor() as monitor, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("space pause")
            terminal.press(" ")
            terminal.wait_text("paused   epoch")
            before = monitor.get("clock")
            self.assertEqual("manual", before["clock"]["mode"])
            line = xr3.line()
            line.send("F+20\r")
            monitor.step(0, after=line)
            terminal.press(">")
            terminal.wait_for(lambda text: re.search(r" 20 +0 ", row_of("F", text)))
            self.assertEqual(before["tick"] + 1000, monitor.get("clock")["tick"])
            terminal.press(".")
            terminal.wait_text(f"tick {before['tick'] + 1010}")
            terminal.press("h")
            terminal.wait_text("home")
            terminal.press("?")
            terminal.wait_text("show or leave this page")
            terminal.press("?")
            terminal.wait_text("deg")
            terminal.press(" ")
            terminal.wait_text("real x 1")
            self.leave(terminal, "\x03")

    def test_the_time_of_a_robot_at_rest_goes_on(self):
        with Server(clock="real:20") as xr3, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("rests")
            ticks = re.compile(r"tick (\d+)")
            terminal.wait_for(ticks.search)
            began = int(ticks.search(terminal.text())[1])
            terminal.wait_for(lambda text: (tick := ticks.search(text)) and int(tick[1]) > began + 1000)
            self.leave(terminal)

    def test_shows_that_another_client_has_paused_the_clock(self):
        with Server(clock="real") as xr3, xr3.monitor() as monitor, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("real x 1")
            tick = monitor.call("pause")["tick"]
            terminal.wait_text(f"paused   epoch 0   tick {tick} ")
            monitor.step(1234)  # publishes no state
            terminal.wait_text(f"paused   epoch 0   tick {tick + 1234} ")
            monitor.call("resume")
            terminal.wait_text("real x 1")
            self.leave(terminal)

    def test_command_mode_by_letters(self):
        with Server() as xr3, xr3.monitor() as monitor, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("h home")  # connected, with permission for calls
            terminal.press("s2")
            terminal.wait_text("status line (0 to 6): 2_")
            terminal.press("\r")
            terminal.wait_for(lambda text: text.split("\n")[-2].strip())
            status = monitor.look("display")["status"]
            self.assertEqual(2, status["option"])
            self.assertEqual(status["text"].strip(), terminal.text().split("\n")[-2].strip())
            terminal.press("v0 0 0\r")
            terminal.wait_text("not this: 0 0 0_")
            terminal.press("\b\b\b\b\b1 -2 3\r")
            terminal.press("m")
            terminal.wait_text("view vector             1, -2, 3")
            terminal.press("e")
            terminal.wait_text("disabled")
            self.assertFalse(monitor.get("enabled")["enabled"])
            terminal.press("m")
            self.leave(terminal)

    def test_command_mode_by_function_keys(self):
        for name, alt_f1 in ("xterm", "\x1b[1;3P"), ("linux", "\x1b\x1b[[A"):
            with self.subTest(name), Server() as xr3, xr3.monitor() as monitor, \
                    watch(xr3.monitor_port, environment={"TERM": name}) as terminal:
                terminal.wait_text("h home")  # connected, with permission for calls
                terminal.press(alt_f1)
                terminal.press("m")
                terminal.wait_for(lambda text: re.search(r"Alt F1 +graphics display +on", text))
                self.assertTrue(monitor.look("display")["on"])
                self.leave(terminal)

    def test_shows_the_serial_lines(self):
        with Server("--pty", self.path()) as xr3, xr3.monitor() as monitor, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("l lines")
            terminal.press("l")
            terminal.wait_text("No serial line is open.")
            line = xr3.line()
            line.send("E+5\r")
            monitor.step(65_000, after=line)
            terminal.wait_for(lambda text: re.search(
                r"^ +1  tcp +127\.0\.0\.1:\d+ +1 min 5 s +4 +0 +E\+5\\r$", text, re.MULTILINE))
            descriptor = os.open(self.path(), os.O_RDWR | os.O_NOCTTY)
            terminal.wait_for(lambda text: re.search(r"^ +2  pty .* 0 s +0 +0  9600$", text, re.MULTILINE))
            os.close(descriptor)
            line.ask("E?")
            terminal.wait_for(lambda text: re.search(r" 6 +1 .*E\?$", text, re.MULTILINE) and " pty " not in text)
            terminal.press("?")
            terminal.wait_text("who is connected")
            terminal.press("?")
            terminal.wait_text("E?")
            terminal.press("\x1b")
            terminal.wait_text("-90.00 deg")
            self.leave(terminal)

    def path(self):
        if not hasattr(self, "folder"):
            self.folder = tempfile.TemporaryDirectory()
            self.addCleanup(self.folder.cleanup)
        return str(pathlib.Path(self.folder.name, "rhino"))

    def test_shows_the_device(self):
        with Server("--compat", "mark3", "--pty", self.path()) as arm:
            with Server("--serial", self.path(), clock="real") as xr3, watch(xr3.monitor_port, "--lines") as terminal:
                terminal.wait_for(lambda text: re.search(r"^ +device .*rhino .* 0 +0  9600-7e2$", text, re.MULTILINE))
                line = xr3.line()
                line.send("A@E?")
                line.read(1)
                terminal.wait_for(lambda text: re.search(r"^ +device .* 1 +2 +9600-7e2 +E\?$", text, re.MULTILINE))
                terminal.press("l")
                terminal.wait_text(f"disabled: commands go to device {self.path()}")
                terminal.press("l")
                arm.stop()
                terminal.wait_text("not there")
                terminal.press("l")
                terminal.wait_text("is not there; commands are dropped")
                self.leave(terminal)

    def test_once_prints_the_lines(self):
        with Server() as xr3:
            line = xr3.line()
            line.ask("E?")
            done = run_xr3("watch", "--once", "--lines", f"localhost:{xr3.monitor_port}")
            self.assertEqual((0, ""), (done.returncode, done.stderr))
            self.assertRegex(done.stdout, r"\n +line +kind +peer +age +in +out +last\n +1 +tcp ")
            self.assertNotIn("quit", done.stdout)

    def test_shows_a_stall(self):
        with Server(clock="real:50") as xr3, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("rests")
            with xr3.monitor() as monitor:
                line = xr3.line()
                monitor.call("pause")
                for _ in range(8):
                    line.send("E-100\rD+100\r")
                    monitor.settle(after=line)
            terminal.wait_for(lambda text: "STALLED" in text or "limit" in text)

    def test_reconnects_to_a_server(self):
        with socket.socket() as taken:  # reserves a port on which no process listens
            taken.bind((LOCALHOST, 0))
            port = taken.getsockname()[1]
            with watch(port) as terminal:
                terminal.wait_text("cannot connect to")
                self.leave(terminal)
        with Server() as first, watch(first.monitor_port) as terminal:
            terminal.wait_text("-90.00 deg")
            first.stop()
            terminal.wait_for(lambda text: re.search("the server is stopping.*retrying", text))
            terminal.wait_text("-90.00 deg")
            second = Server("--robot", "adept-one")
            second.options[second.options.index("--monitor-port") + 1] = str(first.monitor_port)
            with second:
                terminal.wait_for(lambda text: "Adept" in text and " deg" in text and "retrying" not in text)
            terminal.wait_for(lambda text: "retrying" in text.lower())  # "Retrying" if no state came
            self.leave(terminal)

    def test_detects_that_the_server_ended(self):
        with Server() as xr3, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("-90.00 deg")
            xr3.stop(signal.SIGINT)
            terminal.wait_text("retrying")
            terminal.signal(signal.SIGTERM)
            self.check_end(terminal)

    def test_colors_can_be_disabled(self):
        with Server() as xr3:
            for options, environment, has_colors in ([], {}, True), (["--no-color"], {}, False), \
                    ([], {"NO_COLOR": "1"}, False):
                with self.subTest(options=options, environment=environment), \
                        watch(xr3.monitor_port, *options, environment=environment) as terminal:
                    terminal.wait_text("magenta")
                    self.assertEqual(has_colors, "cyan" in terminal.colors())
                    self.leave(terminal)

    def test_a_locale_without_unicode_gets_ascii(self):
        with Server() as xr3, watch(xr3.monitor_port, environment={"LC_ALL": "C"}) as terminal:
            terminal.wait_for(lambda text: "175" in text and "#" in row_of("E", text))
            self.assertTrue(terminal.bytes.isascii())
            self.leave(terminal)

    def test_a_terminal_without_a_cursor_is_refused(self):
        with watch(1, environment={"TERM": "dumb"}) as terminal:
            self.assertEqual(1, terminal.process.wait(DEADLINE_S))
            self.assertIn(b"--once", terminal.process.stderr.read())

    def test_once_prints_a_screen(self):
        with Server() as xr3:
            done = run_xr3("watch", "--once", f"localhost:{xr3.monitor_port}")
            self.assertEqual((0, ""), (done.returncode, done.stderr))
            self.assertIn("-90.00 deg", row_of("E", done.stdout))
            self.assertIn("camera 192 x 192", done.stdout)
            self.assertNotIn("\x1b", done.stdout)
            self.assertLessEqual(max(map(len, done.stdout.split("\n"))), 80)
            piped = run_xr3("watch", f"localhost:{xr3.monitor_port}", stdin=subprocess.DEVNULL)
            self.assertEqual(done.stdout, piped.stdout)
            plain = run_xr3("watch", "--ascii", f"localhost:{xr3.monitor_port}",
                            env={**os.environ, "LINES": "60", "COLUMNS": "200"})
            self.assertTrue(plain.stdout.isascii())
            self.assertEqual(60, plain.stdout.count("\n"))

    def test_once_reports_errors(self):
        with Server() as xr3:
            self.assertEqual(NO_SERVER, self.refused(f"localhost:{xr3.robot_port}", "no monitor port"))
            self.assertEqual(2, self.refused(f"localhost:{xr3.monitor_port}", "there is no cell", "--cell", "x"))
        with socket.socket() as taken:
            taken.bind((LOCALHOST, 0))
            self.assertEqual(NO_SERVER, self.refused(f"localhost:{taken.getsockname()[1]}", "cannot connect"))
        for address in "localhost:", ":9601", "localhost:x", "localhost:70000", "":
            self.assertEqual(2, self.refused(address, "HOST:PORT"))
        self.assertEqual(2, self.refused("localhost:1", "no/such/file", "--token-file", "no/such/file"))

    def test_once_shows_the_error_of_a_full_server(self):
        with socket.create_server((LOCALHOST, 0)) as full:
            answer = threading.Thread(target=self.say_full, args=(full,))
            answer.start()
            self.assertEqual(NO_SERVER, self.refused(f"localhost:{full.getsockname()[1]}", "too many connections"))
            answer.join()

    def say_full(self, listener):
        """Answers one connection as xr3 does above its maximum number of connections."""
        sock, _ = listener.accept()
        with sock:
            sock.sendall(b'{"op":"bye","code":"full","message":"too many connections; close some and try again"}\n')
            sock.shutdown(socket.SHUT_WR)
            while sock.recv(4096):
                pass

    def refused(self, address, word, *options):
        done = run_xr3("watch", "--once", address, *options)
        self.assertIn(word, done.stderr)
        self.assertEqual("", done.stdout)
        return done.returncode

    def token_file(self, token=TOKEN):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        file = pathlib.Path(folder.name, "token")
        file.write_text(token + "\n", encoding="utf-8")
        file.chmod(0o600)
        return file

    def type_token(self, terminal, token, end="\r"):
        terminal.press("t")
        terminal.wait_text("token, not shown: 0 characters")
        terminal.press(token)
        text = terminal.wait_text(f"{len(token)} characters")
        self.assertNotIn(token[:6], text)
        terminal.press(end)
        terminal.wait_for(lambda text: "not shown" not in text)

    def test_the_token_can_be_typed_and_is_never_shown(self):
        with Server("--token-file", self.token_file()) as xr3, watch(xr3.monitor_port) as terminal:
            terminal.wait_text("t token   read only")
            terminal.press("l")
            terminal.wait_text("The list of serial lines needs the server's token.")
            self.type_token(terminal, TOKEN[:-1])
            terminal.wait_text("the server refuses this token: press t")
            self.type_token(terminal, TOKEN, "\x1b")
            self.assertIn("The list of serial lines needs", terminal.text())
            self.type_token(terminal, TOKEN)
            terminal.wait_text("No serial line is open.")
            terminal.wait_text("space resume")
            self.leave(terminal)

    def test_a_private_server_shows_nothing_without_the_token(self):
        with Server("--token-file", self.token_file(), "--private") as xr3:
            with watch(xr3.monitor_port) as terminal:
                terminal.wait_text("Press t and type it, or start xr3 watch with --token-file FILE")
                self.type_token(terminal, TOKEN)
                terminal.wait_text("-90.00 deg")
                self.leave(terminal)
            wrong = str(self.token_file("a wrong token of 30 letters"))
            with watch(xr3.monitor_port, "--token-file", wrong) as terminal:
                terminal.wait_text("the server refuses this token")
                self.type_token(terminal, TOKEN)
                terminal.wait_text("-90.00 deg")
                self.leave(terminal)
            address = f"localhost:{xr3.monitor_port}"
            self.assertEqual(2, self.refused(address, "shows nothing without its token: see --token-file"))
            self.assertEqual(2, self.refused(address, "refuses this token", "--token-file", wrong))

    def test_once_needs_the_token_for_the_lines_only(self):
        with Server("--token-file", self.token_file()) as xr3:
            address = f"localhost:{xr3.monitor_port}"
            self.assertEqual(0, run_xr3("watch", "--once", address).returncode)
            self.assertEqual(2, self.refused(address, "the call lines needs the token: see --token-file", "--lines"))
            done = run_xr3("watch", "--once", "--lines", address, env={**os.environ, "XR3_TOKEN": TOKEN})
            self.assertEqual((0, ""), (done.returncode, done.stderr))
            self.assertIn("No serial line is open.", done.stdout)

    def test_keys_need_the_token(self):
        file = self.token_file()
        with Server("--token-file", file) as xr3:
            with watch(xr3.monitor_port) as terminal:
                terminal.wait_text("read only")
                terminal.press("h")
                terminal.wait_text("this key needs the token: press t, or use --token-file FILE or XR3_TOKEN")
            with watch(xr3.monitor_port, "--token-file", str(file)) as terminal:
                terminal.wait_text("space resume")
            with watch(xr3.monitor_port, environment={"XR3_TOKEN": TOKEN}) as terminal:
                terminal.wait_text("space resume")


if __name__ == "__main__":
    unittest.main()
