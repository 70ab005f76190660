"""Bare Debian root file systems in build/roots, made once with mmdebstrap, and commands in them."""

import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build" / "roots"
SUITES = ("bookworm", "trixie")  # Debian 12 and 13

# Namespaces for processes and mounts: the kernel ends all processes of a command when the command ends.
ISOLATION = ("unshare", "--mount", "--pid", "--fork", "--kill-child")


def base_of(suite, packages=()):
    """The unchanged root file system of this release of Debian, with these packages."""
    base = FOLDER / "+".join((suite, *packages))
    if not (base / "complete").exists():
        shutil.rmtree(base, ignore_errors=True)
        FOLDER.mkdir(parents=True, exist_ok=True)
        subprocess.run(["mmdebstrap", "--quiet", "--variant=minbase", *(f"--include={name}" for name in packages), suite, base],
                       check=True, timeout=600)
        (base / "complete").touch()
    return base


class Root:
    """A copy of a bare system, for one test."""

    def __init__(self, suite, folder, packages=()):
        self.path = pathlib.Path(folder) / "root"
        subprocess.run(["cp", "-a", "--reflink=auto", base_of(suite, packages), self.path], check=True, timeout=120)

    def run(self, script, timeout=120, user=None):
        """Runs a shell script in it, as root or as this user number; returns its output, or raises with it."""
        command = ["chroot", *(["--userspec", f"{user}:{user}"] if user else []), self.path, "/bin/sh", "-euc", script]
        mount = 'mount -t proc proc "$0/proc"; exec "$@"'
        done = subprocess.run([*ISOLATION, "/bin/sh", "-euc", mount, self.path, *command],
                              env={"PATH": "/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/tmp",
                                   "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive"},
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=timeout, check=False)
        if done.returncode:
            raise AssertionError(f"exit code {done.returncode} of: {script}\n{done.stdout}")
        return done.stdout

    def put(self, file, folder="tmp"):
        """Copies a file into a folder of it; returns its path there."""
        shutil.copy(file, self.path / folder)
        return f"/{folder}/{os.path.basename(file)}"

    def has(self, path):
        return os.path.lexists(self.path / path.lstrip("/"))

    def read(self, path):
        return (self.path / path.lstrip("/")).read_text(encoding="utf-8")
