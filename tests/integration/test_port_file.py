"""The port file: who can read it, symbolic links, and its end."""

import json
import os
import pathlib
import signal
import stat
import tempfile
import unittest

from support import Server


class PortFile(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name, "ports.json")

    def rights(self):
        return stat.S_IMODE(self.path.lstat().st_mode)

    def test_only_the_owner_can_read_a_token(self):
        with Server("--token", "auto", "--port-file", self.path):
            self.assertEqual(0o600, self.rights())
            self.assertIn("token", json.loads(self.path.read_text(encoding="ascii")))

    def test_everyone_can_read_ports(self):
        mask = os.umask(0o022)
        self.addCleanup(os.umask, mask)
        with Server("--port-file", self.path):
            self.assertEqual(0o644, self.rights())

    def test_is_removed_when_the_server_stops(self):
        for how in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(how), Server("--port-file", self.path) as xr3:
                self.assertTrue(self.path.exists())
                xr3.stop(how)
                self.assertEqual([], os.listdir(self.folder.name))

    def test_the_file_of_another_server_is_kept(self):
        with Server("--port-file", self.path) as first:
            with Server("--port-file", self.path) as second:
                first.stop()
                self.assertEqual(second.pid, json.loads(self.path.read_text(encoding="ascii"))["pid"])

    def test_a_symbolic_link_is_replaced_not_followed(self):
        other = pathlib.Path(self.folder.name, "other")
        other.write_text("precious", encoding="ascii")
        self.path.symlink_to(other)
        with Server("--port-file", self.path):
            self.assertFalse(self.path.is_symlink())
            self.assertEqual("precious", other.read_text(encoding="ascii"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
