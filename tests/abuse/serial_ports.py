"""The serial ports of a server: a pseudo-terminal that it makes (`--pty`), and a device that the load plays
(`--serial`). Each is a context manager with the server's options and with what the load gets."""

import os
import pathlib
import pty
import tempfile
import tty


class NoPort:
    options, arguments, descriptors = (), (), ()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.hand_over()

    def hand_over(self):
        """The load has started, and has the descriptors of its own."""


class Pty(NoPort):
    """The load gets the path of the pseudo-terminal."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="xr3-")
        path = pathlib.Path(self.folder.name, "rhino")
        self.options, self.arguments = ("--pty", path), (path,)
        return self

    def __exit__(self, *_):
        self.folder.cleanup()


class TwoPtys(Pty):
    """The load gets the path of the first of two pseudo-terminals."""

    def __enter__(self):
        super().__enter__()
        self.options += ("--pty", pathlib.Path(self.folder.name, "other"))
        return self


class Device(NoPort):
    """A pseudo-terminal at the end of a link. The load gets the path of the link, and the device's end."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.path = pathlib.Path(self.folder.name, "arm")
        self.end, self.slave = plug_in(self.path)
        self.options, self.arguments, self.descriptors = ("--serial", self.path), (self.path, self.end), (self.end,)
        return self

    def __exit__(self, *_):
        self.hand_over()
        self.folder.cleanup()

    def hand_over(self):
        """Without this, the device would not vanish when the load closes it."""
        for descriptor in self.end, self.slave:
            if descriptor is not None:
                os.close(descriptor)
        self.end = self.slave = None


class OwnDevice(Device):
    """A device that the process which measures plays itself."""

    def __enter__(self):
        super().__enter__()
        self.arguments, self.descriptors = (self.path,), ()
        return self

    def __exit__(self, *_):
        super().hand_over()
        self.folder.cleanup()

    def hand_over(self):
        """The load does not get it."""


def plug_in(path):
    """A new device at the path; returns its end and that of the server."""
    end, slave = pty.openpty()
    tty.setraw(slave)
    fresh = f"{path}.new"
    os.symlink(os.ttyname(slave), fresh)
    os.replace(fresh, path)
    return end, slave
