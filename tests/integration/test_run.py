"""The script ./run: it passes its arguments to `xr3 serve` and adds none. The tests run it in a temporary
folder with stubs for packages and build, where build/release/xr3 is the executable under test."""
# labels: full

import json
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
        self.assertEqual((RHINO[0], "empty table"), self.started("--robot", robot))
        self.assertEqual(RHINO, self.started("--robot", robot, "--workcell", "rhino-xr3"))

    def calls(self, *arguments):
        """The commands that `./run ARGUMENTS` calls: packages, the build of the page, CMake."""
        log = self.folder / "calls"
        log.write_text("", encoding="ascii")
        for path in "scripts/setup", "scripts/viewer", "bin/cmake":
            (self.folder / path).write_text(f'#!/bin/sh\necho "${{0##*/}} $*" >>"{log}"\n', encoding="utf-8")
        done = self.run_to_end(*arguments)
        self.assertEqual((0, ""), (done.returncode, done.stdout), done.stderr)
        return log.read_text(encoding="utf-8").replace(str(self.folder), "").splitlines()

    def cache_the_page(self, folder):
        (self.folder / "build/release/CMakeCache.txt").write_text(
            f"XR3_WEB_DIST:PATH={self.folder}/{folder}\n", encoding="utf-8")

    def test_the_page_is_built_by_default(self):
        self.cache_the_page("clients/web/dist")
        self.assertEqual(["setup build", "viewer ", "cmake --build --preset release --target xr3"],
                         self.calls("--build"))

    def test_without_the_page_npm_is_not_needed(self):
        self.cache_the_page("clients/web/dist")
        configure = "cmake --preset release -D XR3_WEB_DIST:PATH=/build/no-page"
        build = "cmake --build --preset release --target xr3"
        self.assertEqual(["setup server", configure, build], self.calls("--build", "--no-page"))
        self.assertFalse((self.folder / "build/no-page").exists())
        self.cache_the_page("build/no-page")
        self.assertEqual(["setup server", build], self.calls("--build", "--no-page"))
        self.assertEqual("cmake --preset release -D XR3_WEB_DIST:PATH=/clients/web/dist", self.calls("--build")[2])

    def test_a_built_page_needs_no_npm(self):
        page = self.folder / "unpacked page"
        page.mkdir()
        (page / "index.html").touch()
        for argument in page, page.name:  # relative to the folder of the caller
            with self.subTest(argument):
                self.assertEqual(["setup server", "cmake --preset release -D XR3_WEB_DIST:PATH=/unpacked page",
                                  "cmake --build --preset release --target xr3"],
                                 self.calls("--build", "--page", argument))

    def test_a_folder_without_a_page_is_an_error(self):
        (self.folder / "empty").mkdir()
        for arguments in ["--page"], ["--page", ""], ["--page", "empty"], ["--build", "--page", "missing"]:
            with self.subTest(arguments):
                done = self.run_to_end(*arguments)
                self.assertEqual((2, ""), (done.returncode, done.stdout))
                self.assertRegex(done.stderr, r"^run: --page FOLDER: '\w*' has no index.html, so .*\n$")

    def test_no_page_passes_the_other_arguments(self):
        self.assertEqual(ADEPT, self.started("--no-page", "--robot", "adept-one"))

    def test_the_preset_embeds_the_page_again(self):
        """So that a build by `./test` has the page after `./run --no-page`."""
        presets = json.loads(pathlib.Path(ROOT, "CMakePresets.json").read_text(encoding="utf-8"))
        release = next(preset for preset in presets["configurePresets"] if preset["name"] == "release")
        self.assertEqual({"type": "PATH", "value": "${sourceDir}/clients/web/dist"},
                         release["cacheVariables"]["XR3_WEB_DIST"])

    def test_the_commands_of_the_readme(self):
        readme = pathlib.Path(ROOT, "README.md").read_text(encoding="utf-8")
        commands = [shlex.split(found) for found in re.findall(r"`\./run ([^`]+)`", readme)]
        starts = [arguments for arguments in commands if "--build" not in arguments]
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
