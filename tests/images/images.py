#!/usr/bin/python3
"""`./test --images`: builds the images with the commands of docker/README.md and runs their tests.
Arguments are those of unittest, such as `-k healthcheck`."""

import os
import subprocess
import sys
import time
import unittest

from engine import engine, ensure_base

BUILDS = {"xr3": "docker/Dockerfile", "xr3-student": "docker/student/Dockerfile"}
BUILD_DEADLINE_S = 3600


def say(started, what):
    print(f"{time.monotonic() - started:6.0f} s  {what}", flush=True)


def build(started):
    from containers import ROOT, docker  # pylint: disable=import-outside-toplevel
    say(started, "building (the first time takes minutes)")
    commit = subprocess.run(["git", "rev-parse", "--short=12", "HEAD"], cwd=ROOT, capture_output=True, text=True,
                            check=True).stdout.strip()
    for image, file in BUILDS.items():
        arguments = ["--build-arg", f"XR3_COMMIT={commit}"] if image == "xr3" else []
        docker("build", "-f", file, "-t", image, *arguments, ".", cwd=ROOT, deadline_s=BUILD_DEADLINE_S)
        say(started, f"{image} is built from {file}")


def main():
    started = time.monotonic()
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    with engine() as name:
        say(started, f"the engine is {name}")
        say(started, ensure_base())
        build(started)
        from containers import remove_all  # pylint: disable=import-outside-toplevel
        remove_all()
        try:
            here = os.path.dirname(os.path.abspath(__file__))
            program = unittest.main(module=None, exit=False, verbosity=2, argv=[
                "./test --images", "discover", "--start-directory", here, *sys.argv[1:]])
        finally:
            remove_all()
    return 0 if program.result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
