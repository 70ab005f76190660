"""Reference recordings: what a version of xr3 has recorded, every later version replays without a difference.
tests/data/recordings has a folder for each version; its README says what they cover."""

import json
import pathlib
import re
import unittest

from support import ROOT, run_xr3

FOLDER = pathlib.Path(ROOT, "tests", "data", "recordings")
SUMMARY = r"(\d+) inputs repeated up to epoch (\d+), tick (\d+); everything is as recorded\n$"
INPUTS = {"open", "settings", "in", "input_ended", "silent", "close", "call", "seek", "device_in", "device_out"}
CALLS = ("pause resume rate step run_until reset home key device_stop mirror_align input block_add block_move "
         "block_remove workcell snapshot_save snapshot_load fault_set fault_clear").split()
FAULTS = ("byte_dropped byte_flipped byte_doubled stray_byte parity_error wrong_baud wrong_parity reply_lost "
          "reply_delayed reply_batched xoff_stall line_disconnected power_cycle motor_stuck motor_slow encoder_slip "
          "grip_slip switch_stuck_open switch_stuck_closed switch_bouncing camera_noise camera_dead_row "
          "camera_offset").split()
# Bytes of clients: an option of telnet, requests of RFC 2217, the camera.
BYTES = {"telnet": "\xff\xfb", "suspend": "\xff\xfa\x2c\x08", "resume": "\xff\xfa\x2c\x09", "purge": "\xff\xfa\x2c\x0c",
         "image": "A**"}
# The contents that the recordings of a version must have, in the words of kinds_of().
COVERED = {
    "0.1.0": {
        *(f"robot {name}" for name in ("Adept One", "Intelledex 660", "Rhino XR-3", "Rhino XR-3 with accessories")),
        "profile paper", "profile mark3", "clock real", "clock manual", "clock bytes", "settle", "one line at a time",
        "lines together", "line speed", "line speed of the client", "faults", "device", "mirror",
        *(f"open {kind}" for kind in ("tcp", "pty", "monitor")),
        *(f"guard {guard}" for guard in ("strict", "normal", "off")),
        *(f"close {why}" for why in ("client_closed", "stranger", "error", "shutdown", "disconnected", "fault")),
        *(f"call {name}" for name in CALLS), *(f"fault {kind}" for kind in FAULTS),
        *(f"device {what}" for what in ("opened", "lost", "silent")), "end stopped", "end limit",
        *INPUTS, "out", "unsent", "hash", "epoch", "us", "taken", "behind", "branch", "cell of a connection", *BYTES,
        *(f"{name} with line speed" for name in ("suspend", "resume", "purge"))}}


def recordings(version):
    return sorted((FOLDER / version).glob("*.xr3rec"))


def lines_of(file):
    """The header and the entries."""
    header, *entries = map(json.loads, file.read_text(encoding="ascii").splitlines())
    return header, entries


def is_refused(file):
    """Whether bytes were executed late, which no later version does."""
    return file.name.startswith("behind-")


def is_input(entry):
    return not INPUTS.isdisjoint(entry) or entry.get("device") in ("opened", "lost")


def kinds_of(header, entries):
    """The features of a recording: words for members, some with their value."""
    bytes_rules = header.get("byte_clock", {})
    yield f"robot {header['robot']['name']}"
    yield f"profile {header['profile']}"
    if re.fullmatch(r"[bc]\d+", header["cell"]):
        yield "branch" if header["cell"].startswith("b") else "cell of a connection"
    yield f"clock {header['clock']['mode']}"
    if bytes_rules:
        yield "lines together" if bytes_rules["concurrent_lines"] else "one line at a time"
        yield from ["settle"] if "settle_ms" in bytes_rules else []
    if "line_speed" in header:
        yield "line speed" if "settings" in header["line_speed"] else "line speed of the client"
    if "device" in header:
        yield "mirror" if header["device"]["mirrored"] else "device"
    if "faults" in header:
        yield "faults"
        yield from (f"fault {fault['kind']}" for fault in header["faults"]["faults"])
    for entry in entries:
        yield from entry
        for member in "open", "guard", "close", "call", "device", "end":
            yield from [f"{member} {entry[member]}"] if member in entry else []
        for name, data in BYTES.items():
            if data in entry.get("in", ""):
                yield name
                yield from [f"{name} with line speed"] if "line_speed" in header else []
        if entry.get("call") == "fault_set":
            yield f"fault {entry['args']['fault']['kind']}"


class ReferenceRecordings(unittest.TestCase):
    def test_every_version_has_recordings(self):
        versions = {path.name for path in FOLDER.iterdir() if path.is_dir()}
        self.assertEqual(set(), COVERED.keys() - versions)
        for version in sorted(versions):
            with self.subTest(version):
                self.assertTrue(recordings(version))
                self.assertEqual(recordings(version), sorted((FOLDER / version).iterdir()), "only recordings")

    def test_all_are_replayed(self):
        for file in sorted(FOLDER.glob("*/*.xr3rec")):
            with self.subTest(str(file.relative_to(FOLDER))):
                done = run_xr3("replay", file)
                if is_refused(file):
                    self.assertEqual(2, done.returncode)
                    self.assertRegex(done.stderr, r'behind-line-speed\.xr3rec:16: /acted: .*no entry "acted": .*replay')
                    continue
                self.assertEqual(0, done.returncode, done.stderr)
                summary = re.search(SUMMARY, done.stderr)
                self.assertTrue(summary, done.stderr)
                _, entries = lines_of(file)
                inputs, epoch, tick = map(int, summary.groups())
                self.assertEqual(sum(map(is_input, entries)), inputs)
                if entries[-1].get("end") == "stopped":
                    epochs = [entry["epoch"] for entry in entries if "epoch" in entry]
                    self.assertEqual(((epochs or [0])[-1], entries[-1]["tick"]), (epoch, tick))

    def test_what_the_recordings_of_a_version_cover(self):
        for version, wanted in COVERED.items():
            with self.subTest(version):
                kinds = {kind for file in recordings(version) for kind in kinds_of(*lines_of(file))}
                self.assertEqual(set(), wanted - kinds)

    def test_late_bytes_are_in_files_of_their_own(self):
        for file in sorted(FOLDER.glob("*/*.xr3rec")):
            _, entries = lines_of(file)
            self.assertEqual(is_refused(file), any("behind" in entry for entry in entries), file)

    def test_they_name_no_folder_of_the_machine(self):
        for file in sorted(FOLDER.glob("*/*.xr3rec")):
            header, entries = lines_of(file)
            peers = [entry["peer"] for entry in entries if "open" in entry]
            for place in [header.get("device", {}).get("path", ""), *peers]:
                self.assertNotIn("/", place, file)


if __name__ == "__main__":
    unittest.main()
