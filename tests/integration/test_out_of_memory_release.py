"""Memory runs out while lines wait for large images: the server must not keep a port that it does
not serve. It ends with its own exit code and an error message, or it continues and serves new lines. (Not under
sanitizers, which need more memory.)"""
# labels: release

import contextlib
import json
import pathlib
import resource
import tempfile
import unittest

from support import DEADLINE_S, ROOT, Line, Server, connect, run_xr3

BROKEN = 5
PIXELS = 1000
LINES = 400
MORE_KIB = 48 * 1024  # some dozens of pictures
PICTURES = b"A**" * 20


def workcell(folder):
    """The Rhino's workcell with the largest camera."""
    cell = json.loads(pathlib.Path(ROOT, "data", "workcells", "rhino-xr3.json").read_text(encoding="utf-8"))
    cell["camera"]["pixels"] = [PIXELS, PIXELS]
    path = pathlib.Path(folder, "large.json")
    path.write_text(json.dumps(cell), encoding="utf-8")
    return path


def greedy_lines(xr3, open_lines):
    """Opens lines that request images and read none, until the server closes."""
    for _ in range(LINES):
        with contextlib.suppress(OSError):
            line = open_lines.enter_context(connect(xr3.robot_port, buffer_bytes=4096))
            line.sendall(PICTURES)


class OutOfMemory(unittest.TestCase):
    def test_ends_or_continues(self):
        with tempfile.TemporaryDirectory() as folder, \
                Server("--max-lines", LINES + 1, "--workcell", workcell(folder)) as xr3, contextlib.ExitStack() as open_lines:
            most = (xr3.status("VmSize") + MORE_KIB) * 1024
            resource.prlimit(xr3.pid, resource.RLIMIT_AS, (most, most))
            greedy_lines(xr3, open_lines)
            try:
                with Line(connect(xr3.robot_port)) as line:
                    self.assertEqual(32, line.ask("E?"))
            except (OSError, EOFError):
                self.assertEqual(BROKEN, xr3.process.wait(DEADLINE_S))
                xr3.wait_log(r" critical the server has failed and ends: .*std::bad_alloc\n")
            else:
                done = run_xr3("healthcheck", "--monitor-port", xr3.monitor_port)
                self.assertEqual(0, done.returncode, done.stderr)


if __name__ == "__main__":
    unittest.main()
