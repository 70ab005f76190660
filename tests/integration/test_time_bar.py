"""The time bar of the browser page without a browser: its requests and its axis. test_time_bar_history.py runs the page
in real Chromium with the history of a server, soak_viewer.py with a past that a test plays."""

import os
import shutil
import subprocess
import unittest

from support import ROOT

REWIND = os.path.join(ROOT, "tests", "web", "rewind")


class TimeBar(unittest.TestCase):
    def test_requests_and_axis(self):
        self.assertTrue(shutil.which("node"), "node is not installed (scripts/setup test)")
        tests = [os.path.join(REWIND, f"{name}_test.mjs") for name in ("axis", "past")]
        run = subprocess.run(["node", "--test", *tests], capture_output=True, text=True, timeout=60,
                             check=False, cwd=ROOT)
        self.assertEqual(0, run.returncode, run.stdout[-6000:] + run.stderr[-3000:])


if __name__ == "__main__":
    unittest.main()
