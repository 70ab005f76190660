"""Helpers for the tests of the images: `docker` as a function, and containers as context managers. All
containers and networks have a label, by which remove_all() finds them. Every wait is for an event, with a
deadline."""

import json
import os
import pathlib
import re
import subprocess
import sys
import threading
import time
import uuid

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "clients" / "python"))

from xr3 import Monitor  # noqa: E402

IMAGE, STUDENT = "xr3", "xr3-student"
LABEL = "xr3-test"
DEADLINE_S = 60
HARDENED = ("--read-only", "--cap-drop=ALL", "--security-opt=no-new-privileges")
USER = "10001"
TRIES = 3
START = threading.Lock()  # one container starts at a time, so that no two get the same port


def docker(*arguments, fails=False, deadline_s=DEADLINE_S, **options):
    """Runs `docker` until it exits; returns the result, with text output. Raises AssertionError if it
    fails, or, with fails=True, if it succeeds."""
    done = subprocess.run(["docker", *map(str, arguments)], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, timeout=deadline_s, check=False, **options)
    if (done.returncode != 0) != fails:
        raise AssertionError(f"docker {' '.join(map(str, arguments))} ended with "
                             f"{done.returncode}\n{done.stdout}{done.stderr}")
    return done


def output_of(*arguments):
    """The output of a `docker` command, without the line end."""
    return docker(*arguments).stdout.strip()


def inspect(what, template):
    """A member of the JSON that `docker inspect` prints about a container or an image."""
    return json.loads(output_of("inspect", "--format", f"{{{{json {template}}}}}", what))


def remove_all():
    """Removes the containers and networks of this run and of earlier ones."""
    for kind in ("container", "network"):
        every = ("--all",) if kind == "container" else ()
        left = output_of(kind, "ls", "--quiet", *every, "--filter", f"label={LABEL}").split()
        if left:
            docker(kind, "rm", "--force", *left)


class Network:
    """A network whose containers can resolve each other's names."""

    def __enter__(self):
        self.name = f"{LABEL}-{uuid.uuid4().hex[:8]}"
        docker("network", "create", "--label", LABEL, self.name)
        return self

    def __exit__(self, *_):
        docker("network", "rm", "--force", self.name)

    def student(self, *command, options=()):
        """Runs a command in a second container; returns the result."""
        return docker("run", "--rm", "--label", LABEL, "--network", self.name, *HARDENED, *options,
                      STUDENT, *command, deadline_s=180)


class Robot:
    """A container of the run image, started as in docker/README.md, on free ports of this machine. The
    context begins when the server is LISTENING. `options` are those of `docker run`; `command` replaces
    the image's command; `environment` sets variables."""

    def __init__(self, *options, command=(), **environment):
        self.name = f"{LABEL}-{uuid.uuid4().hex[:8]}"
        variables = [word for name, value in environment.items() for word in ("-e", f"{name}={value}")]
        self.arguments = [
            "--name", self.name, "--label", LABEL, *HARDENED, "-p", "127.0.0.1::9600",
            "-p", "127.0.0.1::9601", *variables, *options, IMAGE, *command]

    def __enter__(self):
        with START:
            self.start()
        try:
            self.wait_log("^LISTENING ")
            self.robot_port, self.monitor_port = map(self.port, (9600, 9601))
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        docker("rm", "--force", self.name)

    def start(self):
        """Retries: the engine chooses free ports first and binds them later, when another process may
        have bound them."""
        for tries_left in reversed(range(TRIES)):
            docker("create", *self.arguments)
            self.asked_to_start = time.time()
            try:
                docker("start", self.name)
                return
            except AssertionError as failed:
                docker("rm", "--force", self.name)
                if tries_left == 0 or "already in use" not in str(failed):
                    raise

    def port(self, inside):
        """The port of this machine that is mapped to the container's port."""
        return int(output_of("port", self.name, f"{inside}/tcp").splitlines()[0].rpartition(":")[2])

    def log(self, *options):
        done = docker("logs", *options, self.name)
        return done.stdout + done.stderr

    def wait_log(self, pattern):
        """Follows the log until a line matches; returns that line."""
        command = ["docker", "logs", "--follow", self.name]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, text=True) as follower:
            watchdog = threading.Timer(DEADLINE_S, follower.kill)
            watchdog.start()
            lines = []
            for line in follower.stdout:
                lines.append(line)
                if re.search(pattern, line):
                    break
            else:
                raise AssertionError(f"no {pattern!r} in the log:\n{''.join(lines)}")
            watchdog.cancel()
            follower.kill()
        return line

    def execute(self, *command, options=(), fails=False):
        """Runs a program of the image in the container."""
        return docker("exec", *options, self.name, *command, fails=fails)

    def monitor(self, token=None):
        return Monitor("127.0.0.1", self.monitor_port, token=token)

    def state(self, member):
        return inspect(self.name, f".State.{member}")


def environment_without_xr3():
    return {name: value for name, value in os.environ.items()
            if not name.startswith("XR3_") or name == "XR3_ENGINE"}
