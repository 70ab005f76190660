"""The wheel and the source package that scripts/wheel makes of the files that `cmake --install` installs: the format, and their
life in a virtual environment. (tests/packages installs those of a release in bare systems.)"""
# labels: full

import base64
import email
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import tomllib
import unittest
import zipfile

from support import DEADLINE_S, ROOT, XR3, Server

INSTALL_S = 240.0
SECONDS = 1_764_000_000  # 2025-11-24 16:00:00 UTC
PROJECT = tomllib.loads(pathlib.Path(ROOT, "clients/python/pyproject.toml").read_text(encoding="utf-8"))["project"]
VERSION = re.search(r"^project\(xr3 VERSION (\S+)", pathlib.Path(ROOT, "CMakeLists.txt").read_text("utf-8"), re.M)[1]
WHEEL = f"xr3-{VERSION}-py3-none-manylinux_2_36_x86_64.whl"
SOURCE = f"xr3-{VERSION}.tar.gz"
DATA, INFO = f"xr3-{VERSION}.data", f"xr3-{VERSION}.dist-info"


def run(*command, timeout=DEADLINE_S, **variables):
    """Runs a command; returns its output, or raises with it."""
    done = subprocess.run([str(each) for each in command], text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=timeout, check=False, env={**os.environ, **variables})
    if done.returncode:
        raise AssertionError(f"exit code {done.returncode}: {command}\n{done.stdout}")
    return done.stdout


def make_archive(folder):
    """An archive as scripts/package makes it, but of the release build."""
    top = folder / "tree" / f"xr3-{VERSION}-linux-x86_64"
    run("cmake", "--install", pathlib.Path(XR3).parent, "--prefix", top)
    (top / "lib/xr3").mkdir()
    (top / "lib/xr3/libexample.so.1").write_bytes(b"a library")
    (top / "share/doc/xr3/licences").mkdir()
    (top / "share/doc/xr3/licences/zlib1g-dev").write_text("a licence")
    os.mkdir(folder / "out")
    run("tar", "-C", top.parent, f"--mtime=@{SECONDS}", "-czf", folder / "out" / f"{top.name}.tar.gz", top.name)
    return folder / "out"


def files_below(folder):
    return {path for path in folder.rglob("*") if not path.is_dir() and "__pycache__" not in path.parts}


class Made(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = make_archive(pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory())))
        run(sys.executable, f"{ROOT}/scripts/wheel", cls.folder, timeout=INSTALL_S)


class Format(Made):
    def setUp(self):
        self.wheel = self.enterContext(zipfile.ZipFile(self.folder / WHEEL))

    def test_each_file_is_in_the_record(self):
        lines = self.wheel.read(f"{INFO}/RECORD").decode().splitlines()
        self.assertEqual(sorted(self.wheel.namelist()), sorted(line.split(",")[0] for line in lines))
        self.assertEqual(f"{INFO}/RECORD,,", lines.pop())
        for line in lines:
            name, digest, size = line.split(",")
            content = self.wheel.read(name)
            sha256 = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
            self.assertEqual((f"sha256={sha256}", str(len(content))), (digest, size), name)

    def test_modes_and_times(self):
        for member in self.wheel.infolist():
            is_program = member.filename == f"{DATA}/scripts/xr3"
            self.assertEqual(0o100755 if is_program else 0o100644, member.external_attr >> 16, member.filename)
            self.assertEqual((2025, 11, 24, 16, 0, 0), member.date_time)

    def test_it_has_what_an_environment_needs(self):
        names = set(self.wheel.namelist())
        self.assertLessEqual(
            {"xr3/__init__.py", "xr3/py.typed", f"{DATA}/scripts/xr3", f"{DATA}/data/lib/xr3/libexample.so.1",
             f"{DATA}/data/share/xr3/robots/rhino-xr3.json", f"{DATA}/data/share/xr3/exercises/robot.h",
             f"{INFO}/licenses/LICENSE", f"{INFO}/licenses/zlib1g-dev"}, names)
        folders = {"/".join(name.split("/")[:-1]) for name in names}
        self.assertFalse([each for each in folders if re.search(r"/man|/systemd|/share/xr3/python|/share/doc|pycache", each)])

    def test_it_says_what_the_project_says(self):
        said = email.message_from_bytes(self.wheel.read(f"{INFO}/METADATA"))
        self.assertEqual(["2.1", "xr3", VERSION, PROJECT["description"], "MIT", PROJECT["requires-python"]],
                         [said[name] for name in ("Metadata-Version", "Name", "Version", "Summary", "License",
                                                  "Requires-Python")])
        self.assertIn("Framework :: Pytest", said.get_all("Classifier"))
        self.assertEqual("[pytest11]\nxr3 = xr3.pytest_plugin\n", self.wheel.read(f"{INFO}/entry_points.txt").decode())
        self.assertIn("\nTag: py3-none-manylinux_2_36_x86_64\n", self.wheel.read(f"{INFO}/WHEEL").decode())

    def test_source_is_the_python_package(self):
        with tarfile.open(self.folder / SOURCE) as source:
            names = {member.name.removeprefix(f"xr3-{VERSION}/") for member in source}
            self.assertEqual({(SECONDS, 0, 0o644)}, {(each.mtime, each.uid, each.mode) for each in source})
        self.assertLessEqual({"PKG-INFO", "LICENSE", "pyproject.toml", "README.md", "1_hello.py", "xr3/robot.py"}, names)

    def test_another_run_gives_the_same_bytes(self):
        before = {name: (self.folder / name).read_bytes() for name in (WHEEL, SOURCE)}
        run(sys.executable, f"{ROOT}/scripts/wheel", self.folder, timeout=INSTALL_S, TZ="Asia/Tokyo", LC_ALL="C")
        self.assertEqual(before, {name: (self.folder / name).read_bytes() for name in (WHEEL, SOURCE)})

    def test_a_folder_without_archives_is_an_error(self):
        with tempfile.TemporaryDirectory() as empty, self.assertRaisesRegex(AssertionError, "scripts/package makes it"):
            run(sys.executable, f"{ROOT}/scripts/wheel", empty)


class Installed(Made):
    def setUp(self):
        self.robots = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()), "robots")
        run("/usr/bin/python3", "-m", "venv", self.robots, timeout=INSTALL_S)

    def pip(self, *arguments):
        return run(self.robots / "bin/pip", "--no-cache-dir", *arguments, timeout=INSTALL_S, PIP_NO_INDEX="1",
                   PIP_DISABLE_PIP_VERSION_CHECK="1", PIP_NO_BUILD_ISOLATION="0",  # pip's spelling of "no isolation"
                   PYTHONPATH="/usr/lib/python3/dist-packages")

    def where_the_package_is(self):
        return run(self.robots / "bin/python", "-I", "-c", "import xr3; print(xr3.__file__)")

    def test_wheel(self):
        before = files_below(self.robots)
        self.pip("install", self.folder / WHEEL)
        self.assertIn(str(self.robots), self.where_the_package_is())
        with Server("--robot", "adept-one", command=(self.robots / "bin/xr3", "serve")) as xr3, xr3.line() as line:
            self.assertEqual(ord(" "), line.ask(b"E?"))
        self.pip("uninstall", "--yes", "xr3")
        self.assertEqual(before, files_below(self.robots))

    def test_source(self):
        self.pip("install", self.folder / SOURCE)
        self.assertIn(str(self.robots), self.where_the_package_is())
        self.assertFalse((self.robots / "bin/xr3").exists())


if __name__ == "__main__":
    unittest.main()
