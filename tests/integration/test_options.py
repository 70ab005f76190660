"""Options of `xr3 serve` that are no arguments: what a real process makes of its environment."""

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
    def test_says_what_no_argument_says(self):
        environment = {"XR3_ROBOT": "adept-one", "XR3_COMPAT": "mark3", "XR3_CLOCK": "real", "XR3_WORKCELL": ""}
        with Server(environment=environment) as xr3, xr3.monitor() as monitor:
            self.assertEqual(("Adept One", "mark3"), (monitor.hello["robot"]["name"], monitor.hello["compat"]))
            self.assertEqual("manual", monitor.hello["clock"]["mode"], "an argument counts more")

    def test_a_token_file_and_privacy(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "token")
            file.write_text(TOKEN, encoding="ascii")
            environment = {"XR3_TOKEN_FILE": str(file), "XR3_PRIVATE": "yes"}
            with Server(environment=environment) as xr3, xr3.monitor() as monitor:
                self.assertEqual("read", monitor.hello["access"])
                monitor.request("auth", token=TOKEN)
            with Server("--token", "auto", "--port-file", pathlib.Path(folder, "ports"), environment=environment):
                self.assertIn('"token"', pathlib.Path(folder, "ports").read_text(encoding="ascii"))

    def test_what_is_wrong_is_said_with_the_name(self):
        self.refused("XR3_CLOCK: fast: a clock is", XR3_CLOCK="fast")
        self.refused("XR3_ROBOT: no robot is named r2d2; there are: adept-one", XR3_ROBOT="r2d2")
        self.refused("XR3_WORKCELL: .*absent.json", XR3_WORKCELL="/absent.json")
        self.refused("XR3_TOKEN_FILE: /absent", XR3_TOKEN_FILE="/absent")
        self.refused("XR3_PORT_FILE: /absent/ports: ", "--robot-port", 0, "--monitor-port", 0,
                     XR3_PORT_FILE="/absent/ports")
        self.refused(r"XR3_LISTEN 0\.0\.0\.0 lets other machines in", XR3_LISTEN="0.0.0.0", XR3_TOKEN="")

    def test_help_names_the_variables(self):
        done = serve("--help")
        for option in "ROBOT", "WORKCELL", "LISTEN", "ROBOT_PORT", "MONITOR_PORT", "COMPAT", "CLOCK", "MAX_LINES", \
                "PORT_FILE", "LOG_LEVEL", "TOKEN_FILE", "PRIVATE", "ALLOW_HOST", "ALLOW_ORIGIN", "INSECURE":
            self.assertIn(f"(Env:XR3_{option})", done.stdout)


if __name__ == "__main__":
    unittest.main()
