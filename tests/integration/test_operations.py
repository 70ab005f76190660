"""docs/operations.md: its commands install a service that starts, its limits are those of the sources, its
table of capacity is the one that scripts/capacity prints, and its metrics are those that the server has."""
# labels: full

import contextlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest
import urllib.request

from support import DEADLINE_S, LOCALHOST, ROOT, XR3, Server

try:
    import yaml
except ImportError:
    yaml = None

PAGE = pathlib.Path(ROOT, "docs", "operations.md").read_text(encoding="utf-8")
ALERTS = pathlib.Path(ROOT, "deploy", "prometheus", "xr3.rules.yaml")
CAPACITY_S = 240.0

# The sources of the values in the table of limits: for each number of a row its file, constant and,
# if the unit differs, the divisor.
LIMITS = """
open lines | server/net/socket_limits.hpp | lines
open lines | cli/options/serve.cpp | kMaxLines
cells | server/options/options.hpp | max_cells
cells | cli/options/serve.cpp | kMaxCells
subscriptions of a monitor client, and lines of its own by `send` | service/channels.hpp | kMaxSubscriptions
subscriptions of a monitor client, and lines of its own by `send` | server/service/calls.hpp | kMaxOwnLines
branches of a cell, and lines of each | server/cells/branch_cells.hpp | kMostPerOrigin
branches of a cell, and lines of each | server/net/socket_limits.hpp | kLinesPerBranch
memory of the process | server/options/options.hpp | max_memory_mib
unread bytes of a connection in the kernel | server/net/listener.cpp | kSendBuffer | 1024
first bytes of a line that are examined together | protocol/line/line_guard.hpp | kFirstChunk
one turn of a line | server/lines/session.hpp | kBytesATurn
one turn of a line | server/lines/session.hpp | kTurnTime | 1000
unread replies of a line | cell/line/serial_line.hpp | kFullOutbox | 1024
replies that an RFC 2217 client has suspended | cell/line/serial_line.hpp | kFullOutbox | 1024
replies that `step` and `run_until` wait for, per line | server/lines/arrived.hpp | kMaxReplies | 1048576
bytes of a line that have not acted yet | cell/line/pace.hpp | kMaxInput
bytes of all lines of a robot that are due in one advance of real time | cell/advance.hpp | kMaxDueBytes
bytes of all lines of a robot that are due in one millisecond of the real clock | cell/advance.hpp | kMaxTickBytes
time before an inquiry (`--clock bytes`) | protocol/line/byte_clock_settings.hpp | kMaxInquiryMs | 1000
a run to rest (`--clock bytes`) | cell/advance.hpp | kMaxSleep
a `send` (`--clock bytes`) | server/service/line_calls.cpp | kMaxSendTime | 1000000000
commands of a line that wait for the physical controller | cell/device/link.hpp | kMaxWaiting
warnings in the log, per line and simulated second | cell/warning_limiter.hpp | kMaxNotesPerSecond
monitor connections | server/net/socket_limits.hpp | connections
a request | protocol/monitor/request.hpp | kMaxMessageBytes | 1024
a request | protocol/json/document.hpp | kMaxDepth
unread replies of a monitor client | protocol/monitor/client.hpp | kMaxAnswers
unread replies of a monitor client | protocol/monitor/client.hpp | kMaxAnswerBytes | 1024
a message of a Foxglove client | protocol/foxglove/wire.hpp | kMaxClientBytes | 1024
a monitor client that reads nothing | server/net/socket.cpp | kMaxStuck
a WebSocket client that does not answer a ping | server/monitor_port/websocket.hpp | before_close | 1000
messages of a subscription | protocol/monitor/request.hpp | kMaxMilliHz | 1000
recorded events, recorded bytes of lines | cell/cell.hpp | kMaxEvents
recorded events, recorded bytes of lines | cell/cell.hpp | kMaxWires
head of an HTTP request | server/http/wire.hpp | kMaxHeadBytes | 1024
head of an HTTP request | server/http/wire.hpp | kMaxFields
head of an HTTP request | server/resources/session.cpp | kMaxHeadTime
head of an HTTP request | server/http/wire.hpp | kMaxTargetBytes | 1024
a message of a line over WebSocket | server/monitor_port/line_websocket.cpp | kMaxMessage | 1024
an HTTP connection between requests | server/resources/session.cpp | kKeptAlive
the history of all cells | server/app.cpp | kHistoryBytes | 1048576
checkpoints of a cell's history | cell/history/history.hpp | kMaxParts
a recording | server/options/options.hpp | record_max_mib
free space on the disk of recordings | server/recording/room.hpp | kFreeMib
free space on the disk of recordings | server/recording/room.hpp | kFreePercent
all recordings of a run | server/options/options.hpp | record_total_mib
work to repeat a recording for `--continue` | server/recording/recorded_end.hpp | kMostWork | 1000000000
bytes of a `send` call | protocol/monitor/calls/line.cpp | kMaxSent
waiting of a call with `after` | protocol/monitor/request.hpp | kMaxWithinMs | 1000
named snapshots | cell/calls/calls.hpp | kMaxSnapshots
faults on demand | core/faults/fault.hpp | kMaxFaults
events of the effects of a fault | core/faults/effects.hpp | kMaxFaultNews
blocks of a workcell | protocol/files/workcell.hpp | kMaxFileBlocks
pixels of a camera | protocol/files/workcell.hpp | kMaxFilePixels
pixels of a camera | protocol/files/workcell.hpp | kMaxFilePixels
the same in recordings and snapshots, which may be of earlier versions | core/workcell.hpp | kMaxBlocks
the same in recordings and snapshots, which may be of earlier versions | protocol/files/workcell.hpp | kMaxSavedPixels
the same in recordings and snapshots, which may be of earlier versions | protocol/files/workcell.hpp | kMaxSavedPixels
the same in recordings and snapshots, which may be of earlier versions | core/camera.hpp | kMaxCameraRows
a data file | server/files/data_files.hpp | kLargestDataFile | 1048576
a data file | server/files/data_files.cpp | kMaxWaitMs | 1000
wrong tokens of a connection | server/service/sessions.cpp | kMaxWrongTokens
wrong tokens of a connection | server/service/wrong_tokens.hpp | kWrongTokenDelay
wrong tokens of all connections | server/service/wrong_tokens.hpp | kWrongTokensPerSecond
a token | server/options/token.hpp | kMinTokenBytes
a token | server/options/token.hpp | kMaxTokenBytes
log | server/log_budget.hpp | kMaxLogBurst | 1024
log | server/log_budget.hpp | kMaxLogBytesPerSecond | 1024
log file | server/log.hpp | kMaxLogFiles
log file | server/log.hpp | kMaxLogFileBytes | 1048576
stopping | server/app.cpp | kDrainLimit | 1000000000
"""
# Without a constant: no silence ends a line; other tests measure the memory and count the connections.
WITHOUT_CONSTANT = {"silence of a line", "memory to read a request", "connections of one address"}
# Replaces programs that change the machine. `sudo` runs its command, and systemctl only checks its words.
STUBS = """
set -eu
sudo() { "$@"; }
systemctl() { case $1 in daemon-reload | enable | restart) ;; *) exit 64 ;; esac; }
"""


def table(heading):
    """The rows of the first table below a heading, without the first two: lists of cells."""
    section = PAGE.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    rows = re.search(r"(?:^\|.*\n)+", section, re.MULTILINE)[0].splitlines()
    return [[cell.strip() for cell in row.strip("|").split(" | ")] for row in rows[2:]]


def shown_commands(heading):
    """The lines of the first shell fence below a heading."""
    return re.search(rf"^## {re.escape(heading)}$.*?^```sh\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)[1].splitlines()


def constant(file, name, divisor=1):
    """The value of a constant in C++, such as `kMost = 64 * 1024`, `kTime{30}` or `lines = 1024;`."""
    text = pathlib.Path(ROOT, file).read_text(encoding="utf-8")
    value = re.search(rf"\b{name}(?: = |\{{)(.*?);", text)[1]
    number = 1
    for factor in re.findall(r"\d[\d']*", value):
        number *= int(factor.replace("'", ""))
    return number // int(divisor)


@contextlib.contextmanager
def recorded_server():
    """A server with the metrics of all options."""
    with tempfile.TemporaryDirectory() as folder, Server("--record", f"{folder}/session.xr3rec") as xr3:
        yield xr3


class Limits(unittest.TestCase):
    def test_every_row_has_the_values_of_the_sources(self):
        expected = {}
        for name, *place in (row.split(" | ") for row in LIMITS.split("\n") if row):
            expected.setdefault(name, []).append(constant(*place))
        rows = {name: value for name, value, _ in table("Limits")}
        self.assertEqual(expected.keys() | WITHOUT_CONSTANT, rows.keys())
        for name, values in expected.items():
            with self.subTest(name):
                self.assertEqual(values, [int(number) for number in re.findall(r"\d+", rows[name])])


class Signals(unittest.TestCase):
    def test_each_signal_stops_the_server(self):
        rows = [re.findall(r"`(SIG\w+)`", row[0]) for row in table("Signals")]
        self.assertEqual([["SIGTERM", "SIGINT"], ["SIGHUP"]], rows)
        for name in sum(rows, []):
            with self.subTest(name), Server() as xr3:
                self.assertEqual(0, xr3.stop(signal.Signals[name]))
                self.assertIn(f"signal {signal.Signals[name].value}: stopping", xr3.log())


class Metrics(unittest.TestCase):
    def test_every_metric_is_described_with_its_type_and_labels(self):
        described = {}
        for names, kind, _ in table("Metrics"):
            for name in re.findall(r"`(\w+)`", names):
                described[name] = (kind.split(",")[0].removesuffix("s"), tuple(re.findall(r"`(\w+)`", kind)))
        with recorded_server() as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.send("x")
            monitor.step(0, after=line)
            with urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}/metrics") as answer:
                text = answer.read().decode()
        served = {}
        for name, kind in re.findall(r"^# TYPE (\w+) (\w+)$", text, re.MULTILINE):
            labels = re.search(rf"^{name}(?:\{{(.*?)\}})? ", text, re.MULTILINE)[1] or ""
            served[name] = (kind, tuple(label for label in re.findall(r"(\w+)=", labels) if label != "cell"))
        self.assertEqual(served, described)

    def test_the_page_and_the_alerts_use_metrics_that_exist(self):
        with recorded_server() as xr3, urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}/metrics") as answer:
            served = set(re.findall(r"^# TYPE (\w+)", answer.read().decode(), re.MULTILINE))
        for text in PAGE, ALERTS.read_text(encoding="utf-8"):
            used = set(re.findall(r"\b(?:xr3|process)_\w+", text))
            self.assertEqual(set(), used - served)

    @unittest.skipUnless(yaml, "python3-yaml is not installed")
    def test_each_alert_says_what_to_do(self):
        rules = [rule for group in yaml.safe_load(ALERTS.read_text(encoding="utf-8"))["groups"] for rule in group["rules"]]
        self.assertEqual(len(rules), len({rule["alert"] for rule in rules}))
        for rule in rules:
            with self.subTest(rule["alert"]):
                self.assertIn(rule["labels"]["severity"], ("critical", "warning"))
                self.assertEqual({"summary", "description"}, rule["annotations"].keys())
                for text in rule["annotations"].values():
                    self.assertRegex(text, r"\A[A-Z].*\.\Z")

    @unittest.skipUnless(shutil.which("promtool"), "needs promtool, which is in the package prometheus")
    def test_prometheus_accepts_the_alerts(self):
        done = subprocess.run(["promtool", "check", "rules", ALERTS], capture_output=True, text=True, timeout=DEADLINE_S, check=False)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)


class Capacity(unittest.TestCase):
    def test_the_command_prints_the_rows_of_the_page(self):
        self.assertEqual(["scripts/capacity"], shown_commands("Capacity"))
        done = subprocess.run(["scripts/capacity", "--quick"], cwd=ROOT, capture_output=True, text=True,
                              env={**os.environ, "XR3": XR3}, timeout=CAPACITY_S, check=False)
        self.assertEqual(0, done.returncode, done.stderr)
        printed = re.findall(r"^\| (.*?) \| (.*?) \|$", done.stdout, re.MULTILINE)
        self.assertEqual([name for name, *_ in table("Capacity")], [name for name, _ in printed[1:]])
        for name, value in printed[1:]:
            with self.subTest(name):
                self.assertGreater(float(re.match(r"[\d,.]+", value)[0].replace(",", "")), 0)

    def test_wrong_arguments(self):
        done = subprocess.run(["scripts/capacity", "--slow"], cwd=ROOT, capture_output=True, text=True,
                              timeout=DEADLINE_S, check=False)
        self.assertEqual((1, ""), (done.returncode, done.stdout))
        self.assertIn("Usage: scripts/capacity [--quick]", done.stderr)


class Install(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_commands_install_a_service_that_starts(self):
        """The commands run with another folder instead of the root folder; /usr/local comes from cmake's DESTDIR."""
        *install, check = shown_commands("As a service")
        self.assertEqual("./run --build", install.pop(0))
        self.assertEqual("xr3 healthcheck --wait 10", check)
        script = STUBS + "\n".join(install)
        (self.folder / "etc").mkdir()
        script = script.replace("/etc/", f"{self.folder}/etc/").replace("build/release", str(pathlib.Path(XR3).parent))
        done = subprocess.run(["bash", "-c", script], cwd=ROOT, capture_output=True, text=True, timeout=DEADLINE_S,
                              env={**os.environ, "DESTDIR": str(self.folder)}, check=False)
        self.assertEqual(0, done.returncode, done.stderr)
        etc = self.folder / "etc"
        token = (etc / "xr3/token").read_text(encoding="ascii").strip()
        self.assertEqual(0o600, (etc / "xr3/token").stat().st_mode & 0o777)
        program = self.folder / "usr/local/bin/xr3"
        units = list(self.folder.rglob("xr3.service"))
        self.assertEqual([self.folder / "usr/local/lib/systemd/system/xr3.service"], units, "one unit, and not two")
        self.assertIn(f"ExecStart={str(program).removeprefix(str(self.folder))} serve --config /etc/xr3/xr3.toml",
                      units[0].read_text(encoding="utf-8"))
        command = (program, "serve", "--config", etc / "xr3/xr3.toml", "--token-file", etc / "xr3/token")
        with Server(command=command) as xr3, xr3.monitor() as monitor:
            self.assertEqual("read", monitor.hello["access"])
            monitor.request("auth", token=token)
            self.assertEqual([], monitor.call("lines")["lines"])


if __name__ == "__main__":
    unittest.main()
