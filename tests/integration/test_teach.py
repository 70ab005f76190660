"""Programs that were taught on the page: runs some tests of tests/web/programs/teach_programs_test.mjs in real
Chromium against this xr3. soak_viewer.py runs them for every robot and profile."""
# labels: serial

import os
import shutil
import subprocess
import unittest

from browser import MISSING
from support import ROOT

SCRIPTS = os.path.join(ROOT, "tests", "web", "programs")
PATTERN = "rhino-xr3, paper|stalls"


@unittest.skipUnless(os.path.exists("/usr/bin/chromium"), MISSING)  # the path that tests/web uses
class Teach(unittest.TestCase):
    def test_exported_programs(self):
        for program in ("node", "cc"):
            self.assertTrue(shutil.which(program), f"{program} is not installed (scripts/setup test)")
        run = subprocess.run(["node", "--test", "--test-concurrency=1", "--test-reporter=spec",
                              f"--test-name-pattern={PATTERN}", os.path.join(SCRIPTS, "teach_programs_test.mjs")],
                             capture_output=True, text=True, timeout=280, check=False, cwd=ROOT)
        print(run.stdout[-6000:] if run.returncode else run.stdout[-1500:])
        self.assertEqual(0, run.returncode, run.stderr[-3000:])
        self.assertIn("pass 2", run.stdout)


if __name__ == "__main__":
    unittest.main()
