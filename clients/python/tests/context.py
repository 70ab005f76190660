"""Makes the package importable without installing it, and provides a server. XR3 is the path of the
executable (default: `xr3` in PATH)."""

import os
import re
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

XR3 = os.environ.get("XR3", "xr3")


class Server:
    """A running `xr3 serve` on free ports, as a context manager."""

    def __init__(self, *options: str) -> None:
        self.options = options

    def __enter__(self) -> "Server":
        command = [XR3, "serve", "--robot-port", "0", "--monitor-port", "0", "--log-level", "error",
                   *self.options]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        greeting = self.process.stdout.readline()
        ports = re.search(r"robot=\S+:(\d+) monitor=\S+:(\d+)", greeting)
        assert ports, f"{XR3} did not start: {greeting!r}"
        self.robot_port, self.monitor_port = map(int, ports.groups())
        return self

    def __exit__(self, *_: object) -> None:
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()
