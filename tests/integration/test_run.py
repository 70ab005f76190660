"""The script ./run: it passes its arguments to `xr3 serve` and adds none. The tests run it in a temporary
folder with stubs for packages and build, where build/release/xr3 is the executable under test."""

import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

from stub_checkout import StubCheckout
from support import DEADLINE_S, ROOT, Server

RHINO = ("Rhino XR-3", "Rhino XR-3 table")  # robot and workcell
ADEPT = ("Adept One", "Adept One table")


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.environment = StubCheckout(self.folder).environment

    def started(self, *arguments, **variables):
        """Starts `./run ARGUMENTS`; returns the names of the robot and the workcell."""
        server = Server(command=[self.folder / "run"], environment={**self.environment, **variables})
        server.options = list(map(str, arguments))
        with server as xr3, xr3.monitor() as monitor:
            model = monitor.look("model")
            return model["robot"]["name"], model["workcell"]["name"]

    def run_to_end(self, *arguments):
        return subprocess.run([self.folder / "run", *arguments], env=self.environment, cwd=self.folder,
                              capture_output=True, text=True, timeout=DEADLINE_S, check=False)

    def test_starts_the_rhino_by_default(self):
        self.assertEqual(RHINO, self.started())

    def test_arguments_select_the_robot(self):
        self.assertEqual(ADEPT, self.started("--robot", "adept-one"))
        self.assertEqual((ADEPT[0], RHINO[1]), self.started("--robot", "adept-one", "--workcell", "rhino-xr3"))

    def test_the_environment_selects_the_robot(self):
        self.assertEqual(ADEPT, self.started(XR3_ROBOT="adept-one"))
        self.assertEqual(RHINO, self.started("--robot", "rhino-xr3", XR3_ROBOT="adept-one"))

    def test_a_config_file_selects_the_robot(self):
        config = self.folder / "lab.toml"
        config.write_text('robot = "adept-one"\n', encoding="ascii")
        self.assertEqual(ADEPT, self.started("--config", config))
        self.assertEqual(ADEPT, self.started(XR3_CONFIG=str(config)))

    def test_a_robot_without_a_workcell_of_the_same_name(self):
        robot = self.folder / "my-arm.json"
        shutil.copy(pathlib.Path(ROOT, "data", "robots", "rhino-xr3.json"), robot)
        done = self.run_to_end("--robot", robot)
        self.assertEqual((2, ""), (done.returncode, done.stdout))
        self.assertTrue(done.stderr.endswith(
            "xr3: there is no workcell named after the robot my-arm; name one with --workcell\n"), done.stderr)
        self.assertEqual(RHINO, self.started("--robot", robot, "--workcell", "rhino-xr3"))

    def test_the_commands_of_the_readme(self):
        readme = pathlib.Path(ROOT, "README.md").read_text(encoding="utf-8")
        commands = [shlex.split(found) for found in re.findall(r"`\./run ([^`]+)`", readme)]
        starts = [arguments for arguments in commands if arguments != ["--build"]]
        self.assertGreater(len(starts), 2)
        for arguments in starts:
            with self.subTest(arguments):
                self.assertEqual(ADEPT if "adept-one" in arguments else RHINO, self.started(*arguments))

    def test_build_does_not_start_the_server(self):
        done = self.run_to_end("--build")
        self.assertEqual((0, ""), (done.returncode, done.stdout))
        self.assertNotIn("serve", done.stderr)


if __name__ == "__main__":
    unittest.main()
