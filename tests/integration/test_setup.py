"""The script scripts/setup: the packages that it chooses on each system. dpkg-query, apt-cache and apt-get are
stubs with lists of the installed and the offered packages."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, ROOT

SETUP = pathlib.Path(ROOT, "scripts", "setup")
OF_CLANG = {"clang-%", "clang-format-%", "clang-tidy-%", "libclang-rt-%-dev", "llvm-%"}
DEBIAN_12 = ["libboost1.74-dev", "libboost1.81-dev", 13, 14, 15, 16, 19]  # a number is a version of clang
DEBIAN_13 = ["libboost1.83-dev", "libboost1.88-dev", 17, 18, 19]
TOO_OLD = ["libboost1.74-dev", 13, 14, 15]

DPKG_QUERY = 'sed "s/^/ii  /" "$STUBS/installed"'
APT_CACHE = 'shift 2; printf "%s\\n" "$@" | grep -Fxf "$STUBS/offered" | sed "s/^/Package: /"; exit 100'
APT_GET = 'while [ "$1" != update ] && [ "$1" != install ]; do shift; done; echo "$*" >>"$STUBS/done"'


def versioned(packages):
    """The names of the packages; a number represents the packages of that version of clang."""
    names = {package for package in packages if isinstance(package, str)}
    return names | {name.replace("%", str(version)) for version in packages if isinstance(version, int)
                    for name in OF_CLANG}


def is_of_choice(name):
    return name.startswith("libboost") or any(re.fullmatch(like.replace("%", r"\d+"), name) for like in OF_CLANG)


class Setup(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.stub("dpkg-query", DPKG_QUERY)
        self.stub("apt-cache", APT_CACHE)
        self.stub("apt-get", APT_GET)
        self.stub("id", "echo 0")
        for name in "npm", "node", "docker":
            self.stub(name, "")
        # The packages that have the same name on every system.
        self.usual = set(self.names_in_setup()) - {name for name in self.names_in_setup() if is_of_choice(name)}

    def stub(self, name, text):
        path = self.folder / name
        path.write_text(f"#!/bin/sh\n{text}\n", encoding="ascii")
        path.chmod(0o755)

    @staticmethod
    def names_in_setup():
        return re.findall(r"[a-z][a-z0-9.+-]+", SETUP.read_text(encoding="utf-8"))

    def setup_with(self, installed, offered, *groups):
        """Runs the script; returns its exit code, its messages, and the packages that it installed."""
        for name, packages in ("installed", installed), ("offered", offered):
            (self.folder / name).write_text("\n".join(sorted(packages)) + "\n", encoding="ascii")
        (self.folder / "done").write_text("", encoding="ascii")
        path = f"{self.folder}:{os.environ['PATH']}"
        done = subprocess.run([SETUP, *groups], env={**os.environ, "PATH": path, "STUBS": str(self.folder)},
                              capture_output=True, text=True, timeout=DEADLINE_S, check=False)
        self.assertEqual("", done.stdout)
        commands = (self.folder / "done").read_text(encoding="ascii").split()
        packages = commands[commands.index("install"):][1:] if "install" in commands else []
        return done.returncode, done.stderr, [name for name in packages if not name.startswith("-")]

    def chosen(self, installed, system, *groups):
        """The installed packages whose names differ between systems."""
        code, said, packages = self.setup_with(installed, self.usual | versioned(system), *groups)
        self.assertEqual(0, code, said)
        return {name for name in packages if is_of_choice(name)}

    def test_debian_12_has_clang_16_and_boost_1_81(self):
        self.assertEqual({"libboost1.81-dev"}, self.chosen([], DEBIAN_12, "build"))
        self.assertEqual({"libboost1.81-dev"} | versioned([16]), self.chosen([], DEBIAN_12, "lint", "coverage"))

    def test_debian_13_has_clang_19_and_boost_1_83(self):
        self.assertEqual({"libboost1.83-dev"}, self.chosen([], DEBIAN_13, "build"))
        self.assertEqual({"libboost1.83-dev"} | versioned([19]), self.chosen([], DEBIAN_13, "lint", "coverage"))

    def test_an_installed_package_is_preferred(self):
        installed = ["libboost1.88-dev", "clang-18"]
        self.assertEqual({"libclang-rt-18-dev"}, self.chosen(installed, DEBIAN_13, "test"))

    def test_complete_systems_are_not_queried(self):
        self.stub("apt-get", "exit 1")
        self.stub("apt-cache", "exit 1")
        for system in DEBIAN_12, DEBIAN_13:
            installed = self.usual | versioned(system)
            self.assertEqual((0, "", []), self.setup_with(installed, [], "test", "lint", "coverage"))

    def test_a_system_without_the_packages_is_an_error(self):
        code, said, packages = self.setup_with([], self.usual | versioned(TOO_OLD), "build")
        self.assertEqual((1, []), (code, packages))
        self.assertIn("this system does not offer these packages (a|b: one of them): libboost1.81-dev|", said)

    def test_presets_use_the_installed_compiler(self):
        versions = re.search(r"clang_versions='([\d ]+)'", SETUP.read_text(encoding="utf-8"))[1].split()
        toolchain = pathlib.Path(ROOT, "cmake", "clang.cmake").read_text(encoding="utf-8")
        names = re.search(r"NAMES\s+([^)]+)\)", toolchain)[1].split()
        self.assertEqual([*(f"clang++-{version}" for version in versions), "clang++"], names)


if __name__ == "__main__":
    unittest.main()
