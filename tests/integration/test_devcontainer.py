"""The container for editors, .devcontainer: plain JSON, with the default ports of the program, on a Debian that CI tests."""

import json
import pathlib
import re
import unittest

from support import ROOT, run_xr3

CONTAINER = json.loads(pathlib.Path(ROOT, ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))


class Container(unittest.TestCase):
    def test_ports_are_those_of_the_program(self):
        ports = re.findall(r"--(?:robot|monitor)-port PORT\W+(\d+)", run_xr3("serve", "--help").stdout)
        self.assertEqual(2, len(ports))
        self.assertEqual(list(map(int, ports)), CONTAINER["forwardPorts"])
        self.assertEqual(set(ports), set(CONTAINER["portsAttributes"]))

    def test_it_builds_on_a_system_of_ci(self):
        ci = pathlib.Path(ROOT, ".github/workflows/ci.yml").read_text(encoding="utf-8")
        self.assertIn(CONTAINER["image"].partition(":")[2], ci)
        self.assertTrue(CONTAINER["postCreateCommand"].endswith("./run --build"))


if __name__ == "__main__":
    unittest.main()
