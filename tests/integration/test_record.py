"""Recordings: what a real server writes while it runs, and what `xr3 replay` makes of it."""

import csv
import json
import os
import pathlib
import re
import stat
import subprocess
import tempfile
import time
import unittest
import urllib.request

from support import DEADLINE_S, LOCALHOST, ROOT, XR3, MonitorError, Server, counts, run_xr3

POLLS = 300
LIMIT_KIB = 24  # stands for a full disk


class Recordings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "session.xr3"

    def entries(self, file=None):
        """The header and the entries, without a last line that is incomplete."""
        text = (file or self.file).read_text(encoding="ascii")
        return [json.loads(line) for line in text.split("\n")[:-1]]

    def replay(self, *options, code=0, file=None):
        done = run_xr3("replay", file or self.file, *options)
        self.assertEqual(code, done.returncode, done.stderr)
        return done

    def wait_for_entry(self, xr3, is_wanted):
        deadline = time.monotonic() + DEADLINE_S
        with xr3.monitor() as monitor:
            while not any(map(is_wanted, self.entries())):
                self.assertLess(time.monotonic(), deadline, self.file.read_text(encoding="ascii")[-2000:])
                monitor.request("ping")

    def state_of(self, monitor):
        return {name: value for name, value in monitor.get().items() if name not in ("op", "id", "seq")}

    def replayed_state(self, *options):
        message = json.loads(self.replay("--print", "state", *options).stdout)
        return {name: value for name, value in message.items() if name not in ("op", "id", "seq")}

    # --- Sessions.

    def test_the_session_in_the_docs_is_repeated(self):
        done = self.replay("--print", "state", file=pathlib.Path(ROOT, "docs/find-and-pick.xr3rec"))
        self.assertIn("everything is as recorded", done.stderr)
        red, = (block for block in json.loads(done.stdout)["blocks"] if block["name"] == "red")
        self.assertLess(max(abs(a - b) for a, b in zip(red["xyz_mm"], (392, 60, 20))), 2)

    def test_a_session_with_calls_and_faults_comes_to_the_same_state(self):
        with Server("--record", self.file, "--fault", "worn-arm") as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.send("E+60\rC-30\r")
            monitor.step(400, after=line)
            line.ask("E?")
            monitor.call("send", text="D?")
            monitor.call("snapshot_save", name="early")
            inline = monitor.call("snapshot_save", inline=True)["snapshot"]
            monitor.call("fault_set", fault={"name": "jam", "kind": "motor_stuck", "joint": "E", "at_tick": 500,
                                             "ticks": 300})
            monitor.call("run_until", idle=True, max_ticks=60_000)
            with self.assertRaises(MonitorError):
                monitor.call("block_remove", name="none")
            workcell = json.loads(pathlib.Path(ROOT, "data/workcells/rhino-xr3.json").read_text(encoding="utf-8"))
            workcell["blocks"] = workcell["blocks"][:1]
            monitor.call("workcell", workcell=workcell)
            monitor.call("snapshot_load", name="early")
            monitor.call("snapshot_load", snapshot=inline)
            monitor.call("key", function="view", value=[1, 2, 3])
            line.send("B+20\r")
            monitor.step(123, after=line)
            state = self.state_of(monitor)
        self.assertEqual(state, self.replayed_state())
        header, *entries = self.entries()
        self.assertEqual((1, "paper", "manual"), (header["xr3_recording"], header["profile"], header["clock"]["mode"]))
        self.assertEqual({"Rhino XR-3"}, {header["robot"]["name"]})
        self.assertIn("faults", header)
        self.assertEqual("stopped", entries[-1]["end"])
        self.assertNotIn("none", [entry.get("args", {}).get("name") for entry in entries])

    def test_real_time_with_a_line_speed(self):
        options = "--record", self.file, "--line-speed", "9600-7e2", "--compat", "mark3"
        with Server(*options, clock="real:20") as xr3:
            first, second = xr3.line(), xr3.line()
            first.send("E+60\r")
            for i in range(40):
                second.ask("E?")
                first.send("C-2\r" if i % 2 else "\xff\xfd\x03C+2\r".encode("latin-1"))
            first.finish_sending()
            first.read_to_end()
        self.assertIn("everything is as recorded", self.replay().stderr)
        self.assertTrue(any("out" in entry and "in" not in entry for entry in self.entries()[1:]))

    def test_the_byte_clock(self):
        options = "--record", self.file, "--fault", "noisy-line"
        with Server(*options, clock="bytes:20,settle=10") as xr3, xr3.monitor() as monitor:
            with xr3.line() as line:
                line.send("E+60\rE?D-20\rI")
                line.read(2)
                self.wait_for_entry(xr3, lambda entry: entry.get("silent"))
            with xr3.line() as line:
                line.send("C+5\rC?")
                line.read(1)
            monitor.call("pause")
            monitor.step(77)
            monitor.call("resume")
            state = self.state_of(monitor)
        self.assertEqual(state, self.replayed_state())
        header, *entries = self.entries()
        self.assertEqual({"inquiry_ms": 20, "settle_ms": 10, "concurrent_lines": False}, header["byte_clock"])
        self.assertTrue(any("us" in entry for entry in entries))

    def test_calls_that_advance_the_byte_clock(self):
        with Server("--record", self.file, clock="bytes") as xr3, xr3.monitor() as monitor:
            saved = monitor.call("snapshot_save", inline=True)["snapshot"]
            begins = {"": lambda: None, "reset": lambda: monitor.call("reset"),
                      "snapshot_load": lambda: monitor.call("snapshot_load", snapshot=saved),
                      "seek": lambda: (monitor.call("seek", tick=monitor.get("tick")["tick"]), monitor.call("resume"))}
            runs = [("step", {"ticks": 77}), ("run_until", {"idle": True, "max_ticks": 60_000}),
                    ("run_until", {"tick": 10**6, "max_ticks": 33})]
            for name, begin in begins.items():
                for fn, args in runs:
                    for is_open in False, True:
                        with self.subTest(begin=name, call=fn, is_open=is_open):
                            begin()
                            self.advance(xr3, monitor, fn, args, is_open)
            state = self.state_of(monitor)
        self.assertEqual(state, self.replayed_state())
        table = self.folder / "joints.csv"
        self.replay("--csv", table, "--every", "10")
        rows = list(csv.DictReader(table.read_text(encoding="ascii").splitlines()))
        self.assertEqual(str(state["epoch"]), rows[-1]["epoch"])

    def advance(self, xr3, monitor, fn, args, is_open):
        """A motion begins, and a call lets time pass for it, while its line is open or after its end; the past shows
        the same."""
        with xr3.line() as line:
            line.ask("E+20\rE?")
            if is_open:
                monitor.call(fn, **args)
        while monitor.call("lines")["lines"]:
            pass
        monitor.call(fn, **args)
        now = monitor.get()
        look = {"epoch": now["epoch"], "tick": now["tick"], "channels": ["state"]}
        monitor.send({"op": "call", "id": "look", "fn": "look", "args": look})
        *frames, result = monitor.read_until(lambda message: message["op"] == "result")
        self.assertEqual((now["tick"], now["joints"]), (result["value"]["tick"], frames[-1]["joints"]))

    def files(self, folder, cell):
        """The recordings of a cell, in the order of their start."""
        found = sorted((folder / cell).iterdir(), key=lambda path: (path.name[:20], len(path.name), path.name))
        for path in found:
            self.assertRegex(path.name, r"^\d{4}-\d\d-\d\dT\d\d-\d\d-\d\dZ(-\d+)?\.xr3rec$")
        return found

    def test_each_of_several_cells_has_a_file(self):
        with Server("--record", self.folder / "class", "--cells", "2") as xr3, xr3.monitor() as monitor:
            for cell, moves in (("1", "E+10\r"), ("2", "E+20\r")):
                monitor.request("call", cell=cell, fn="send", args={"text": moves})
                monitor.request("call", cell=cell, fn="run_until", args={"idle": True, "max_ticks": 60_000})
        self.assertEqual(0o700, stat.S_IMODE((self.folder / "class").stat().st_mode))
        self.assertEqual({"1", "2"}, {path.name for path in (self.folder / "class").iterdir()})
        for cell, count in (("1", "E10"), ("2", "E20")):
            file, = self.files(self.folder / "class", cell)
            done = self.replay("--print", "state", file=file)
            self.assertEqual(count, counts(json.loads(done.stdout)))

    def test_each_cell_of_a_connection_has_a_file(self):
        with Server("--record", self.folder / "class", "--cell-per-connection") as xr3:
            for _ in range(2):
                with xr3.line() as line:
                    line.ask("E?")
        for cell in ("c1", "c2"):
            file, = self.files(self.folder / "class", cell)
            self.assertIn("everything is as recorded", self.replay(file=file).stderr)

    def test_a_restart_keeps_the_recordings_and_records(self):
        """Servers with the same options, one after the other, write other files."""
        for options in (["--cells", "2"], ["--cell-per-connection"]):
            with self.subTest(options):
                folder = self.folder / options[0].strip("-")
                cell = "c1" if len(options) == 1 else "1"
                for count in ("10", "20", "20"):
                    before = self.bytes_of(folder)
                    self.record_a_move(folder, f"E+{count}\r", *options)
                    self.assertLessEqual(before.items(), self.bytes_of(folder).items())
                files = self.files(folder, cell)
                self.assertEqual(3, len(files))
                for file, count in zip(files, ("E10", "E20", "E20")):
                    done = self.replay("--print", "state", file=file)
                    self.assertEqual(count, counts(json.loads(done.stdout)))

    def bytes_of(self, folder):
        return {path: path.read_bytes() for path in folder.glob("*/*")}

    def record_a_move(self, folder, move, *options):
        with Server("--record", folder, *options) as xr3, xr3.line() as line:
            line.ask(move + "E?")
            with xr3.monitor() as monitor:
                monitor.request("call", cell=monitor.hello["cells"][0], fn="run_until",
                                args={"idle": True, "max_ticks": 60_000})
            xr3.wait_log(f"the cells are recorded in {folder}")

    def test_the_folder_of_several_cells_is_no_file(self):
        self.file.write_text("kept", encoding="ascii")
        done = run_xr3("serve", "--robot-port", "0", "--monitor-port", "0", "--cells", "2", "--record", self.file)
        self.assertEqual(2, done.returncode)
        self.assertIn("is a file; several cells record into a folder", done.stderr)
        self.assertEqual("kept", self.file.read_text(encoding="ascii"))

    def test_real_time_polls_take_little_room(self):
        with Server("--record", self.file, clock="real") as xr3:
            line = xr3.line()
            line.send("E+100\r")
            for _ in range(POLLS):
                line.ask("E?")
        polls = [row for row in self.file.read_text(encoding="ascii").splitlines() if '"in":"E?"' in row]
        self.assertIn(len(polls), (POLLS - 1, POLLS))  # the first may arrive with the move
        self.assertLess(sum(map(len, polls)) / POLLS, 60)
        self.replay()

    def test_a_client_that_is_refused_is_recorded(self):
        with Server("--record", self.file, clock="real") as xr3:
            line = xr3.line()
            line.send("GET / HTTP/1.1\r\nHost: x\r\n\r\n")
            line.read_to_end()
        self.assertIn("stranger", [entry.get("close") for entry in self.entries()])
        self.replay()

    # --- The file.

    def test_the_file_is_new_and_private(self):
        with Server("--record", self.file):
            self.assertEqual(0o600, stat.S_IMODE(self.file.stat().st_mode))
        done = run_xr3("serve", "--robot-port", "0", "--monitor-port", "0", "--record", self.folder)
        self.assertEqual(2, done.returncode)
        self.assertIn("is a folder; one cell records into a file", done.stderr)

    def test_a_restart_after_a_crash_records_beside_the_file(self):
        with Server("--record", self.file) as xr3:
            xr3.process.kill()
            xr3.process.wait()
        before = self.file.read_bytes()
        with Server("--record", self.file) as xr3:
            xr3.line().ask("E?")
            xr3.wait_log("session.xr3 exists already; the cell is recorded in ")
        self.assertEqual(before, self.file.read_bytes())
        other, = (path for path in self.folder.iterdir() if path != self.file)
        self.assertRegex(other.name, r"^session-\d{8}T\d{6}Z\.xr3$")
        self.assertEqual(0o600, stat.S_IMODE(other.stat().st_mode))
        self.assertIn("everything is as recorded", self.replay(file=other).stderr)

    def test_a_symbolic_link_is_not_followed(self):
        self.file.symlink_to(self.folder / "target")
        with Server("--record", self.file):
            pass
        self.assertFalse((self.folder / "target").exists())
        self.assertEqual(2, len(list(self.folder.iterdir())))

    def test_a_killed_server_leaves_a_valid_recording(self):
        with Server("--record", self.file, clock="real") as xr3:
            line = xr3.line()
            line.send("E+50\r")
            line.ask("E?")
            line.ask("D?")
            self.wait_for_entry(xr3, lambda entry: entry.get("in") == "D?")
            xr3.process.kill()
            xr3.process.wait()
        self.assertIn("was cut off", self.replay().stderr)

    def test_every_cut_is_accepted_and_every_change_found(self):
        with Server("--record", self.file) as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.send("E+5\rE?")
            monitor.step(20, after=line)
        data = self.file.read_bytes()
        first = data.index(b"\n") + 1
        other = self.folder / "other.xr3"
        for size in (first, first + 1, (first + len(data)) // 2, len(data) - 1):
            other.write_bytes(data[:size])
            self.replay(file=other)
        for place in (5, first // 2, first - 1, first + 3, (first + len(data)) // 2, len(data) - 5, len(data) - 1):
            other.write_bytes(data[:place] + bytes([data[place] ^ 2]) + data[place + 1:])
            done = self.replay(file=other, code=2)
            number = data.count(b"\n", 0, place) + 1
            self.assertTrue(done.stderr.startswith(f"{other}:{number}: "), (place, done.stderr))

    def test_a_full_disk_ends_the_recording_and_not_the_robot(self):
        limited = ["bash", "-c", f'ulimit -f {LIMIT_KIB}; exec "$@"', "bash", XR3, "serve"]
        with Server("--record", self.file, "--log-level", "warn", command=limited, clock="real") as xr3:
            self.assertEqual((0, False), self.failed_recordings(xr3))
            self.talk_until_the_recording_fails(xr3, "File too large")
            self.assertEqual((1, True), self.failed_recordings(xr3))
            self.assertRegex(xr3.log(), r"warning cell @\d+: the recording has ended")
        self.assertLessEqual(self.file.stat().st_size, LIMIT_KIB << 10)
        self.assertTrue(self.file.read_bytes().endswith(b"\n"))
        self.assertIn("was cut off", self.replay().stderr)

    def test_the_maximum_size_ends_the_recording(self):
        with Server("--record", self.file, "--record-max", "1", clock="real") as xr3:
            self.talk_until_the_recording_fails(xr3, "reached its maximum of 1 MiB", "x" * 3000)
        self.assertLessEqual(self.file.stat().st_size, 1 << 20)
        self.assertEqual("limit", self.entries()[-1]["end"])
        self.replay()

    def test_the_maximum_size_of_all_recordings_together(self):
        folder = self.folder / "class"
        options = "--cell-per-connection", "--record", folder, "--record-max", 2, "--record-total", 3
        with Server(*options, clock="real") as xr3, xr3.monitor() as monitor:
            for number in range(1, 5):
                line = xr3.line()
                line.ask("E?")  # a robot program: else it gets no cell
                failed = []
                deadline = time.monotonic() + DEADLINE_S
                while not failed:
                    self.assertLess(time.monotonic(), deadline)
                    for _ in range(50 if number < 3 else 1):
                        line.send("x" * 3000)
                        line.ask("E?")
                    events = monitor.recall("event", cell=f"c{number}", since=0)
                    failed = [event for event in events if event["code"] == "recording_failed"]
                self.assertIn("--record-max" if number == 1 else "--record-total", failed[0]["message"])
                self.assertEqual(ord(" "), line.ask("E?"))
        files = [path for cell in ("c1", "c2") for path in self.files(folder, cell)]
        self.assertEqual([], list(folder.glob("c[34]/*")))
        self.assertEqual(2, len(files))
        self.assertLessEqual(sum(path.stat().st_size for path in files), 3 << 20)
        for file in files:
            self.assertEqual("limit", self.entries(file)[-1]["end"])
            self.replay(file=file)

    def failed_recordings(self, xr3):
        """The number of failed recordings in /metrics, and the mark of the cell in the overview."""
        with urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}/metrics") as answer:
            count, = re.findall(rb'^xr3_recordings_failed_total{cell="main"} (\d+)$', answer.read(), re.MULTILINE)
        with xr3.monitor() as monitor:
            cell, = monitor.look("overview")["cells"]
        return int(count), cell["recording_failed"]

    @unittest.skipUnless(os.geteuid() == 0, "a small file system needs root")
    def test_a_disk_that_is_nearly_full_ends_the_recording_and_not_the_robot(self):
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", self.folder], check=False).returncode:
            self.skipTest("this machine lets nobody mount")
        self.addCleanup(subprocess.run, ["umount", self.folder], check=True)
        filler = self.folder / "filler"
        with Server("--record", self.file, clock="real") as xr3:
            xr3.line().ask("E?")
            filler.write_bytes(bytes((8 << 20) - (400 << 10)))
            self.talk_until_the_recording_fails(xr3, "its disk has only 0 MiB free, and recordings leave 0 MiB")
        self.assertEqual("limit", self.entries()[-1]["end"])
        self.replay()
        again = self.folder / "again.xr3"
        with Server("--record", again, "--log-level", "warn", clock="real") as xr3:
            xr3.wait_log("the recording has ended, and the robot goes on: .*again.xr3: its disk has only")
            self.assertEqual(ord(" "), xr3.line().ask("E?"))
            self.assertEqual((1, True), self.failed_recordings(xr3))
        self.assertFalse(again.exists())

    def talk_until_the_recording_fails(self, xr3, why, junk=""):
        line = xr3.line()
        line.ask("E?")
        with xr3.monitor() as monitor:
            failed = []
            deadline = time.monotonic() + DEADLINE_S
            while not failed:
                self.assertLess(time.monotonic(), deadline)
                line.send(junk)
                line.ask("E?")
                failed = [event for event in monitor.recall("event", since=0)
                          if event["code"] == "recording_failed"]
            self.assertEqual(str(self.file), failed[0]["file"])
            self.assertIn(why, failed[0]["message"])
            self.assertEqual(ord(" "), line.ask("E?"))
        xr3.wait_log("the recording has ended, and the robot goes on")

    # --- Options of replay.

    def test_options_of_replay(self):
        states = {}
        with Server("--record", self.file) as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.send("E+60\r")
            for _ in range(4):
                monitor.step(100, after=line)
                states[monitor.get()["tick"]] = self.state_of(monitor)
            monitor.call("reset")
            line.send("C+5\rA%3")
            monitor.step(250, after=line)
            states["1:250"] = self.state_of(monitor)
        for tick, state in states.items():
            self.assertEqual(state, self.replayed_state("--until", tick))
        self.assertEqual(150, self.replayed_state("--until", "150")["tick"])
        self.assertIn("has no tick 5000", self.replay("--until", "5000", code=2).stderr)
        self.assertIn("C", self.replay("--print", "status").stdout)
        table, picture = self.folder / "joints.csv", self.folder / "end.svg"
        self.replay("--csv", table, "--every", "50", "--svg", picture)
        self.assertIn("<svg", picture.read_text(encoding="utf-8"))
        rows = list(csv.DictReader(table.read_text(encoding="utf-8").splitlines()))
        self.assertEqual([("0", str(tick)) for tick in range(0, 401, 50)]
                         + [("1", str(tick)) for tick in range(0, 251, 50)],
                         [(row["epoch"], row["tick"]) for row in rows])
        joint = next(joint for joint in states[200]["joints"] if joint["label"] == "E")
        row = next(row for row in rows if row["tick"] == "200")
        self.assertEqual((joint["count"], joint["value"]), (int(row["E_count"]), float(row["E_deg"])))

    def test_serve_goes_on_from_the_end(self):
        with Server("--record", self.file) as xr3, xr3.monitor() as monitor:
            line = xr3.line()
            line.send("E+60\r")
            monitor.step(200, after=line)
            monitor.call("snapshot_save", name="kept")
            state = self.state_of(monitor)
        server = Server(command=[XR3, "replay", self.file, "--serve"])
        at = server.options.index("--clock")
        del server.options[at:at + 2]
        with server as xr3, xr3.monitor() as monitor:
            self.assertEqual(state, self.state_of(monitor))
            self.assertEqual([{"epoch": 0, "from": 0, "to": 200}], monitor.call("history")["epochs"])
            self.assertEqual(100, monitor.call("seek", tick=100)["tick"], "what was recorded is the past")
            self.assertEqual(200, monitor.call("seek", epoch=0, tick=200)["tick"])
            monitor.call("resume")
            self.assertEqual(state["joints"], monitor.get()["joints"])
            line = xr3.line()
            line.number = 2
            line.ask("E?")
            monitor.step(10_000)
            self.assertEqual(ord(" "), line.ask("E?"))
            monitor.call("snapshot_load", name="kept")
            self.assertEqual(200, monitor.get()["tick"])

    def test_what_is_no_recording(self):
        other = self.folder / "other"
        for text in "", "{}\n", "hello\n", '{"xr3_recording":9}\n', '{"xr3_recording":1,"c":"AAAA"}\n':
            other.write_text(text, encoding="ascii")
            self.assertTrue(self.replay(file=other, code=2).stderr)
        self.assertIn("No such file", self.replay(file=self.folder / "none", code=2).stderr)
        self.assertIn("directory", self.replay(file=self.folder, code=2).stderr)


if __name__ == "__main__":
    unittest.main()
