"""Start and end of the process: the line LISTENING, the port file, exit codes, signals."""
# labels: serial

import json
import os
import pathlib
import pty
import re
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from support import DEADLINE_S, LOCALHOST, XR3, Server, connect, run_xr3

BROKEN = '{"name": "half a robot", "joints": ['


class Start(unittest.TestCase):
    def test_prints_only_listening(self):
        with Server() as xr3:
            self.assertRegex(xr3.greeting, r"^LISTENING robot=127\.0\.0\.1:\d+ monitor=127\.0\.0\.1:\d+\n$")
            self.assertNotIn(0, (xr3.robot_port, xr3.monitor_port))
            self.assertNotEqual(xr3.robot_port, xr3.monitor_port)
        # At its end the context has checked that there is no other output.

    def test_names_the_page_after_listening(self):
        for options in (), ("--listen", "0.0.0.0", "--insecure"):
            with self.subTest(options), Server(*options) as xr3:
                xr3.wait_log(rf"(?m)^xr3: open http://localhost:{xr3.monitor_port}/$")
        with Server(command=["sh", "-c", 'exec "$@" 2>&1', "sh", XR3, "serve"]) as xr3:
            xr3.process.send_signal(signal.SIGTERM)
            self.assertEqual(f"xr3: open http://localhost:{xr3.monitor_port}/\n", xr3.process.stdout.readline())
            xr3.process.stdout.read()

    def test_names_the_page_only_to_those_who_read(self):
        with tempfile.TemporaryDirectory() as folder:
            for options in ("--log-level", "warn"), ("--log-file", f"{folder}/log"):
                with self.subTest(options), Server(*options) as xr3:
                    xr3.stop()
                    self.assertEqual("", xr3.log())
        master, terminal = pty.openpty()
        self.addCleanup(os.close, master)
        self.addCleanup(os.close, terminal)
        with Server("--log-level", "off", command=["sh", "-c", f'exec "$@" 2>/dev/fd/{terminal}', "sh", XR3, "serve"],
                    pass_fds=[terminal]) as xr3:
            pass
        os.set_blocking(master, False)
        self.assertEqual(f"xr3: open http://localhost:{xr3.monitor_port}/\r\n".encode(), os.read(master, 1000))

    def test_both_ports_answer_after_listening(self):
        for _ in range(5):
            with Server() as xr3:
                robot, monitor = connect(xr3.robot_port), connect(xr3.monitor_port)
                monitor.sendall(b"GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n")
                robot.sendall(b"E?")
                self.assertEqual(b" ", robot.recv(1))
                self.assertRegex(monitor.recv(4096), rb"^HTTP/1\.1 200 ")
                robot.close()
                monitor.close()

    def test_port_file_appears_complete(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "ports.json")
            command = [XR3, "serve", "--robot-port", "0", "--monitor-port", "0", "--port-file", path]
            with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
                text, ends = None, time.monotonic() + DEADLINE_S
                while text is None and time.monotonic() < ends:  # reads the file as soon as it exists
                    try:
                        text = path.read_text(encoding="ascii")
                    except FileNotFoundError:
                        pass
                greeting = process.stdout.readline()
                process.terminate()
            ports = json.loads(text)
            self.assertEqual({"robot", "monitor", "pid", "cells"}, set(ports))
            self.assertEqual(process.pid, ports["pid"])
            self.assertIn(b"robot=127.0.0.1:%d monitor=127.0.0.1:%d\n" % (ports["robot"], ports["monitor"]),
                          greeting)
            self.assertLessEqual(set(os.listdir(folder)), {"ports.json"}, "no temporary file is left")

    def test_ipv6(self):
        with Server("--listen", "::1") as xr3:
            self.assertTrue(xr3.greeting.startswith("LISTENING robot=[::1]:"))
            with socket.create_connection(("::1", xr3.robot_port), DEADLINE_S) as sock:
                sock.sendall(b"E?")
                self.assertEqual(b" ", sock.recv(1))


class Nohup(unittest.TestCase):
    def test_a_server_started_with_nohup_survives_a_hangup(self):
        with Server(command=("nohup", XR3, "serve")) as xr3:
            os.kill(xr3.pid, signal.SIGHUP)
            self.assertEqual(0, xr3.stop())
            self.assertNotIn("signal 1:", xr3.log())
            self.assertIn("signal 15:", xr3.log())


class ExitCodes(unittest.TestCase):
    def refused(self, code, says, *arguments):
        """Checks the exit code, one sentence on standard error, and no standard output."""
        done = run_xr3(*arguments)
        self.assertEqual((code, ""), (done.returncode, done.stdout), done.stderr)
        self.assertRegex(done.stderr, says)
        self.assertRegex(done.stderr, r"\A[^\n]{10,}\n\Z", "one sentence on one line")

    def test_bad_arguments_and_files(self):
        with tempfile.TemporaryDirectory() as folder:
            broken = pathlib.Path(folder, "broken.json")
            broken.write_text(BROKEN, encoding="ascii")
            nowhere = str(pathlib.Path(folder, "absent", "ports.json"))
            for says, arguments in [
                ("--dance", ["serve", "--dance"]),
                ("r2d2.*rhino-xr3", ["serve", "--robot", "r2d2"]),
                ("r2d2.*rhino-xr3", ["serve", "--workcell", "r2d2"]),
                ("absent.json", ["serve", "--robot", f"{folder}/absent.json"]),
                (r"broken.json:1:\d+: ", ["serve", "--robot", broken]),
                (r"broken.json:1:\d+: ", ["serve", "--workcell", broken]),
                ("port file", ["serve", "--robot-port", 0, "--monitor-port", 0, "--port-file", nowhere]),
                ("absent.json", ["check", f"{folder}/absent.json"]),
            ]:
                with self.subTest(arguments=arguments):
                    self.refused(2, says, *arguments)

    def test_port_in_use(self):
        with socket.create_server((LOCALHOST, 0)) as taken:
            port = taken.getsockname()[1]
            for option, other in [("--robot-port", "--monitor-port"), ("--monitor-port", "--robot-port")]:
                with self.subTest(option):
                    self.refused(3, f"{port}.*in use", "serve", option, port, other, 0)

    def test_one_port_for_both_is_refused(self):
        with socket.create_server((LOCALHOST, 0)) as free:
            port = free.getsockname()[1]
        self.refused(3, f"{port}.*in use", "serve", "--robot-port", port, "--monitor-port", port)

    def test_a_failed_start_leaves_no_port_file(self):
        with tempfile.TemporaryDirectory() as folder, socket.create_server((LOCALHOST, 0)) as taken:
            path = pathlib.Path(folder, "ports.json")
            self.refused(3, "in use", "serve", "--robot-port", 0, "--monitor-port",
                         taken.getsockname()[1], "--port-file", path)
            self.assertEqual([], os.listdir(folder))

    def test_insecure_listens_to_all(self):
        with Server("--listen", "0.0.0.0", "--insecure") as xr3, xr3.line() as line:
            self.assertRegex(xr3.greeting, r"robot=0\.0\.0\.0:\d+ monitor=0\.0\.0\.0:\d+")
            self.assertEqual(32, line.ask("E?"))

    def test_help_lists_the_options(self):
        for arguments, words in [
            (["--help"], ["serve", "check", "telnet", "Exit codes"]),
            (["serve", "--help"], ["--robot", "--workcell", "--listen", "--robot-port", "--monitor-port",
                                   "--compat", "--clock", "--max-lines", "--max-memory", "--guard", "--port-file", "--log-level",
                                   "--insecure"]),
            (["check", "--help"], ["FILE"]),
        ]:
            with self.subTest(arguments=arguments):
                done = run_xr3(*arguments)
                self.assertEqual((0, ""), (done.returncode, done.stderr))
                for word in words:
                    self.assertIn(word, done.stdout)
                self.assertLessEqual(max(map(len, done.stdout.splitlines())), 120)

    def test_version(self):
        self.assertTrue(re.fullmatch(r"xr3 \d+\.\d+\.\d+ \(commit ([0-9a-f]+\+?|unknown), \w+ [\d.]+\)\n",
                                     run_xr3("--version").stdout))


class EndOfInput(unittest.TestCase):
    """--until-stdin-ends"""

    def setUp(self):
        self.input, self.other_end = os.pipe()
        self.addCleanup(os.close, self.input)

    def server(self, *options, **more):
        command = ["sh", "-c", f'exec "$@" <&{self.input}', "sh", XR3, "serve"]
        return Server(*options, command=command, pass_fds=[self.input], **more)

    def test_ends_in_order_when_the_input_ends(self):
        with tempfile.TemporaryDirectory() as folder:
            ports, run = pathlib.Path(folder, "ports"), pathlib.Path(folder, "run.xr3rec")
            with self.server("--until-stdin-ends", "--port-file", ports, "--record", run) as xr3, xr3.monitor() as monitor:
                line = xr3.line()
                os.write(self.other_end, b"E+50\n")
                self.assertEqual(32, line.ask("E?"), "what arrives is not used")
                os.close(self.other_end)
                self.assertEqual("shutdown", monitor.read()["why"])
                self.assertEqual(b"", line.read_to_end())
                line.close()
                self.assertEqual(0, xr3.process.wait(DEADLINE_S))
                xr3.wait_log("standard input has ended: stopping")
            self.assertFalse(ports.exists())
            self.assertEqual(0, run_xr3("replay", run).returncode)

    def test_a_file_ends_at_once(self):
        done = run_xr3("serve", "--robot-port", 0, "--monitor-port", 0, "--until-stdin-ends", stdin=subprocess.DEVNULL)
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertRegex(done.stdout, "^LISTENING ")

    def test_signals_end_it_too(self):
        with self.server("--until-stdin-ends") as xr3:
            self.assertEqual(0, xr3.stop())
        os.close(self.other_end)

    def test_is_an_argument_only(self):
        with self.server(environment={"XR3_UNTIL_STDIN_ENDS": "1"}) as xr3, xr3.line() as line:
            os.close(self.other_end)
            self.assertEqual(32, line.ask("E?"))
            self.assertEqual(0, xr3.stop())
            self.assertNotIn("standard input", xr3.log())
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write("until-stdin-ends = true\n")
            file.flush()
            done = run_xr3("serve", "--config", file.name)
            self.assertEqual(2, done.returncode)
            self.assertIn("until-stdin-ends: unknown key", done.stderr)


class Shutdown(unittest.TestCase):
    SIGNALS = (signal.SIGTERM, signal.SIGINT)

    def test_without_clients(self):
        for how in self.SIGNALS:
            with self.subTest(how), Server(clock="real") as xr3:
                self.assertEqual(0, xr3.stop(how))

    def test_with_clients_of_every_kind(self):
        """Server.stop() fails if it takes longer than two seconds."""
        for how in self.SIGNALS:
            with self.subTest(how), Server(clock="real") as xr3, xr3.monitor() as monitor:
                silent, undecided = xr3.line(), connect(xr3.monitor_port)
                begun, held = xr3.line(), xr3.line()
                begun.send("E+5")
                held.send("DELETE ")
                http = connect(xr3.monitor_port)
                http.sendall(b"GET /healthz HTT")
                moving = xr3.line()
                moving.send("E+100\rE?")
                self.assertGreater(moving.read(1)[0], 32)
                self.assertEqual(0, xr3.stop(how))
                for line in silent, begun, held, moving:
                    self.assertEqual(b"", line.read_to_end())
                    line.close()
                last_words = monitor.read()
                self.assertEqual(("bye", "shutdown"), (last_words["op"], last_words["why"]))
                self.assertIsNone(monitor.read())
                undecided.close()
                http.close()

    def test_pending_replies_are_sent(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            line.send("E?" * 3000)
            monitor.step(0, after=line)
            self.assertEqual(0, xr3.stop())
            self.assertEqual(b" " * 3000, line.read_to_end())

    def test_with_clients_that_never_read(self):
        with Server() as xr3, xr3.line(buffer_bytes=16384) as line:
            monitor = connect(xr3.monitor_port, buffer_bytes=16384)
            for sock, request in [(line.socket, b"E?" * 4096),
                                  (monitor, b'{"op":"get","channel":"state"}\n' * 100)]:
                sock.setblocking(False)
                try:
                    while True:
                        sock.send(request)
                except BlockingIOError:
                    pass
            self.assertEqual(0, xr3.stop())
            monitor.close()


if __name__ == "__main__":
    unittest.main()
