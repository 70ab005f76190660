"""The long form of test_fairness_release.py: more and longer rounds."""

import unittest

import test_fairness_release
from test_fairness_release import Fairness  # noqa: F401 (unittest.main finds it here)

if __name__ == "__main__":
    test_fairness_release.ASKED, test_fairness_release.ROUNDS = 2000, 10
    unittest.main()
