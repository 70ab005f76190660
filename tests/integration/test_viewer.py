"""The browser page in real Chromium with Playwright: runs tests/web/viewer_test.mjs against this xr3. The tests
of the page's parts take minutes and are run by soak_viewer.py."""
# labels: serial

import os
import shutil
import subprocess
import unittest

from browser import MISSING
from support import ROOT

SCRIPTS = os.path.join(ROOT, "tests", "web")
PLAYWRIGHT = os.path.join(ROOT, "clients", "web", "node_modules", "playwright-core")


@unittest.skipUnless(os.path.exists("/usr/bin/chromium"), MISSING)  # the path that tests/web uses
class Viewer(unittest.TestCase):
    def test_in_chromium(self):
        self.assertTrue(shutil.which("node"), "node is not installed (scripts/setup test)")
        self.assertTrue(os.path.isdir(PLAYWRIGHT), "run scripts/viewer first: it fetches Playwright")
        run = subprocess.run(["node", "--test", "--test-concurrency=1", "--test-reporter=spec",
                              os.path.join(SCRIPTS, "viewer_test.mjs")],
                             capture_output=True, text=True, timeout=280, check=False, cwd=ROOT)
        print(run.stdout[-6000:] if run.returncode else run.stdout[-1500:])
        self.assertEqual(0, run.returncode, run.stderr[-3000:])


if __name__ == "__main__":
    unittest.main()
