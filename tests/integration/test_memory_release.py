"""Maximum memory and time for a message or a file of any structure: a small multiple of its size, and milliseconds.
Requests without the token need no memory."""
# labels: release serial

import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

from support import ROOT, XR3, Server
from test_access import TOKEN, TokenFile

MIB = 1 << 20
MOST_BYTES = 256 * 1024
MOST_TIMES = 10
CONSTANT = 2 * MIB  # the allocator's own, the socket's buffers, the answer
MOST_S = 0.250  # the first release needed 30 s; a busy machine needs more than the usual 50 ms
FILE_BYTES = 1_000_000


def long_name(member, size=MOST_BYTES):
    """A member with a long name and a list of zeros, together of about so many bytes."""
    return json.dumps({"n" * (size // 2 - 100): [0] * ((size // 2 - 100) // 2)}, separators=(",", ":"))[1:-1]


def call(fn, member, content):
    return ('{"op":"call","id":7,"fn":"%s","args":{"%s":{%s}}}\n' % (fn, member, content)).encode()


def fill(begin, item, end, size=MOST_BYTES):
    return begin + ",".join([item] * ((size - len(begin) - len(end)) // (len(item) + 1))) + end


LARGE = {
    "workcell": call("workcell", "workcell", long_name("w")),
    "snapshot": call("snapshot_load", "snapshot", long_name("s")),
    "blocks": call("workcell", "workcell", fill('"blocks":[', "{}", "]", MOST_BYTES - 200)),
    "ten thousand blocks": call("workcell", "workcell", '"blocks":[' + ",".join(["{}"] * 10_000) + "]"),
    "members": call("workcell", "workcell", ",".join('"%d":0' % i for i in range(27_000))),
    "duplicates": call("workcell", "workcell", fill("", '"a":0', "", MOST_BYTES - 200)),
}


def peak(xr3):
    """The largest resident set of a server so far, in bytes."""
    text = pathlib.Path(f"/proc/{xr3.pid}/status").read_text(encoding="ascii")
    return int(text.split("VmHWM:")[1].split()[0]) * 1024


class Requests(unittest.TestCase):
    def answer(self, monitor, line):
        self.assertLessEqual(len(line), MOST_BYTES + 1)
        started = time.perf_counter()
        monitor.send(line)
        answer = monitor.read()
        return answer, time.perf_counter() - started

    def test_requests_without_the_token_need_no_memory(self):
        with TokenFile() as path, Server("--token-file", path, "--private") as xr3, xr3.monitor() as monitor:
            monitor.send(b'{"op":"ping","more":"' + b"x" * 200_000 + b'"}\n')
            self.assertEqual("pong", monitor.read()["op"])
            before = peak(xr3)
            for name, line in LARGE.items():
                with self.subTest(name):
                    answer, took_s = self.answer(monitor, line)
                    self.assertEqual((7, "token_required"), (answer["id"], answer["error"]["code"]))
                    self.assertLess(took_s, MOST_S)
            self.assertLess(peak(xr3) - before, 4 * MIB)

    def test_requests_need_a_small_multiple_of_their_size(self):
        for name, line in LARGE.items():
            with self.subTest(name), TokenFile() as path, Server("--token-file", path) as xr3, xr3.monitor() as monitor:
                monitor.request("auth", token=TOKEN)
                monitor.send(call("workcell", "workcell", ""))
                self.assertEqual("bad_args", monitor.read()["error"]["code"])
                before = peak(xr3)
                answer, took_s = self.answer(monitor, line)
                self.assertEqual((7, "bad_args"), (answer["id"], answer["error"]["code"]))
                self.assertLessEqual(len(answer["error"]["details"]), 32)
                self.assertLess(peak(xr3) - before, MOST_TIMES * len(line) + CONSTANT)
                self.assertLess(took_s, MOST_S)
                if "XR3_SHOW" in os.environ:
                    print(f"{name}: {len(line)} bytes, {(peak(xr3) - before) / MIB:.1f} MiB, {took_s * 1000:.1f} ms")


class Rings(unittest.TestCase):
    def test_events_keep_no_workcells(self):
        """Each of the last 4,096 events kept the model of its time: 4,000 calls took 475 MiB."""
        workcell = json.loads(pathlib.Path(ROOT, "data/workcells/rhino-hundred.json").read_text(encoding="utf-8"))
        for history, bound in (("0", 4 * MIB), ("1h", 80 * MIB)):  # a history keeps calls, in 64 MiB
            with self.subTest(history=history), Server("--log-level", "error", "--history", history) as xr3, \
                    xr3.monitor() as monitor:
                for _ in range(10):
                    monitor.call("workcell", workcell=workcell)
                before = peak(xr3)
                for _ in range(6000):
                    monitor.call("workcell", workcell=workcell)
                self.assertLess(peak(xr3) - before, bound)


class Files(unittest.TestCase):
    MOST_S = 1.0

    def run_and_measure(self, file):
        """Exit code, standard error, most memory and time of `xr3 check`."""
        started = time.perf_counter()
        with tempfile.TemporaryFile() as report:
            with subprocess.Popen([XR3, "check", file], stdout=subprocess.DEVNULL, stderr=report) as process:
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
            took_s = time.perf_counter() - started
            report.seek(0)
            return process.returncode, report.read().decode(), usage.ru_maxrss * 1024, took_s

    def test_check_of_a_large_file(self):
        for name, text, words in [
            ("a long name", "{" + long_name("w", FILE_BYTES) + ',"blocks":[]}', ["unknown member", "..."]),
            ("the same in a robot", "{" + long_name("r", FILE_BYTES) + ',"joints":[]}', ["unknown member", "..."]),
            ("many members", '{"blocks":[],' + ",".join('"%d":0' % i for i in range(100_000)) + "}", ["unknown member", "more like these"]),
            ("many blocks", fill('{"blocks":[', "{}", "]}", 700), ["/blocks/0/name", "more like these"]),
            ("far too many blocks", fill('{"blocks":[', "0", "]}", FILE_BYTES), ["a list of 4", "0 to 256"]),
            ("many of one name", fill('{"blocks":[],', '"a":0', "}", FILE_BYTES), ['"a", a duplicate', "more like these"]),
            ("deep", '{"blocks":' + "[" * FILE_BYTES, ["deeper than 32"]),
            ("no JSON", fill('{"blocks":[', "0", ",]}", FILE_BYTES), ["allowed: a value"]),
        ]:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder, "large.json")
                file.write_text(text, encoding="ascii")
                # Directly before: the maximum of a child includes the memory of the parent that started it.
                _, _, usual, _ = self.run_and_measure(pathlib.Path(ROOT, "data/workcells/rhino-xr3.json"))
                code, report, most, took_s = self.run_and_measure(file)
                self.assertEqual(2, code, report[:1000])
                for word in words:
                    self.assertIn(word, report)
                self.assertLess(len(report), 64 * 1024)
                self.assertLess(most - usual, 12 * len(text) + CONSTANT)
                self.assertLess(took_s, self.MOST_S)
                if "XR3_SHOW" in os.environ:
                    print(f"{name}: {len(text)} bytes, {(most - usual) / MIB:.1f} MiB, {took_s * 1000:.0f} ms, {len(report)} bytes of report")


if __name__ == "__main__":
    unittest.main()
