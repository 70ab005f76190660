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
            environment = {name: re.sub("^/class", folder, value) for name, value in variables.items() if not value.startswith("$")}
            names = [f"student-{number:02}" for number in range(1, 31)]
            pathlib.Path(folder, "class.csv").write_text("\n".join(["name", *names]), encoding="ascii")
            token = pathlib.Path(folder, "token")
            token.write_text(TOKEN, encoding="ascii")
            token.chmod(0o600)
            with Server(clock="real", environment=environment) as xr3, xr3.monitor() as monitor:
                tokens = json.loads(pathlib.Path(folder, "class.csv.tokens").read_text(encoding="ascii"))
                self.assertEqual(30, len(set(tokens.values())))
                self.assertEqual("none", monitor.hello["access"])
                monitor.request("auth", token=TOKEN)
                self.assertEqual(names, monitor.read()["cells"])
            self.assertEqual(30, len(list(pathlib.Path(folder, "recordings").rglob("*.xr3rec"))))

    def test_the_ports_are_those_of_the_robots(self):
        self.assertIn(":9701-9730:9701-9730\"", FILE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
