"""The unit tests of the Python client in clients/python, against the release build: they test the client, for which the
server is only what it talks to, and they compare its kinematics with those of `xr3 kin`."""

import os
import sys
import unittest
from pathlib import Path

TESTS = Path(os.environ["XR3_ROOT"]) / "clients" / "python" / "tests"


def load_tests(loader, _tests, _pattern):
    sys.path.insert(0, str(TESTS))
    return loader.discover(str(TESTS))


if __name__ == "__main__":
    unittest.main()
