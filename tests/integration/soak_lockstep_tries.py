"""The long form of test_lockstep_release.py: ten times as many tries."""

import unittest

import test_lockstep_release
from test_lockstep_release import LockstepTests  # noqa: F401 (unittest.main finds it here)

if __name__ == "__main__":
    test_lockstep_release.TRIES = {name: 10 * tries for name, tries in test_lockstep_release.TRIES.items()}
    unittest.main()
