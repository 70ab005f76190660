"""Files that are no files: devices, pipes, a full disk, closed standard streams."""

import os
import pathlib
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, ROOT, XR3, Server, run_xr3

ROBOT = pathlib.Path(ROOT, "data/robots/rhino-xr3.json")


class StrangeFiles(unittest.TestCase):
    def test_an_endless_device_is_too_large(self):
        for arguments in (["check", "/dev/zero"], ["serve", "--robot", "/dev/zero"],
                          ["serve", "--config", "/dev/zero"]):
            with self.subTest(arguments):
                done = run_xr3(*arguments)
                self.assertEqual(2, done.returncode, done.stderr)
                self.assertIn("at most 4 MiB", done.stdout + done.stderr)

    def test_a_file_in_utf_16_is_told_so(self):
        text = ROBOT.read_text(encoding="utf-8")
        for name, encoding in (("robot.json", "utf-16"), ("robot.txt", "utf-16"), ("robot.json", "utf-16-be")):
            with self.subTest(name, encoding=encoding), tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder, name)
                file.write_text(text, encoding=encoding)
                done = run_xr3("check", file)
                self.assertEqual(2, done.returncode)
                self.assertEqual(f"{file}:1:1: found UTF-16; allowed: UTF-8\n", done.stderr)

    def test_a_pipe_without_a_writer_is_empty(self):
        with tempfile.TemporaryDirectory() as folder:
            fifo = pathlib.Path(folder, "fifo.json")
            os.mkfifo(fifo)
            self.assertEqual(2, run_xr3("check", fifo).returncode)

    def test_the_output_of_a_command_is_a_file(self):
        slow_output = 'exec "$0" check <(head -c 100 "$1"; sleep 0.1; tail -c +101 "$1")'
        done = subprocess.run(["bash", "-c", slow_output, XR3, ROBOT], capture_output=True, text=True,
                              timeout=DEADLINE_S, check=False)
        self.assertEqual((0, ""), (done.returncode, done.stderr))

    def test_lost_output_is_an_error(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([XR3, "check", ROBOT], stdout=full, stderr=subprocess.PIPE, text=True,
                                  timeout=DEADLINE_S, check=False)
        self.assertEqual(1, done.returncode)
        self.assertIn("standard output cannot be written", done.stderr)

    def test_closed_standard_streams_are_not_taken_by_sockets(self):
        command = ("sh", "-c", 'exec "$@" <&-', "sh", XR3, "serve")
        with Server(command=command) as xr3:
            self.assertEqual("/dev/null", os.readlink(f"/proc/{xr3.pid}/fd/0"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
