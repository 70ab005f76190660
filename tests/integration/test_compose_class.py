"""docker/compose.class.yml: with its variables the server of this build has thirty robots, whose files are in the folder of the
class. `./test --images` tests the rest."""
# labels: full

import json
import pathlib
import re
import tempfile
import unittest

from support import ROOT, Server

FILE = pathlib.Path(ROOT, "docker", "compose.class.yml")
TOKEN = "a token of the tests"


class Class(unittest.TestCase):
    def test_the_variables_start_a_class_in_its_folder(self):
        text = FILE.read_text(encoding="utf-8")
        variables = dict(re.findall(r'^      (XR3_\w+): "?([^"\s]*)"?', text, re.MULTILINE))
        with tempfile.TemporaryDirectory() as folder:
            environment = {name: value.replace("/class", folder) for name, value in variables.items() if not value.startswith("$")}
            token = pathlib.Path(folder, "token")
            token.write_text(TOKEN, encoding="ascii")
            token.chmod(0o600)
            with Server(clock="real", environment=environment) as xr3, xr3.monitor() as monitor:
                cells = json.loads(pathlib.Path(folder, "ports.json").read_text(encoding="ascii"))["cells"]
                self.assertEqual(30, len({cell["token"] for cell in cells}))
                self.assertEqual("none", monitor.hello["access"])
                monitor.request("auth", token=TOKEN)
                self.assertEqual([cell["name"] for cell in cells], monitor.read()["cells"])
            self.assertEqual(30, len(list(pathlib.Path(folder, "recordings").rglob("*.xr3rec"))))

    def test_the_ports_are_those_of_the_robots(self):
        self.assertIn(":9701-9730:9701-9730\"", FILE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
