"""The time bar of the browser page: its parts without a browser, and the page in real Chromium with a past that the test
plays. test_time_bar_history.py runs it with the history of a server."""
# labels: serial

import os
import shutil
import subprocess
import unittest

from browser import MISSING
from support import ROOT

SCRIPTS = os.path.join(ROOT, "tests", "web", "rewind")


class TimeBar(unittest.TestCase):
    def run_tests(self, *names):
        self.assertTrue(shutil.which("node"), "node is not installed (scripts/setup test)")
        run = subprocess.run(["node", "--test", "--test-concurrency=1", "--test-reporter=spec",
                              *(os.path.join(SCRIPTS, f"{name}_test.mjs") for name in names)],
                             capture_output=True, text=True, timeout=280, check=False, cwd=ROOT)
        print(run.stdout[-6000:] if run.returncode else run.stdout[-1500:])
        self.assertEqual(0, run.returncode, run.stderr[-3000:])

    def test_requests_and_axis(self):
        self.run_tests("axis", "past")

    @unittest.skipUnless(os.path.exists("/usr/bin/chromium"), MISSING)  # the path that tests/web uses
    def test_page_with_a_played_past(self):
        self.run_tests("looking", "taken_back")


if __name__ == "__main__":
    unittest.main()
