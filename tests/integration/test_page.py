"""The browser page in real Chromium, in short: a move on the robot port shows, and the console and jogging work.
test_viewer.py runs all tests of tests/web/viewer_test.mjs."""

import unittest

from page_tests import needs_chromium, run_page_tests


@needs_chromium
class Page(unittest.TestCase):
    def test_motion_console_and_jogging(self):
        run_page_tests(self, "viewer_test.mjs", "a move sent on the robot port|a button moves the arm", passed=2)


if __name__ == "__main__":
    unittest.main()
