"""Log messages of events that are caused by simulated time, and escapes in the log."""

import os
import pathlib
import tempfile
import time
import unittest

from support import Server, connect, drive, run_xr3

BURST, BYTES_A_SECOND = 256 * 1024, 64 * 1024
FILE_BYTES = 10 * 1024 * 1024
FLOOD_S = 3


class Log(unittest.TestCase):
    def test_the_tip_below_the_surface_is_logged_once_per_crossing(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            drive(line, monitor, E=449, D=-625)
            self.assertNotIn("below_surface", xr3.log())
            for crossing in 1, 2:
                drive(line, monitor, E=150)
                xr3.wait_log("cell @[0-9]+: below_surface: ", crossing)
                drive(line, monitor, E=-150)
            self.assertEqual(2, xr3.log().count("below_surface"))

    def test_a_stall_names_the_command_that_ends_it(self):
        with Server() as xr3, xr3.monitor() as monitor, xr3.line() as line:
            for _ in range(3):
                line.send("E-120\r")
                monitor.settle(after=line)
            self.assertIn("A$", xr3.wait_log("protected_region: .*"))

    def test_control_characters_in_names_are_escaped(self):
        with Server() as xr3, xr3.monitor() as monitor:
            monitor.call("block_add", name="x\n12:00:00.000 \x1b[31m\x9b\x00é", size_mm=[9, 9, 9], xyz_mm=[300, 0, 5], color=1)
            line = xr3.wait_log("block_add x.*")
            self.assertTrue(line.endswith(r"block_add x\x0a12:00:00.000 \x1b[31m\xc2\x9b\x00é" "\n"), line)

    def test_characters_that_change_the_direction_of_text_are_escaped(self):
        with Server() as xr3, xr3.monitor() as monitor:
            monitor.call("block_add", name="a\u202e\u2066b\u200f", size_mm=[9, 9, 9], xyz_mm=[300, 0, 5], color=1)
            line = xr3.wait_log("block_add a.*")
            self.assertTrue(line.endswith(r"block_add a\xe2\x80\xae\xe2\x81\xa6b\xe2\x80\x8f" "\n"), line)

    def test_a_flood_of_messages_is_cut_and_counted(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "xr3.log")
            # The limit of warnings counts simulated seconds, of which there are many here.
            with Server("--log-file", path, clock="real:100000") as xr3:
                sock = connect(xr3.robot_port)
                began = time.monotonic()
                while time.monotonic() < began + FLOOD_S:
                    sock.sendall(b"zE+500\r" * 2000)
                sock.close()
                text, seconds = path.read_text(), time.monotonic() - began
        self.assertRegex(text, r"warning suppressed [1-9]\d* messages\n")
        self.assertGreater(len(text), BURST)
        self.assertLess(len(text), BURST + (seconds + 1) * BYTES_A_SECOND)

    def test_a_symbolic_link_is_not_followed(self):
        with tempfile.TemporaryDirectory() as folder:
            link, target = pathlib.Path(folder, "xr3.log"), pathlib.Path(folder, "target")
            link.symlink_to(target)
            done = run_xr3("serve", "--robot-port", 0, "--monitor-port", 0, "--log-file", link)
            self.assertEqual(2, done.returncode)
            self.assertIn(f"{link}: the log cannot be written: it is a symbolic link", done.stderr)
            self.assertFalse(target.exists())

    def test_a_full_log_file_gets_a_number(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "xr3.log")
            path.write_bytes(b"x" * FILE_BYTES)
            for number in range(1, 5):
                pathlib.Path(folder, f"xr3.log.{number}").write_text(f"file {number}", encoding="ascii")
            with Server("--log-file", path) as xr3:
                xr3.line().ask("E?")
            self.assertEqual({"xr3.log", *(f"xr3.log.{number}" for number in range(1, 5))}, set(os.listdir(folder)))
            self.assertIn("line 1 opened", path.read_text(encoding="utf-8"))
            self.assertEqual(FILE_BYTES, pathlib.Path(folder, "xr3.log.1").stat().st_size)
            for number in range(2, 5):
                self.assertEqual(f"file {number - 1}", pathlib.Path(folder, f"xr3.log.{number}").read_text("ascii"))

    def test_a_log_file_that_cannot_be_written_is_refused(self):
        with tempfile.NamedTemporaryFile() as file:  # no folder
            done = run_xr3("serve", "--log-file", f"{file.name}/xr3.log")
            self.assertEqual(2, done.returncode)
            self.assertIn(f"{file.name}/xr3.log: the log cannot be written", done.stderr)


if __name__ == "__main__":
    unittest.main()
