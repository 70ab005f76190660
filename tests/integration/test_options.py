"""Options of `xr3 serve` from the environment and from a configuration file, with a real process."""

import os
import pathlib
import tempfile
import unittest

from support import Server, run_xr3

TOKEN = "a token of no meaning"


def serve(*arguments, **variables):
    return run_xr3("serve", *arguments, env={**os.environ, **variables})


class Options(unittest.TestCase):
    def refused(self, begins, *arguments, **variables):
        done = serve(*arguments, **variables)
        self.assertEqual((2, ""), (done.returncode, done.stdout), done.stderr)
        self.assertRegex(done.stderr, rf"\Axr3: {begins}[^\n]+\n\Z")
        self.assertNotIn(TOKEN, done.stderr)


class Environment(Options):
    def test_sets_options_without_arguments(self):
        environment = {"XR3_ROBOT": "adept-one", "XR3_COMPAT": "mark3", "XR3_CLOCK": "real", "XR3_WORKCELL": ""}
        with Server(environment=environment) as xr3, xr3.monitor() as monitor:
            self.assertEqual(("Adept One", "mark3"), (monitor.hello["robot"]["name"], monitor.hello["compat"]))
            self.assertEqual("manual", monitor.hello["clock"]["mode"], "an argument takes precedence")

    def test_a_token_file_and_private(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "token")
            file.write_text(TOKEN, encoding="ascii")
            environment = {"XR3_TOKEN_FILE": str(file), "XR3_PRIVATE": "yes"}
            with Server(environment=environment) as xr3, xr3.monitor() as monitor:
                self.assertEqual("none", monitor.hello["access"])
                monitor.request("auth", token=TOKEN)
            with Server("--token", "auto", "--port-file", pathlib.Path(folder, "ports"), environment=environment):
                self.assertIn('"token"', pathlib.Path(folder, "ports").read_text(encoding="ascii"))

    def test_errors_name_the_variable(self):
        self.refused("XR3_ROBOT: there is no robot named r2d2; use one of: adept-one", XR3_ROBOT="r2d2")
        self.refused("XR3_WORKCELL: .*absent.json", XR3_WORKCELL="/absent.json")
        self.refused("XR3_TOKEN_FILE: /absent", XR3_TOKEN_FILE="/absent")
        self.refused("XR3_PORT_FILE: /absent/ports: ", "--robot-port", 0, "--monitor-port", 0,
                     XR3_PORT_FILE="/absent/ports")
        self.refused(r"XR3_LISTEN 0\.0\.0\.0 accepts other machines", XR3_LISTEN="0.0.0.0", XR3_TOKEN="")

    def test_help_names_the_variables(self):
        done = serve("--help")
        for option in "ROBOT", "WORKCELL", "LISTEN", "ROBOT_PORT", "MONITOR_PORT", "COMPAT", "CLOCK", "MAX_LINES", \
                "PORT_FILE", "LOG_LEVEL", "TOKEN_FILE", "PRIVATE", "ALLOW_HOST", "ALLOW_ORIGIN", "ALLOW_FRAME", "INSECURE", "CONFIG":
            self.assertIn(f"(Env:XR3_{option})", done.stdout)


class Config(Options):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, text):
        path = self.folder / "lab.toml"
        path.write_text(text, encoding="utf-8")
        return path

    def test_arguments_and_environment_override_the_file(self):
        path = self.file('robot = "adept-one"\nclock = "real:9"\ncompat = "mark3"\nlog-level = "debug"\n')
        for arguments, environment in [(["--config", path], {}), ([], {"XR3_CONFIG": str(path)})]:
            environment["XR3_COMPAT"] = "paper"
            with Server(*arguments, environment=environment) as xr3, xr3.monitor() as monitor:
                self.assertEqual("Adept One", monitor.hello["robot"]["name"])
                self.assertEqual("paper", monitor.hello["compat"], "the environment takes precedence")
                self.assertEqual("manual", monitor.hello["clock"]["mode"], "an argument takes precedence")

    def test_a_token_file(self):
        token = self.folder / "token"
        token.write_text(TOKEN, encoding="ascii")
        path = self.file(f"private = true\ntoken-file = '{token}'")
        with Server("--config", path) as xr3, xr3.monitor() as monitor:
            self.assertEqual("none", monitor.hello["access"])
            monitor.request("auth", token=TOKEN)

    def test_the_server_and_its_healthcheck_share_a_file(self):
        with Server() as free:
            port = free.monitor_port
        path = self.file(f"robot = 'adept-one'\nlisten = '127.9.9.9'\nrobot-port = 0\nmonitor-port = {port}\n")
        server = Server("--config", path)
        server.options = ["--config", str(path)]
        with server:
            done = run_xr3("healthcheck", "--config", path)
            self.assertEqual((0, ""), (done.returncode, done.stderr))
            done = run_xr3("healthcheck", env={**os.environ, "XR3_CONFIG": str(path)})
            self.assertEqual((0, ""), (done.returncode, done.stderr))

    def test_errors_name_file_and_line(self):
        for says, text in [("lab.toml:1: token: the token must not be", f'token = "{TOKEN}"'),
                           ("lab.toml:3: robot: there is no robot named r2d2", "# a\n\nrobot = 'r2d2'"),
                           ("lab.toml:1: token-file: /absent", "token-file = '/absent'")]:
            with self.subTest(text):
                self.refused(".*" + says, "--config", self.file(text))
        self.refused("XR3_CONFIG: .*absent.toml: cannot be read", XR3_CONFIG=str(self.folder / "absent.toml"))


if __name__ == "__main__":
    unittest.main()
