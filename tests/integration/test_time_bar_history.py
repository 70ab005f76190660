"""The time bar of the browser page with the history of this xr3: runs some tests of tests/web/rewind/rewind_test.mjs in
real Chromium. soak_viewer.py runs them all."""
# labels: serial full

import unittest

from page_tests import needs_chromium, run_page_tests


@needs_chromium
class TimeBarHistory(unittest.TestCase):
    def test_in_chromium(self):
        pattern = "a moment of the past|continue from here|goes on as a robot"
        run_page_tests(self, "rewind/rewind_test.mjs", pattern, passed=3)


if __name__ == "__main__":
    unittest.main()
