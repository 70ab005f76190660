"""The script scripts/setup: the packages that it chooses on each system. dpkg-query, apt-cache, apt-get, rpm and dnf
are stubs with lists of the installed and the offered packages; the name of the system comes from OS_RELEASE."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, ROOT

SETUP = pathlib.Path(ROOT, "scripts", "setup")
OF_CLANG = {"clang-%", "clang-format-%", "clang-tidy-%", "libclang-rt-%-dev", "llvm-%"}
DEBIAN_12 = ["libboost1.74-dev", "libboost1.81-dev", 13, 14, 15, 16, 19]  # a number is a version of clang
DEBIAN_13 = ["libboost1.83-dev", "libboost1.88-dev", 17, 18, 19]
UBUNTU_22 = ["libboost1.74-dev", 13, 14, 15]
UBUNTU_24 = ["libboost1.74-dev", "libboost1.83-dev", 14, 15, 16, 17, 18, 19, 20]
UBUNTU_26 = ["libboost1.83-dev", "libboost1.88-dev", "libboost1.90-dev", 17, 18, 19, 20, 21]
DEBIAN = 'PRETTY_NAME="Debian GNU/Linux 12 (bookworm)"\nID=debian\n'
UBUNTU = 'PRETTY_NAME="Ubuntu {}"\nID=ubuntu\nID_LIKE=debian\n'
FEDORA = 'PRETTY_NAME="Fedora Linux 43 (Workstation Edition)"\nID=fedora\n'
# For ./run on Fedora, NAME or NAME VERSION. Since Fedora 44, the names of Node's packages contain a version.
FEDORA_SERVER = {"gcc-c++", "make", "cmake", "ninja-build", "ccache", "mold", "boost-devel", "eigen3-devel",
                 "spdlog-devel", "fmt-devel", "json-devel", "cli11-devel", "libpng-devel", "ncurses-devel",
                 "pkgconf-pkg-config", "nettle-devel", "libprometheus-cpp-devel"}
FEDORA_TEST = {"clang", "compiler-rt", "gtest-devel", "gmock-devel", "google-benchmark-devel", "python3",
               "python3-setuptools", "python3-wheel", "python3-jsonschema", "python3-fastjsonschema",
               "python3-websockets", "python3-pyte", "python3-pyserial", "python3-pyyaml", "telnet", "netcat", "curl", "bubblewrap",
               "chromium"}
FEDORA_43_NODE = {"nodejs", "nodejs-npm"}
FEDORA_44_NODE = {"nodejs24-bin", "nodejs24-npm-bin", "nodejs22-bin", "nodejs22-npm-bin"}
FEDORA_LINES = {"python3", "python3-fastjsonschema", "putty", "picocom", "minicom", "socat", "dosbox-staging", "nasm",
                "qemu-system-x86-core", "octave", "octave-instrument-control"}
FEDORA_LINT = {"clang", "clang-tools-extra", "ShellCheck"}

DPKG_QUERY = 'sed "s/^/ii  /" "$STUBS/installed"'
APT_CACHE = 'shift 2; printf "%s\\n" "$@" | grep -Fxf "$STUBS/offered" | sed "s/^/Package: /"; exit 100'
APT_GET = 'while [ "$1" != update ] && [ "$1" != install ]; do shift; done; echo "$*" >>"$STUBS/done"'
RPM = 'cat "$STUBS/installed"'
DNF = """
case "$*" in
  *repoquery*) for name; do grep "^$name " "$STUBS/offered"; done; exit 0 ;;
esac
while [ "$1" != install ]; do shift; done; echo "$*" >>"$STUBS/done"
"""


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
        self.stub("rpm", RPM)
        self.stub("dnf", DNF)
        self.stub("id", "echo 0")
        self.system = DEBIAN
        self.path = f"{self.folder}:{os.environ['PATH']}"
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
        (self.folder / "os-release").write_text(self.system, encoding="ascii")
        done = subprocess.run([SETUP, *groups], env={**os.environ, "PATH": self.path, "STUBS": str(self.folder),
                                                       "OS_RELEASE": str(self.folder / "os-release")},
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

    def test_ubuntu_24_and_26(self):
        for name, system, boost, clang in (("24.04.3 LTS", UBUNTU_24, "libboost1.83-dev", 16),
                                           ("26.04 LTS", UBUNTU_26, "libboost1.83-dev", 19)):
            with self.subTest(name):
                self.system = UBUNTU.format(name)
                self.assertEqual({boost}, self.chosen([], system, "build"))
                self.assertEqual({boost} | versioned([clang]), self.chosen([], system, "lint", "coverage"))

    def test_ubuntu_has_no_package_of_chromium(self):
        offered = self.usual | versioned(UBUNTU_24)
        self.assertIn("chromium", self.setup_with([], offered, "test")[2])
        self.system = UBUNTU.format("24.04.3 LTS")
        code, said, packages = self.setup_with([], offered - {"chromium"}, "test")
        self.assertEqual(0, code, said)
        self.assertIn("librapidcheck-dev", packages)

    def test_the_packages_of_the_site(self):
        """(Fedora's names: nobody has tried them.)"""
        expected = {"mkdocs", "mkdocs-material", "mkdocstrings", "mkdocstrings-python-handlers", "black", "python3",
                    "python3-fastjsonschema", "python3-markdown-it", "python3-websockets", "python3-yaml", "chromium"}
        code, said, packages = self.setup_with([], self.usual | versioned(DEBIAN_12), "docs")
        self.assertEqual((0, expected), (code, set(packages)), said)
        self.system = UBUNTU.format("24.04.3 LTS")
        self.assertEqual(expected - {"chromium"}, set(self.setup_with([], self.usual, "docs")[2]))
        fedora = {"mkdocs", "python3-mkdocs-material", "python3-mkdocstrings", "python3-mkdocstrings-python", "black",
                  "python3", "python3-fastjsonschema", "python3-markdown-it-py", "python3-pyyaml", "python3-websockets",
                  "chromium"}
        code, said, packages = self.fedora([], fedora, "docs")
        self.assertEqual((0, fedora), (code, set(packages)), said)

    def test_the_emulator_of_aarch64_has_two_names(self):
        names = {"qemu-user-static", "qemu-user"}
        for offered, expected in ((names, "qemu-user-static"), ({"qemu-user"}, "qemu-user")):
            code, said, packages = self.setup_with([], (self.usual - names) | versioned(DEBIAN_13) | offered, "portable")
            self.assertEqual(0, code, said)
            self.assertEqual({expected}, names & set(packages))
            self.assertLess({"g++-aarch64-linux-gnu", "emscripten", "g++", "clang-19"}, set(packages))

    def test_ubuntu_22_has_an_old_boost(self):
        self.system = UBUNTU.format("22.04.5 LTS")
        offered = (self.usual | versioned(UBUNTU_22)) - {"prometheus-cpp-dev"}
        code, said, packages = self.setup_with([], offered, "build")
        self.assertEqual((1, []), (code, packages))
        self.assertRegex(said, r"(?m)^setup: Ubuntu 22\.04\.5 LTS does not offer these packages "
                               r"\(a\|b: one of them\): libboost1\.81-dev\|\S+ prometheus-cpp-dev$")
        self.assertIn("setup: xr3 needs Boost 1.81 or newer: build and run it in a container instead "
                      "(docker/README.md)\n", said)

    def fedora(self, installed, offered, *groups):
        """setup_with() on Fedora, where all packages but Boost have version 1."""
        self.system = FEDORA
        for name in "dpkg-query", "apt-cache", "apt-get":  # also packages of Fedora
            self.stub(name, "exit 1")
        return self.setup_with(*({name if " " in name else f"{name} {'1.83.0' if 'boost' in name else '1'}"
                                  for name in names} for names in (installed, offered)), *groups)

    def test_fedora(self):
        offered = FEDORA_SERVER | FEDORA_43_NODE | FEDORA_TEST | FEDORA_LINES | FEDORA_LINT | {"llvm"}
        for group, expected in (("server", FEDORA_SERVER), ("build", FEDORA_SERVER),  # (node and npm: stubs)
                                ("lines", FEDORA_SERVER | FEDORA_LINES), ("lint", FEDORA_SERVER | FEDORA_LINT)):
            with self.subTest(group):
                code, said, packages = self.fedora([], offered, group)
                self.assertEqual((0, sorted(expected)), (code, sorted(packages)), said)
                self.assertEqual((0, "", []), self.fedora(expected, [], group))
        self.assertEqual((0, ["mold"]), self.fedora(FEDORA_SERVER - {"mold"}, offered, "build")[::2])

    def test_fedora_has_versions_of_node(self):
        self.hide_npm()
        for node, expected in ((FEDORA_43_NODE, FEDORA_43_NODE),
                               (FEDORA_44_NODE, {"nodejs24-bin", "nodejs24-npm-bin"})):
            code, said, packages = self.fedora(FEDORA_SERVER, node, "build")
            self.assertEqual((0, expected), (code, set(packages)), said)
        self.assertEqual((0, "", []), self.fedora(FEDORA_SERVER, [], "server"))

    def hide_npm(self):
        """A PATH without node and npm: the programs that the script needs, and the stubs."""
        for name in "npm", "node":
            (self.folder / name).unlink()
        for name in ("bash", "sh", "cat", "env", "grep", "mktemp", "rm", "sed", "tail", "tr"):
            (self.folder / name).symlink_to(shutil.which(name))
        self.path = str(self.folder)

    def test_fedora_has_no_rapidcheck(self):
        code, said, packages = self.fedora([], FEDORA_SERVER | FEDORA_TEST, "test")
        self.assertEqual((1, []), (code, packages))
        self.assertIn("setup: Fedora Linux 43 (Workstation Edition) does not offer these packages "
                      "(a|b: one of them): rapidcheck-devel\n"
                      "setup: the tests need rapidcheck: run them in a container (docker/README.md)", said)

    def test_an_old_boost_on_fedora(self):
        for version, is_new in (("1.75.0", False), ("1.80.0", False), ("1.81.0", True), ("1.90.0", True),
                                ("1.100.0", True)):
            with self.subTest(version):
                offered = (FEDORA_SERVER - {"boost-devel"}) | {f"boost-devel {version}"}
                code, said, _ = self.fedora([], offered, "server")
                self.assertEqual(0 if is_new else 1, code, said)
                self.assertEqual(not is_new, "xr3 needs Boost 1.81 or newer" in said)

    def test_dnf_fails(self):
        for failing in "repoquery", "install":
            with self.subTest(failing):
                self.stub("dnf", f'case "$*" in *{failing}*) echo "no network" >&2; exit 1 ;; esac\n{DNF}')
                code, said, packages = self.fedora([], FEDORA_SERVER, "server")
                self.assertEqual((1, []), (code, packages))
                self.assertRegex(said, rf"no network\nsetup: dnf {failing} failed")

    def test_another_system_gets_a_list(self):
        self.system = 'PRETTY_NAME="Arch Linux"\nID=arch\n'
        self.hide_npm()
        (self.folder / "dpkg-query").unlink()
        code, said, packages = self.setup_with([], [], "server")
        self.assertEqual((0, []), (code, packages))
        self.assertRegex(said, r"^setup: Arch Linux has neither apt nor dnf; .*docker/README\.md\): \s*g\+\+ make ")

    def test_presets_use_the_installed_compiler(self):
        versions = re.search(r"clang_versions='([\d ]+)'", SETUP.read_text(encoding="utf-8"))[1].split()
        toolchain = pathlib.Path(ROOT, "cmake", "clang.cmake").read_text(encoding="utf-8")
        names = re.search(r"NAMES\s+([^)]+)\)", toolchain)[1].split()
        self.assertEqual([*(f"clang++-{version}" for version in versions), "clang++"], names)


if __name__ == "__main__":
    unittest.main()
