"""Programs that were taught on the page: runs some tests of tests/web/programs/teach_programs_test.mjs in real
Chromium against this xr3. soak_viewer.py runs them for every robot and profile."""
# labels: serial full

import shutil
import unittest

from page_tests import needs_chromium, run_page_tests


@needs_chromium
class Teach(unittest.TestCase):
    def test_exported_programs(self):
        self.assertTrue(shutil.which("cc"), "cc is not installed (scripts/setup test)")
        run_page_tests(self, "programs/teach_programs_test.mjs", "rhino-xr3, paper|stalls", passed=2)


if __name__ == "__main__":
    unittest.main()
