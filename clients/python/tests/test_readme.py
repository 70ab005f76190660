"""The example of the package in README.md runs as printed."""

import contextlib
import io
import os
import re
import unittest
from pathlib import Path
from unittest import mock

from context import Server

DATA = Path(os.environ.get("XR3_ROOT", Path(__file__).resolve().parents[3])) / "data"
README = Path(__file__).resolve().parent.parent / "README.md"


class Readme(unittest.TestCase):
    def test_the_package_by_example(self):
        code = re.search(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.S).group(1)
        printed = io.StringIO()
        with Server("--clock", "real:500") as server, mock.patch("xr3.robot.POLL_S", 0.001), \
                mock.patch.dict(os.environ, {"XR3_HOST": "", "XR3_PORT": str(server.robot_port)}), \
                contextlib.redirect_stdout(printed):
            code = code.replace("../../data", str(DATA))
            exec(code.replace("9601", str(server.monitor_port)), {})  # pylint: disable=exec-used
        self.assertIn("[399.9", printed.getvalue())
        self.assertIn("'E': 449", printed.getvalue())
        self.assertIn("(2.0, 2.0) 0.0\n", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
