"""The time bar of the browser page with the history of this xr3: runs some tests of tests/web/rewind/rewind_test.mjs in
real Chromium. soak_viewer.py runs them all."""
# labels: serial

import os
import shutil
import subprocess
import unittest

from browser import MISSING
from support import ROOT, Server

SCRIPTS = os.path.join(ROOT, "tests", "web", "rewind")
PATTERN = "a moment of the past|continue from here|goes on as a robot"


@unittest.skipUnless(os.path.exists("/usr/bin/chromium"), MISSING)  # the path that tests/web uses
class TimeBarHistory(unittest.TestCase):
    def test_in_chromium(self):
        self.assertTrue(shutil.which("node"), "node is not installed (scripts/setup test)")
        with Server() as xr3, xr3.monitor() as monitor:
            if "history" not in monitor.hello["calls"]:
                self.skipTest("this server has no call history")
        run = subprocess.run(["node", "--test", "--test-concurrency=1", "--test-reporter=spec",
                              f"--test-name-pattern={PATTERN}", os.path.join(SCRIPTS, "rewind_test.mjs")],
                             capture_output=True, text=True, timeout=280, check=False, cwd=ROOT)
        print(run.stdout[-6000:] if run.returncode else run.stdout[-1500:])
        self.assertEqual(0, run.returncode, run.stderr[-3000:])
        self.assertIn("pass 3", run.stdout)


if __name__ == "__main__":
    unittest.main()
