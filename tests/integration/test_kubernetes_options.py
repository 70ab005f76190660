"""deploy/kubernetes: the server of this build accepts the options of the manifests. `./test --images` tests
the rest."""

import pathlib
import re
import tempfile
import unittest

from support import ROOT, Server, run_xr3

FOLDER = pathlib.Path(ROOT, "deploy", "kubernetes")
WORKLOADS = (FOLDER / "class" / "deployment.yaml", FOLDER / "departments" / "statefulset.yaml")
TOKEN = "a token of the tests"


class Options(unittest.TestCase):
    def test_each_file_starts_a_server(self):
        files = sorted(FOLDER.glob("*/*.toml"))
        self.assertEqual(4, len(files))
        for path in files:
            with self.subTest(path.name), tempfile.TemporaryDirectory() as folder:
                token = pathlib.Path(folder, "token")
                token.write_text(TOKEN, encoding="utf-8")
                token.chmod(0o440)
                with Server("--config", str(path), "--token-file", str(token), clock="real") as xr3:
                    with xr3.monitor() as monitor:
                        self.assertEqual("read", monitor.hello["access"])
                        self.assertEqual("result", monitor.request("auth", token=TOKEN)["op"])
                    self.assertNotIn("warn", xr3.log())

    def test_arguments_are_known(self):
        known = set(re.findall(r"--[\w-]+", run_xr3("serve", "--help").stdout))
        for path in WORKLOADS:
            arguments = re.findall(r"^ +- (--[\w-]+)=", path.read_text(encoding="utf-8"), re.MULTILINE)
            with self.subTest(path.name):
                self.assertGreater(len(arguments), 1)
                self.assertLessEqual(set(arguments), known)

    def test_the_ports_are_the_defaults(self):
        """Also in the probes, which have no arguments."""
        for path in WORKLOADS:
            text = path.read_text(encoding="utf-8")
            with self.subTest(path.name):
                self.assertEqual(["9600", "9601"], re.findall(r"containerPort: (\d+)", text))
                self.assertEqual(2, text.count("command: [/usr/bin/xr3, healthcheck]"))


if __name__ == "__main__":
    unittest.main()
