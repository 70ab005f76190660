"""The packages: two builds in different places give the same bytes; the Debian package installs, serves, upgrades, is
removed and purged in bare Debian 12 and 13; the tarball runs there as a user; the program for arm64 runs under QEMU;
scripts/release makes all files of a release, or refuses. Needs root. `./test --packages`."""

import json
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import subprocess
import tarfile
import tempfile
import time
import unittest
import zipfile

from built import ANSWERS, SERVE_AND_ASK, VERSION, WORK, Built, clone, hashes, need_root as setUpModule, run
from roots import ROOT, SUITES, Root

NEXT = "9.8.7"


def replace_once(path, pattern, text):
    changed, count = re.subn(pattern, text, path.read_text(encoding="utf-8"), count=1, flags=re.M)
    assert count == 1, f"{path}: no {pattern}"
    path.write_text(changed, encoding="utf-8")


def prepare_release(folder, version):
    """Does what docs/packages.md says must be done before a release."""
    replace_once(folder / "CMakeLists.txt", r"project\(xr3 VERSION \S+", f"project(xr3 VERSION {version}")
    replace_once(folder / "CHANGELOG.md", r"^## \[Unreleased\]$", f"## [Unreleased]\n\n## [{version}] - 2026-11-24")
    replace_once(folder / "CITATION.cff", r"^version: .*$", f"version: {version}")
    replace_once(folder / "clients/python/xr3/__init__.py", r'^__version__ = "[^"]*"',
                 f'__version__ = "{version}"')
    replace_once(folder / "clients/web/package.json", r'^  "version": ".*",$', f'  "version": "{version}",')
    lock = folder / "clients/web/package-lock.json"
    for indent in "  ", "      ":
        replace_once(lock, rf'^({indent}"name": "xr3-viewer",\n{indent}"version": )".*",$', rf'\1"{version}",')
    for page in [*(folder / "docs").rglob("*.md"), *(folder / "tests" / "golden").glob("watch-*.txt")]:
        text = page.read_text(encoding="utf-8")
        page.write_text(re.sub(r"\bxr3 \d+\.\d+\.\d+", f"xr3 {version}", text), encoding="utf-8")
    git(folder, "commit", "--quiet", "--all", "--message", f"Release {version}")


def clone_of_release(folder):
    """A clone of the last commit, in which the next version is released."""
    folder = clone(folder)
    prepare_release(folder, NEXT)
    return folder


def git(folder, *arguments):
    return run("git", "-C", folder, "-c", "user.name=A test", "-c", "user.email=test@localhost", *arguments)


def debian_package(folder):
    return next(path for path in folder.iterdir() if path.name.endswith("_amd64.deb"))


class Reproducible(Built):
    def test_another_place_time_zone_and_mask_give_the_same_bytes(self):
        other = clone(WORK / "another place" / "with a longer name", source=WORK / "first")
        run("/bin/sh", "-c", "umask 077; scripts/playground && exec scripts/package", cwd=other,
            env={**os.environ, "CCACHE_DISABLE": "1", "TZ": "Asia/Tokyo", "LC_ALL": "C"})
        self.assertEqual(hashes(self.packages), hashes(other / "build" / "packages"))
        self.assertEqual(4, len(hashes(self.packages)))


class DebianPackage(Built):
    def newer(self):
        """A copy of the package with a higher version."""
        tree = tempfile.mkdtemp(dir=self.folder)
        run("dpkg-deb", "-R", debian_package(self.packages), f"{tree}/package")
        replace_once(pathlib.Path(tree, "package", "DEBIAN", "control"), r"^Version: .*$", f"Version: {NEXT}")
        run("dpkg-deb", "--root-owner-group", "-Znone", "-b", f"{tree}/package", self.folder)
        return os.path.join(self.folder, f"xr3_{NEXT}_amd64.deb")

    def test_life_in_a_bare_system(self):
        for suite in SUITES:
            with self.subTest(suite), tempfile.TemporaryDirectory(dir=WORK) as folder:
                self.live(Root(suite, folder))

    def live(self, root):
        package = root.put(debian_package(self.packages))
        root.run(f"apt-get install --yes --no-install-recommends {package}")
        self.assertRegex(root.run("xr3 --version"), rf"^xr3 {re.escape(VERSION)} \(commit [0-9a-f]{{12}}, GNU ")
        self.check_token(root)
        self.assertTrue(root.has("/usr/share/xr3/python/xr3/__init__.py"))
        self.assertIn("ExecStart=/usr/bin/xr3 serve", root.read("/usr/lib/systemd/system/xr3.service"))
        self.assertIn(ANSWERS, root.run(SERVE_AND_ASK, timeout=60))
        self.assertIn("rhino-xr3", root.run("cd /tmp && xr3 draw /tmp/arm.png && xr3 completion robots"))
        self.upgrade(root)
        self.remove_and_purge(root)

    def check_token(self, root):
        self.assertRegex(root.read("/etc/xr3/token"), "^[0-9a-f]{48}$")
        self.assertEqual("600 0", root.run("stat -c '%a %u' /etc/xr3/token").strip())

    def upgrade(self, root):
        root.run("echo '# mine' >>/etc/xr3/xr3.toml")
        token = root.read("/etc/xr3/token")
        root.run(f"apt-get install --yes --no-install-recommends {root.put(self.newer())}")
        self.assertIn(NEXT, root.run("dpkg-query -W xr3"))
        self.assertTrue(root.read("/etc/xr3/xr3.toml").endswith("# mine\n"))
        self.assertEqual(token, root.read("/etc/xr3/token"))

    def remove_and_purge(self, root):
        root.run("apt-get remove --yes xr3")
        self.assertFalse(root.has("/usr/bin/xr3"))
        self.assertTrue(root.has("/etc/xr3/token"))
        root.run("apt-get purge --yes xr3")
        self.assertEqual("", root.run("find / -xdev -name '*xr3*' -not -path '/proc/*' -not -path '/tmp/*'"
                                      " -not -path '/var/log/*' -not -path '/var/cache/*'"))

    def test_the_robot_in_a_page_is_there_once_with_its_licences(self):
        tree = pathlib.Path(self.folder, "tree")
        run("dpkg-deb", "-x", debian_package(self.packages), tree)
        share = tree / "usr/share"
        self.assertEqual([share / "xr3/play/xr3.wasm"], list(tree.rglob("xr3.wasm")))
        for path in (share / "xr3/play").rglob("*"):
            self.assertEqual(0o755 if path.is_dir() else 0o644, path.stat().st_mode & 0o777, path)
        self.assertIn("#xr3=", (share / "xr3/docs/tutorial/7-pick.html").read_text(encoding="utf-8"))
        self.assertLessEqual({"pyodide", "cpython", "codemirror", "emscripten"},
                             set(os.listdir(share / "doc/xr3/licences")))

    def test_manual_pages_are_well_formed(self):
        tree = os.path.join(self.folder, "tree")
        run("dpkg-deb", "-x", debian_package(self.packages), tree)
        pages = sorted(pathlib.Path(tree, "usr/share/man/man1").iterdir())
        self.assertGreater(len(pages), 12)
        for page in pages:
            script = f"LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l {page} 2>&1 >/dev/null"
            self.assertEqual("", run("/bin/sh", "-c", script))

    def test_shells_complete(self):
        tree = os.path.join(self.folder, "tree")
        run("dpkg-deb", "-x", debian_package(self.packages), tree)
        share, path = os.path.join(tree, "usr/share"), f"{tree}/usr/bin:{os.environ['PATH']}"
        environment = {**os.environ, "PATH": path, "HOME": self.folder}
        bash = ('. "$0"; COMP_WORDS=(xr3 serve --robot rh); COMP_CWORD=3; _xr3 xr3 rh --robot 2>/dev/null;'
                ' echo "${COMPREPLY[@]}"')
        script = f"{share}/bash-completion/completions/xr3"
        self.assertIn("rhino-xr3 ", run("bash", "-c", bash, script, env=environment))
        fish = f"source {share}/fish/vendor_completions.d/xr3.fish; complete -C 'xr3 serve --compat m'"
        self.assertIn("mark3", run("fish", "-c", fish, env=environment, cwd=self.folder))
        fish = f"source {share}/fish/vendor_completions.d/xr3.fish; complete -C 'xr3 serve --robot adept'"
        self.assertIn("adept-one", run("fish", "-c", fish, env=environment, cwd=self.folder))
        with Zsh(f"{share}/zsh/vendor-completions", environment) as zsh:
            for typed, becomes in (("xr3 heal", "xr3 healthcheck "), ("xr3 serve --compat m", "--compat mark3 "),
                                   ("xr3 serve --robot adept", "--robot adept-one "), ("xr3 --v", "xr3 --version ")):
                self.assertIn(becomes, zsh.complete(typed, becomes))


class Zsh:
    """A zsh on a terminal, which completes what is typed."""

    DEADLINE_S = 30

    def __init__(self, completions, environment):
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.execvpe("zsh", ["zsh", "-f", "-i"], {**environment, "TERM": "dumb"})
        self.type(f"fpath=({completions} $fpath); autoload -Uz compinit; compinit -u; echo re''ady\n", "ready")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.terminal)

    def type(self, text, expected):
        """Types the text; returns what the terminal shows, without bells, until the expected text is there, or the time is
        over."""
        os.write(self.terminal, text.encode())
        shown, end = "", time.monotonic() + self.DEADLINE_S
        while expected not in shown and select.select([self.terminal], [], [], max(0, end - time.monotonic()))[0]:
            shown += os.read(self.terminal, 4096).decode(errors="replace").replace("\a", "")
        return shown

    def complete(self, text, expected):
        clear_line = "\x15"
        return self.type(f"{clear_line}{text}\t", expected)


class PipelineRecipe(Built):
    def test_installs_the_package_that_it_is_given(self):
        root = Root(SUITES[0], self.folder)
        package, script = root.put(debian_package(self.packages)), root.put(ROOT / "docs/ci/get-xr3.sh")
        said = root.run(f"XR3_PACKAGE={package} XR3_CACHE=/tmp/cache sh {script} && test -d /tmp/cache/apt/partial"
                        " && cd /tmp && XR3_PACKAGE=cache/../xr3.none sh get-xr3.sh || echo refused")
        self.assertRegex(said, rf"(?m)^xr3 {re.escape(VERSION)} \(commit (?s:.*)refused$")


class Tarball(Built):
    def test_runs_as_a_user_from_any_folder(self):
        archive = next(self.packages.glob("*-linux-*.tar.gz"))
        for suite in SUITES:
            with self.subTest(suite), tempfile.TemporaryDirectory(dir=WORK) as folder:
                root = Root(suite, folder)
                path = root.put(archive)
                root.run(f"mkdir /opt/here; tar -C /opt/here -xzf {path}")
                path_of_here = f"PATH=/opt/here/{archive.name.removesuffix('.tar.gz')}/bin:$PATH; cd /tmp;"
                self.assertIn(ANSWERS, root.run(path_of_here + SERVE_AND_ASK, user=1000, timeout=60))
                root.run(f"tar xf {path} -C /usr/local --strip-components=1; rm -r /opt/here {path} /tmp/out")
                self.assertIn(ANSWERS, root.run("cd /tmp;" + SERVE_AND_ASK, user=1000, timeout=60))
                self.assertIn("=/usr/local/bin/xr3 serve", root.read("/usr/local/lib/systemd/system/xr3.service"))

    def test_needs_no_library_but_those_of_the_c_library(self):
        tree = os.path.join(self.folder, "tree")
        run("dpkg-deb", "-x", debian_package(self.packages), tree)
        inside = {path.name for path in pathlib.Path(tree, "usr/lib/xr3").iterdir()}
        needed = set(re.findall(r"NEEDED +(\S+)", run("objdump", "-p", f"{tree}/usr/bin/xr3")))
        self.assertLessEqual(needed - inside, {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"})


class Release(unittest.TestCase):
    def refused(self, folder, *arguments):
        done = subprocess.run(["scripts/release", *arguments], cwd=folder, capture_output=True, text=True, check=False,
                              timeout=60)
        self.assertNotEqual(0, done.returncode)
        return done.stderr

    def test_refuses_what_lags_behind(self):
        folder = clone(WORK / "lagging")
        self.assertIn("is not a version", self.refused(folder, "v1"))
        self.assertIn("CMakeLists.txt does not say version 4.5.6", self.refused(folder, "4.5.6"))
        replace_once(folder / "CMakeLists.txt", r"project\(xr3 VERSION \S+", "project(xr3 VERSION 4.5.6")
        git(folder, "commit", "--quiet", "--all", "--message", "Begin a release")
        self.assertIn("CHANGELOG.md does not have the heading '## [4.5.6] - YYYY-MM-DD'", self.refused(folder, "4.5.6"))
        (folder / "README.md").write_text("changed")
        self.assertIn("has changes", self.refused(folder, VERSION))

    def test_refuses_a_version_that_one_file_lacks(self):
        for file in ("CITATION.cff", "clients/python/xr3/__init__.py", "clients/web/package.json",
                     "clients/web/package-lock.json", "docs/monitor.md", "docs/monitor-messages.md", "docs/watch.md",
                     "docs/tutorial/2-moves.md"):
            folder = clone_of_release(WORK / "lagging")
            git(folder, "checkout", "--quiet", "HEAD~", "--", file)
            git(folder, "commit", "--quiet", "--all", "--message", "Forget a file")
            self.assertIn(file, self.refused(folder, NEXT))

    def test_refuses_a_tag_of_another_commit(self):
        folder = clone_of_release(WORK / "lagging")
        git(folder, "tag", f"v{NEXT}", "HEAD~")
        self.assertIn("is at another commit", self.refused(folder, NEXT))

    def test_makes_every_file(self):
        checkout = clone_of_release(WORK / "released")
        run("scripts/release", NEXT, "--no-image", cwd=checkout)
        folder = checkout / "build" / f"release-{NEXT}"
        self.assertEqual({f"xr3-{NEXT}-source.tar.gz", f"xr3-{NEXT}-page.tar.gz", f"xr3-{NEXT}.spdx.json", "SHA256SUMS",
                          f"xr3-{NEXT}-linux-x86_64.tar.gz", f"xr3-{NEXT}-linux-aarch64.tar.gz",
                          f"xr3_{NEXT}_amd64.deb", f"xr3_{NEXT}_arm64.deb", f"xr3-{NEXT}.tar.gz",
                          f"xr3-{NEXT}-py3-none-manylinux_2_36_x86_64.whl",
                          f"xr3-{NEXT}-py3-none-manylinux_2_36_aarch64.whl"}, set(os.listdir(folder)))
        run("sha256sum", "--check", "--strict", "SHA256SUMS", cwd=folder)
        self.check_components(folder / f"xr3-{NEXT}.spdx.json")
        self.check_source(folder / f"xr3-{NEXT}-source.tar.gz", git(checkout, "rev-parse", "HEAD").strip())
        with tarfile.open(folder / f"xr3-{NEXT}-page.tar.gz") as page:
            self.assertIn(f"xr3-{NEXT}-page/index.html", page.getnames())
        self.check_arm64(checkout, folder / f"xr3_{NEXT}_arm64.deb")
        self.check_wheel_of_arm64(folder / f"xr3-{NEXT}-py3-none-manylinux_2_36_aarch64.whl")

    def check_components(self, path):
        document = json.loads(path.read_text(encoding="utf-8"))
        self.assertEqual("SPDX-2.3", document["spdxVersion"])
        names = {each["name"]: each for each in document["packages"]}
        self.assertLessEqual({"xr3", "libgcc-s1", "libstdc++6", "libboost1.81-dev", "nettle-dev", "three", "uplot",
                              "uqr", "mkdocs-material", "pyodide", "cpython", "codemirror"},
                             set(names))
        self.assertEqual(NEXT, names["xr3"]["versionInfo"])
        self.assertTrue(all(each["versionInfo"] and each["licenseDeclared"] for each in names.values()))
        identifiers = [each["SPDXID"] for each in document["packages"]]
        self.assertEqual(len(identifiers), len(set(identifiers)))
        self.assertLessEqual({each["relatedSpdxElement"] for each in document["relationships"]}, set(identifiers))

    def check_source(self, path, commit):
        with tarfile.open(path) as source:
            named = source.extractfile(f"xr3-{NEXT}/cmake/commit.txt").read().decode().strip()
            self.assertIn(f"xr3-{NEXT}/run", source.getnames())
        self.assertTrue(commit.startswith(named) and named, named)

    def check_arm64(self, checkout, package):
        self.assertEqual("arm64", run("dpkg-deb", "-f", package, "Architecture").strip())
        with tempfile.TemporaryDirectory(dir=WORK) as tree:
            run("dpkg-deb", "-x", package, tree)
            emulator = shutil.which("qemu-aarch64-static") or shutil.which("qemu-aarch64")
            program = [emulator, "-L", checkout / "build" / "sysroot-arm64", f"{tree}/usr/bin/xr3"]
            self.assertIn(f"xr3 {NEXT} ", run(*program, "--version"))
            data = {**os.environ, "XR3_DATA": f"{tree}/usr/share/xr3"}
            ours = run(checkout / "build" / "package" / "xr3", "kin", "--counts", "100,-50,30,20,10", env=data)
            self.assertEqual(ours, run(*program, "kin", "--counts", "100,-50,30,20,10", env=data))

    def check_wheel_of_arm64(self, path):
        with zipfile.ZipFile(path) as wheel:
            program = wheel.read(f"xr3-{NEXT}.data/scripts/xr3")
        arm64 = 183  # e_machine in the header of ELF
        self.assertEqual(arm64, int.from_bytes(program[18:20], "little"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
