"""The browser page in real Chromium: runs tests/web/viewer_test.mjs against this xr3. The tests of the page's parts
take minutes and are run by soak_viewer.py."""
# labels: serial full

import unittest

from page_tests import needs_chromium, run_page_tests


@needs_chromium
class Viewer(unittest.TestCase):
    def test_in_chromium(self):
        run_page_tests(self, "viewer_test.mjs")


if __name__ == "__main__":
    unittest.main()
