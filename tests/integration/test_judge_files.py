"""The files of the judge: what a program has printed and sent is for its owner only, and the temporary folder of a judge that was
killed is removed when the next one starts."""

import os
import pathlib
import signal
import stat
import subprocess
import unittest

from judge_modes import PYTHON, Root, User
from support import XR3

WAITS = "import os, time\nprint(os.path.dirname(os.environ['XR3_PTY']), flush=True)\ntime.sleep(100)\n"


class Files:
    def test_output_and_transcript_are_for_the_owner_only(self):
        self.judge("print('secret')\n", "--out", "out", umask=0)
        for name in "output.txt", "transcript.txt", "recording.xr3rec":
            self.assertEqual(0o600, stat.S_IMODE((self.folder / "out" / name).stat().st_mode), name)

    def test_the_folders_of_killed_judges_are_removed_and_no_others(self):
        self.write("tmp/file", "")
        self.write("waits.py", WAITS)
        environment = {**os.environ, "TMPDIR": str(self.folder / "tmp")}
        judges = [subprocess.Popen([*self.before, XR3, "exec", "--", PYTHON, "waits.py"], cwd=self.folder, env=environment,
                                   stdout=subprocess.PIPE, text=True) for _ in range(2)]
        folders = [pathlib.Path(judge.stdout.readline().strip()) for judge in judges]
        try:
            judges[0].kill()
            judges[0].wait()
            self.assertTrue(folders[0].is_dir())
            self.judge("", env=environment)
            self.assertEqual({folders[1].name, "file"}, {each.name for each in (self.folder / "tmp").iterdir()})
        finally:
            judges[1].send_signal(signal.SIGTERM)
            for judge in judges:
                judge.wait()
                judge.stdout.close()
        self.assertEqual(["file"], [each.name for each in (self.folder / "tmp").iterdir()])


class AsRoot(Files, Root, unittest.TestCase):
    pass


class AsUser(Files, User, unittest.TestCase):
    pass


if __name__ == "__main__":
    unittest.main()
