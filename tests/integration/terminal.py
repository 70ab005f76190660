"""A program in a pseudo-terminal and the screen that a user would see. pyte emulates the terminal."""

import fcntl
import os
import pty
import select
import signal
import struct
import subprocess
import termios
import time

import pyte

from support import DEADLINE_S


class Terminal:
    """A context manager for a program; kills it at the end if it is still running."""

    def __init__(self, arguments, rows=24, columns=80, environment=None):
        self.screen = pyte.Screen(columns, rows)
        self._stream = pyte.ByteStream(self.screen)
        self.bytes = b""  # all that the program wrote
        self._master, self._slave = pty.openpty()
        self._set_size(rows, columns)
        self.settings = termios.tcgetattr(self._slave)
        self.process = subprocess.Popen(
            arguments, stdin=self._slave, stdout=self._slave, stderr=subprocess.PIPE, start_new_session=True,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),
            env={**os.environ, "TERM": "linux", "LC_ALL": "C.UTF-8", **(environment or {})})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stderr.close()
        os.close(self._slave)
        os.close(self._master)

    def _set_size(self, rows, columns):
        fcntl.ioctl(self._slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def resize(self, rows, columns):
        """Changes the size of the terminal, which sends SIGWINCH to the program."""
        self.screen.resize(rows, columns)
        self._set_size(rows, columns)

    def press(self, keys):
        os.write(self._master, keys.encode())

    def text(self):
        return "\n".join(line.rstrip() for line in self.screen.display)

    def _read(self, within_s):
        """Reads output of the program; False if there was none in time."""
        if not select.select([self._master], [], [], max(0, within_s))[0]:
            return False
        data = os.read(self._master, 65536)
        self.bytes += data
        self._stream.feed(data)
        return True

    def wait_for(self, holds, what="the screen"):
        """Reads until holds(text of the screen) is true; returns that text."""
        end = time.monotonic() + DEADLINE_S
        while not holds(self.text()):
            left = end - time.monotonic()
            assert left > 0 and self._read(left), f"{what} did not come:\n{self.text()}"
        return self.text()

    def wait_text(self, text):
        return self.wait_for(lambda screen: text in screen, repr(text))

    def wait_end(self):
        """Waits for the exit of the program and reads its remaining output; returns the exit code."""
        code = self.process.wait(DEADLINE_S)
        while self._read(0):
            pass
        return code

    def colors(self):
        """The set of colours on the screen."""
        return {cell.fg for row in self.screen.buffer.values() for cell in row.values()}

    def is_as_before(self):
        """Whether the terminal has the same settings (line editing, echo) as at the start."""
        return termios.tcgetattr(self._slave) == self.settings

    def signal(self, number=signal.SIGTERM):
        self.process.send_signal(number)
