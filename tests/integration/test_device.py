"""A physical controller behind the lines: `xr3 serve --serial DEVICE`. The device is a second xr3 with the profile
of the Mark III on a pseudo-terminal, or a pseudo-terminal that the test holds itself."""

import contextlib
import fcntl
import os
import pathlib
import pty
import select
import subprocess
import sys
import tempfile
import termios
import threading
import time
import tty
import unittest

from support import DEADLINE_S, ROOT, Server, counts, run_xr3

STOP = b"AXBXCXDXEXFXGXHX"


class Controller:
    """A pseudo-terminal whose master is the device: it tells what arrived and answers as the test says."""

    def __init__(self):
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        self.path = os.ttyname(self.slave)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.master)
        os.close(self.slave)

    def arrived(self, count):
        """The next bytes, so many."""
        data = b""
        while len(data) < count:
            if not select.select([self.master], [], [], DEADLINE_S)[0]:
                raise TimeoutError(f"only {data!r}")
            data += os.read(self.master, count - len(data))
        return data

    def has_bytes(self):
        return bool(select.select([self.master], [], [], 0)[0])

    def answer(self, data):
        os.write(self.master, data)


def disable(xr3, line):
    """Switches the simulator off on this line, and waits until it is."""
    with xr3.monitor() as monitor:
        line.send("A@")
        while monitor.get("enabled")["enabled"]:
            pass


PICK = """
import sys, time, xr3
with xr3.Robot(port=int(sys.argv[1]), pause=lambda: time.sleep(float(sys.argv[2]))) as robot:
    robot.home()
    robot.pick(xr3.Pose(262, 0, 20, 90))
"""


def home_and_pick(xr3, pause_s):
    """Homes and picks the red block with the Python package."""
    done = subprocess.run([sys.executable, "-c", PICK, str(xr3.robot_port), str(pause_s)], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": os.path.join(ROOT, "clients", "python")}, timeout=200, check=False)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)


class ADeviceByHand(unittest.TestCase):
    @contextlib.contextmanager
    def served(self, *options):
        with Controller() as controller, Server("--serial", controller.path, *options, clock="real") as xr3:
            yield controller, xr3

    def test_nothing_is_sent_at_start_on_connect_or_at_the_end(self):
        with self.served() as (controller, xr3):
            line = xr3.line()
            line.send("E+50\rF+10\rE")
            line.ask("?")
            disable(xr3, line)
            xr3.line().send("E+")
            xr3.stop()
            self.assertFalse(controller.has_bytes())

    def test_whole_commands_and_replies(self):
        with self.served() as (controller, xr3):
            one, two = xr3.line(), xr3.line()
            disable(xr3, one)
            one.send("E+5")
            two.send("F?")
            self.assertEqual(b"F?", controller.arrived(2))
            controller.answer(b"$")
            self.assertEqual(b"$", two.read(1))
            one.send("?")
            self.assertEqual(b"E+5\rE?", controller.arrived(6))
            controller.answer(b"%")
            self.assertEqual(b"%", one.read(1))

    def test_the_port_has_the_settings_of_a_mark3(self):
        with self.served() as (controller, _):
            iflag, oflag, cflag, lflag, *_ = termios.tcgetattr(controller.slave)
            raw = (0, oflag & ~termios.OPOST, lflag & ~(termios.ECHO | termios.ICANON | termios.ISIG | termios.IEXTEN))
            self.assertEqual(raw, (iflag, oflag, lflag))
            self.assertFalse(cflag & termios.HUPCL)

    def test_other_programs_that_lock_the_port_are_kept_away(self):
        with self.served() as (controller, _):
            with self.assertRaises(BlockingIOError):
                fcntl.flock(controller.slave, fcntl.LOCK_EX | fcntl.LOCK_NB)
            result = run_xr3("serve", "--robot-port", "0", "--monitor-port", "0", "--serial", controller.path)
            self.assertEqual(2, result.returncode)
            self.assertRegex(result.stderr, "in use by another program")

    def test_a_pseudo_terminal_that_had_the_settings_before(self):
        with Controller() as controller:
            for settings in "9600-7e2", "9600-7e2", "9600-7e1", "9600-8n1", "9600-8e1":
                with self.subTest(settings), Server("--serial", f"{controller.path}:{settings}", clock="real") as xr3:
                    self.assertEqual(b" ", bytes([xr3.line().ask("E?")]))

    def test_device_stop(self):
        with self.served() as (controller, xr3), xr3.monitor() as monitor:
            line = xr3.line()
            disable(xr3, line)
            line.send("E?" + "E+100\r" * 20)
            self.assertEqual(b"E?", controller.arrived(2))
            start = time.monotonic()
            monitor.call("device_stop")
            self.assertEqual(STOP, controller.arrived(len(STOP)))
            self.assertLess(time.monotonic() - start, 0.5, "20 ms on a machine that has nothing else to do")
            self.assertFalse(controller.has_bytes(), "what waited is dropped")

    def test_a_device_that_does_not_answer(self):
        with self.served() as (controller, xr3), xr3.monitor() as monitor:
            monitor.subscribe("event")
            one, two = xr3.line(), xr3.line()
            disable(xr3, one)
            one.send("E?")
            controller.arrived(2)
            two.send("F?")
            silent = monitor.read_until(lambda message: message.get("code") == "device_silent")[-1]
            self.assertEqual((1, "warning"), (silent["line"], silent["event"]))
            self.assertEqual(b"F?", controller.arrived(2))
            controller.answer(b"2")
            self.assertEqual(b"2", two.read(1))
            controller.answer(b"x")
            unasked = monitor.read_until(lambda message: message.get("code") == "device_unasked")[-1]
            self.assertEqual(("78", 1, None), (unasked["hex"], unasked["count"], unasked["line"]))

    def test_the_state_and_the_line_records_tell_of_the_device(self):
        with self.served() as (controller, xr3), xr3.monitor() as monitor:
            line = xr3.line()
            disable(xr3, line)
            line.send("E?")
            controller.arrived(2)
            controller.answer(b"-")
            line.read(1)
            state = monitor.get()
            self.assertFalse(state["enabled"])
            self.assertEqual({"path": controller.path, "open": True, "engaged": True, "bytes_out": 2, "bytes_in": 1},
                             state["device"])
            messages = [each["message"] for record in monitor.recall("line") for each in record["parsed"]]
            self.assertIn("to the device: E?", messages)
            self.assertIn("from the device: E: 13 counts to go", messages)

    def test_a_loaded_snapshot_does_not_open_the_way_to_the_device(self):
        with self.served() as (_, xr3), xr3.monitor() as monitor:
            line = xr3.line()
            disable(xr3, line)
            self.assertTrue(monitor.get("device")["device"]["engaged"])
            snapshot = monitor.call("snapshot_save", inline=True)["snapshot"]
            monitor.call("reset")
            monitor.call("snapshot_load", snapshot=snapshot)
            state = monitor.get()
            self.assertEqual((False, False), (state["enabled"], state["device"]["engaged"]))

    def test_the_call_lines_lists_the_device_beside_the_lines(self):
        with self.served() as (controller, xr3), xr3.monitor() as monitor:
            line = xr3.line()
            disable(xr3, line)
            line.send("E+5\rE?")
            controller.arrived(6)
            controller.answer(b"-")
            line.read(1)
            value = monitor.call("lines")
            device = value["device"]
            opened = device.pop("opened_tick")
            self.assertLessEqual(opened, value["tick"])
            self.assertEqual({"kind": "device", "peer": controller.path, "open": True, "bytes_in": 1, "bytes_out": 6,
                              "last": "E?", "serial": "9600-7e2"}, device)
            self.assertEqual(["tcp"], [each["kind"] for each in value["lines"]])
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertNotIn("device", monitor.call("lines"))

    def test_a_flood_is_slowed_and_nothing_is_lost(self):
        with self.served() as (controller, xr3):
            line = xr3.line()
            disable(xr3, line)
            commands = b"E+1\rE-1\r" * 5000
            sender = threading.Thread(target=line.send, args=(commands,))
            sender.start()
            self.assertEqual(commands, controller.arrived(len(commands)))
            sender.join()

    def test_a_megabyte_of_garbage(self):
        """Bytes of a line and of the device; afterwards a command still gets its reply."""
        with self.served() as (controller, xr3), xr3.monitor() as monitor:
            with xr3.line() as line:
                disable(xr3, line)
                line.send(bytes(each % 64 for each in range(1 << 18)).replace(b"@", b""))
            controller.answer(os.urandom(4000))
            deadline = time.monotonic() + DEADLINE_S
            while monitor.get("device")["device"]["bytes_in"] < 4000 or monitor.call("lines")["lines"]:
                self.assertLess(time.monotonic(), deadline)
            line = xr3.line()
            line.send("E?")
            self.assertEqual(b"E?", controller.arrived(2), "a digit without a joint is no command")
            controller.answer(b"1")
            self.assertEqual(b"1", line.read(1))


class ASecondXr3(unittest.TestCase):
    """The device is a Mark III in the simulator, on a pseudo-terminal."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.addCleanup(folder.cleanup)
        self.path = str(pathlib.Path(folder.name, "arm"))

    @contextlib.contextmanager
    def chain(self, *options, rate="real:20"):
        with Server("--compat", "mark3", "--pty", self.path, clock=rate) as arm:
            with Server("--compat", "mark3", "--serial", self.path, *options, clock="real") as xr3:
                yield arm, xr3

    def test_a_move_through_the_chain(self):
        with self.chain() as (arm, xr3), arm.monitor() as watcher:
            while not (lines := watcher.call("lines")["lines"]):  # the second xr3 opens the device
                pass
            self.assertEqual("9600", lines[0]["serial"])
            line = xr3.line()
            disable(xr3, line)
            line.send("E+50\r")
            while line.ask("E?") != 32:
                pass
            self.assertEqual("E50", counts(watcher.get(), "E"))

    def test_two_lines_that_ask_all_the_time_get_their_own_replies(self):
        """The error counters differ and stand still, since the arm is stalled in manual time."""
        with self.chain(rate="manual") as (_, xr3):
            one, two = xr3.line(), xr3.line()
            disable(xr3, one)
            one.send("E+50\r")
            two.send("F+7\r")
            self.assertEqual((82, 39), (one.ask("E?"), two.ask("F?")))
            wrong = []

            def ask(line, inquiry, expected):
                for _ in range(1000):
                    if line.ask(inquiry) != expected:
                        wrong.append(inquiry)

            threads = [threading.Thread(target=ask, args=each) for each in ((one, "E?", 82), (two, "F?", 39))]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual([], wrong)

    def test_a_homing_and_a_pick(self):
        """A program for the arm, unchanged: the Python package, which needs only what a Mark III has."""
        with self.chain() as (arm, xr3), arm.monitor() as watcher:
            disable(xr3, xr3.line())
            home_and_pick(xr3, pause_s=0.002)
            self.assertEqual("red", watcher.get("tool")["tool"]["holding"])
            lifted = next(each for each in watcher.get("blocks")["blocks"] if each["name"] == "red")
            self.assertGreater(lifted["xyz_mm"][2], 100)
            with xr3.monitor() as monitor:
                self.assertEqual("", counts(monitor.get()), "the simulation has not moved")

    def test_the_mirror_follows(self):
        with self.chain("--mirror") as (arm, xr3), arm.monitor() as watcher, xr3.monitor() as monitor:
            line = xr3.line()
            disable(xr3, line)
            line.send("E+50\rF-20\r")
            while line.ask("E?") != 32 or line.ask("F?") != 32 or monitor.get("moving")["moving"]:
                pass
            for side in watcher, monitor:
                self.assertEqual("F-20 E50", counts(side.get(), "FE"))

    def test_a_device_that_vanishes_and_returns(self):
        with Server("--compat", "mark3", "--pty", self.path) as arm:
            with Server("--serial", self.path, clock="real") as xr3, xr3.monitor() as monitor:
                monitor.subscribe("event")
                line = xr3.line()
                disable(xr3, line)
                self.assertEqual(32, line.ask("E?"))
                arm.stop()
                lost = monitor.read_until(lambda message: message.get("code") == "device_lost")[-1]
                self.assertEqual(self.path, lost["device"])
                self.assertFalse(monitor.get("device")["device"]["open"])
                line.send("E+50\rE?")
                with Server("--compat", "mark3", "--pty", self.path):
                    monitor.read_until(lambda message: message.get("code") == "device_opened")
                    self.assertEqual(32, line.ask("E?"), "E+50 was dropped, not kept")


class Options(unittest.TestCase):
    def refusal(self, *options):
        result = run_xr3("serve", "--robot-port", "0", "--monitor-port", "0", *options)
        self.assertEqual((2, ""), (result.returncode, result.stdout))
        return result.stderr

    def test_a_device_that_is_not_there(self):
        self.assertRegex(self.refusal("--serial", "/dev/no-such-port"),
                         "/dev/no-such-port: there is no such device; is it plugged in")

    def test_something_else(self):
        self.assertIn("no serial device and no pseudo-terminal", self.refusal("--serial", "/dev/null"))

    def test_settings(self):
        self.assertIn("--serial: /dev/ttyS0:12: a device is a path, or a path and settings such as",
                      self.refusal("--serial", "/dev/ttyS0:12"))

    def test_time_must_be_real(self):
        for clock in "manual", "real:2":
            self.assertIn("--serial needs --clock real", self.refusal("--serial", "/dev/null", "--clock", clock))

    def test_other_machines_need_a_token(self):
        self.assertIn("needs a token", self.refusal("--serial", "/dev/null", "--listen", "0.0.0.0", "--insecure"))


if __name__ == "__main__":
    unittest.main()
