"""docs/ci/frameworks.md: each project is made outside of the repository by the page's commands, and run by the real tools.
It passes; with a fault in the code under test it fails, with a message that names what is wrong."""
# labels: full

import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

from support import ROOT, XR3

PAGE = pathlib.Path(ROOT, "docs", "ci", "frameworks.md").read_text(encoding="utf-8")
JUNIT = pathlib.Path("/usr/share/java/junit-platform-console-standalone.jar")
TASK_S = 120


def section(title):
    """The part of the page below a heading."""
    return re.search(rf"^## {re.escape(title)}\n(.*?)(?=^## |\Z)", PAGE, re.MULTILINE | re.DOTALL)[1]


def fences(title):
    return re.findall(r"^```\w*\n(.*?)^```", section(title), re.MULTILINE | re.DOTALL)


class Frameworks(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "xr3").symlink_to(ROOT)
        # xr3 is in PATH, and its variables are those of a user: none.
        self.environment = {name: value for name, value in os.environ.items()
                            if not name.startswith("XR3") or name == "XR3_DATA"}
        self.environment["PATH"] = f"{pathlib.Path(XR3).parent}:{os.environ['PATH']}"

    def run_shell(self, text, **environment):
        done = subprocess.run(["bash", "-e"], input=text, cwd=self.folder, env={**self.environment, **environment}, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=TASK_S, check=False)
        return done.returncode, done.stdout

    def run_project(self, title, **environment):
        """Does what the first fence of a section shows; returns (exit code, output)."""
        return self.run_shell(fences(title)[0], **environment)

    def make_again(self, title, path, old, new):
        """Repeats the commands after the copy with a fault in a file; returns the output, which says that tests failed."""
        file = self.folder / path
        text = file.read_text(encoding="utf-8")
        self.assertEqual(1, text.count(old), text)
        file.write_text(text.replace(old, new), encoding="utf-8")
        code, printed = self.run_shell(re.sub("^cp .*\n", "", fences(title)[0], flags=re.MULTILINE))
        self.assertNotEqual(0, code, printed)
        return printed

    def assert_passes(self, title, counted):
        code, printed = self.run_project(title)
        self.assertEqual(0, code, printed)
        self.assertRegex(printed, counted)

    def test_ctest(self):
        self.assert_passes("CTest", "100% tests passed, 0 tests failed out of 1")
        printed = self.make_again("CTest", "ctest/turn.cpp", "140", "141")
        self.assertIn(fences("CTest")[2], printed)
        self.assertIn("1 - turn (Failed)", printed)

    def test_the_shown_lines_are_those_of_the_project(self):
        text = pathlib.Path(ROOT, "docs/ci/frameworks/ctest/CMakeLists.txt").read_text(encoding="utf-8")
        self.assertTrue(text.endswith(fences("CTest")[1]))

    def test_ctest_without_xr3_does_not_configure(self):
        code, printed = self.run_project("CTest", PATH="/usr/bin:/bin")
        if not shutil.which("xr3", path="/usr/bin:/bin"):
            self.assertNotEqual(0, code)
            self.assertRegex(printed, "Could not find XR3 using the following names: xr3")

    def test_googletest(self):
        self.assert_passes("GoogleTest", "100% tests passed, 0 tests failed out of 2")
        printed = self.make_again("GoogleTest", "googletest/jaws.hpp", 'robot.send("A+90\\r");', 'robot.send("A+20\\r");')
        self.assertIn("2 - Jaws.HoldTheBlock (Failed)", printed)
        self.assertRegex(printed, r"jaws_test.cpp:\d+: Failure\n")

    @unittest.skipUnless(JUNIT.exists() and shutil.which("javac"), "JUnit is not installed (Debian package junit5)")
    def test_junit(self):
        self.assert_passes("JUnit 5", r"2 tests successful")
        printed = self.make_again("JUnit 5", "junit/Turn.java", "counts))", "counts - 1))")
        self.assertIn("expected: <90> but was: <89>", printed)
        self.assertRegex(printed, "2 tests failed")
        printed = self.run_shell("cd junit; java -jar $JUNIT -cp build --scan-classpath", XR3="/usr/bin/false", JUNIT=str(JUNIT))[1]
        self.assertIn("xr3 serve has not started", printed)

    def test_node(self):
        self.assert_passes("node:test", "# pass 2|ℹ pass 2")
        printed = self.make_again("node:test", "node/turn.mjs", "counts }", "counts - 1 }")
        self.assertIn("89 !== 90", printed)
        code, printed = self.run_shell("cd node; node --test", XR3="/usr/bin/false")
        self.assertNotEqual(0, code)
        self.assertIn("xr3 serve has not started", printed)

    def test_a_killed_test_leaves_no_server(self):
        """The server has the standard error of the test, whose end the shell's caller waits for."""
        self.run_project("node:test")
        (self.folder / "killed.mjs").write_text("""
import { startServer } from "./node/robot_server.mjs";
console.log("robot", (await startServer()).port);
process.kill(process.pid, "SIGKILL");
""", encoding="utf-8")
        code, printed = self.run_shell("exec node killed.mjs")
        self.assertEqual(-signal.SIGKILL, code)
        self.assertRegex(printed, r"\Arobot \d+\n\Z")

    def test_shell(self):
        self.assert_passes("Plain shell", r"\Aok turn\n\Z")
        printed = self.make_again("Plain shell", "shell/turn.sh", "F 40", "F 41")
        self.assertRegex(printed, r"\AFAILED turn\n✗ joint F at 40 counts, within 0: it is at 41 counts\n")


if __name__ == "__main__":
    unittest.main()
