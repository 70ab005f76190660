"""The packages of the last commit, built once, and bare systems to try them in. Needs root."""

import functools
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from roots import ROOT

WORK = ROOT / "build" / "packages-test"
VERSION = re.search(r"project\(xr3 VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)

# Asks the robot at port 9600 for the error of a motor, and port 9601 for its sites, by bash alone.
SERVE_AND_ASK = """
xr3 serve --log-level warn >/tmp/out & server=$!
until grep -q LISTENING /tmp/out; do kill -0 $server; done
/bin/bash -c 'exec 3<>/dev/tcp/127.0.0.1/9600; printf "E?" >&3
  IFS= read -r -n 1 -t 10 reply <&3; printf "reply [%s]\\n" "$reply"
  for path in /docs/ /play/ /play/xr3.wasm /docs/tutorial/0-in-a-page.html; do
    exec 4<>/dev/tcp/127.0.0.1/9601; printf "GET $path HTTP/1.1\\r\\nHost: localhost\\r\\n\\r\\n" >&4
    IFS= read -r -t 10 status <&4; printf "$path [%s]\\n" "${status%?}"
  done'
xr3 healthcheck
kill $server; wait $server
"""
ANSWERS = "reply [ ]\n" + "".join(f"{path} [HTTP/1.1 200 OK]\n" for path in (  # a blank: no error
    "/docs/", "/play/", "/play/xr3.wasm", "/docs/tutorial/0-in-a-page.html"))


def run(*command, cwd=ROOT, timeout=3000, **options):
    """Runs a command; a failure raises, with its output."""
    done = subprocess.run([str(each) for each in command], cwd=cwd, timeout=timeout, check=False, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    if done.returncode:
        raise AssertionError(f"exit code {done.returncode}: {command}\n{done.stdout[-4000:]}")
    return done.stdout


def hashes(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(pathlib.Path(folder).iterdir())}


def clone(folder, source=ROOT):
    """A clone of the last commit."""
    shutil.rmtree(folder, ignore_errors=True)
    run("git", "clone", "--quiet", source, folder)
    return pathlib.Path(folder)


def need_root():
    if os.geteuid() != 0:
        raise unittest.SkipTest("root file systems need root: sudo ./test --packages")
    WORK.mkdir(parents=True, exist_ok=True)


@functools.cache
def packages_of_the_last_commit():
    """The folder of the packages, which are built once."""
    checkout = clone(WORK / "first")
    run("scripts/playground", cwd=checkout)
    run("scripts/package", cwd=checkout)
    return checkout / "build" / "packages"


class Built(unittest.TestCase):
    """Tests of the packages of the last commit."""

    @classmethod
    def setUpClass(cls):
        cls.packages = packages_of_the_last_commit()

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory(dir=WORK))
