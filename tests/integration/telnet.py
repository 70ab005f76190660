"""A user of a telnet client at a terminal: inetutils telnet, or another one."""

import os
import pty
import re
import select
import shutil
import subprocess
import time
import unittest

from support import DEADLINE_S, LOCALHOST


def needs(program, package):
    return unittest.skipUnless(shutil.which(program),
                               f"{program} is not installed (Debian package {package})")


class TerminalClient:
    """A program in a pseudo-terminal: type() enters keys, read_until() reads the screen."""

    def __init__(self, *command, environment=None):
        self.terminal, inner = pty.openpty()
        self.process = subprocess.Popen(
            command, stdin=inner, stdout=inner, stderr=inner, preexec_fn=lambda: os.login_tty(inner),
            env={**os.environ, "TERM": "dumb", **(environment or {})})
        os.close(inner)
        self.screen = b""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        os.close(self.terminal)

    def type(self, keys):
        os.write(self.terminal, keys)

    def read_until(self, pattern):
        """Waits until the screen, from the end of the last match on, matches; returns the match."""
        ends = time.monotonic() + DEADLINE_S
        while not (match := re.search(pattern, self.screen, re.DOTALL)):
            left = ends - time.monotonic()
            if left < 0 or not select.select([self.terminal], [], [], left)[0]:
                raise AssertionError(f"the screen shows {self.screen!r}, not {pattern!r}")
            self.screen += os.read(self.terminal, 4096)
        self.screen = self.screen[match.end():]
        return match


class Telnet(TerminalClient):
    """inetutils telnet, as a user starts it."""

    def __init__(self, port):
        super().__init__("telnet", LOCALHOST, str(port))
        self.read_until(rb"Escape character is[^\n]*\n")

    def inquire(self, inquiry):
        """Types an inquiry and Enter; returns the byte that appears after their echo."""
        self.type(inquiry + b"\n")
        return self.read_until(re.escape(inquiry) + rb"\r\n(.)").group(1)
