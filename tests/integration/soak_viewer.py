"""Tests of the browser page in real Chromium with Playwright: runs every *_test.mjs in tests/web against this xr3."""

import glob
import os
import subprocess
import unittest

from support import ROOT


class Viewer(unittest.TestCase):
    def test_every_page_test(self):
        tests = sorted(glob.glob(os.path.join(ROOT, "tests", "web", "**", "*_test.mjs"), recursive=True))
        run = subprocess.run(["node", "--test", "--test-concurrency=1", "--test-reporter=spec", *tests],
                             timeout=1500, check=False, cwd=ROOT)
        self.assertEqual(0, run.returncode)


if __name__ == "__main__":
    unittest.main()
