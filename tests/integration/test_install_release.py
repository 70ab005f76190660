"""The files that `cmake --install build/release` installs below /usr/local, and as a Debian package below /usr: the program with its
files, the Python package with its programs, and a completion of zsh where zsh looks."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, XR3, Server


class Install(unittest.TestCase):
    def install(self, prefix):
        """The folder that stands for / of a machine on which xr3 was installed with this prefix."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        subprocess.run(["cmake", "--install", pathlib.Path(XR3).parent, "--prefix", prefix], capture_output=True,
                       env={**os.environ, "DESTDIR": str(folder)}, timeout=DEADLINE_S, check=True)
        return folder

    def test_the_programs_of_python_run(self):
        folder = self.install("/usr") / "usr/share/xr3/python"
        names = {path.relative_to(folder).as_posix() for path in folder.rglob("*")}
        self.assertLessEqual({"xr3/__init__.py", "1_hello.py", "6_find_and_pick.py", "README.md"}, names)
        self.assertEqual([], [name for name in names if re.search("tests|pycache|pyproject", name)])
        with tempfile.TemporaryDirectory() as elsewhere, Server(clock="real") as xr3:
            program = "import xr3; print(xr3.__file__); print(xr3.connect().error('E'))"
            done = subprocess.run(["/usr/bin/python3", "-c", program], cwd=elsewhere, text=True, capture_output=True,
                                  env={**os.environ, "PYTHONPATH": str(folder), "XR3_PORT": str(xr3.robot_port)},
                                  timeout=DEADLINE_S, check=False)
        self.assertEqual([str(folder / "xr3/__init__.py"), "0"], done.stdout.split(), done.stderr)

    def test_zsh_finds_its_completion(self):
        for prefix, functions in (("/usr", "vendor-completions"), ("/usr/local", "site-functions")):
            with self.subTest(prefix):
                folder = self.install(prefix)
                found = [path.relative_to(folder).as_posix() for path in folder.rglob("_xr3")]
                self.assertEqual([f"{prefix[1:]}/share/zsh/{functions}/_xr3"], found)

    def test_the_files_of_the_service_name_what_is_installed(self):
        """References lead to manual pages, since the package has no docs."""
        folder = self.install("/usr")
        for name in "usr/lib/systemd/system/xr3.service", "etc/xr3/xr3.toml":
            text = (folder / name).read_text(encoding="utf-8")
            self.assertNotIn("docs/", text)
            for page in re.findall(r"man (xr3-\w+)", text):
                self.assertTrue((folder / f"usr/share/man/man1/{page}.1").exists(), page)
        self.assertIn("ExecStart=/usr/bin/xr3 ", (folder / "usr/lib/systemd/system/xr3.service").read_text("utf-8"))


if __name__ == "__main__":
    unittest.main()
