"""Recordings that `xr3 convert` makes MCAP files of, read by Foxglove's own reader."""

import json
import pathlib
import resource
import shutil
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, Server, XR3

READER = pathlib.Path(__file__).with_name("read_mcap.mjs")
NS_PER_TICK = 1_000_000
TOPICS = {"/tf": "foxglove.FrameTransforms", "/scene": "foxglove.SceneUpdate", "/blocks": "foxglove.SceneUpdate",
          "/camera": "foxglove.CompressedImage", "/events": "foxglove.Log", "/state": "xr3.State", "/wire": "foxglove.Log"}


class McapFile:
    """A file as Foxglove's reader finds it: what it says of itself, and its messages by topic as (tick, data)."""

    def __init__(self, path):
        done = subprocess.run(["node", READER, path], capture_output=True, text=True, timeout=5 * DEADLINE_S, check=False)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        head, *messages = map(json.loads, done.stdout.splitlines())
        self.head, self.messages = head, messages
        self.by_topic = {topic: [] for topic in TOPICS}
        for each in messages:
            self.by_topic[each["topic"]].append((each["logTime"] // NS_PER_TICK, each["data"]))

    def ticks(self, topic):
        return [tick for tick, _ in self.by_topic[topic]]

    def at(self, topic, tick):
        """The last message of a topic up to a tick, which is what a viewer shows then."""
        return [data for when, data in self.by_topic[topic] if when <= tick][-1]


@unittest.skipUnless(shutil.which("node"), "node is not installed (scripts/setup test)")
class Converted(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.recording = self.folder / "run.xr3rec"
        self.file = self.folder / "run.mcap"

    def record(self, act, *options, clock="manual"):
        with Server("--record", self.recording, *options, clock=clock) as xr3, xr3.monitor() as monitor:
            act(xr3, monitor)

    def convert(self, *options):
        done = subprocess.run([XR3, "convert", self.recording, self.file, *map(str, options)], capture_output=True, text=True,
                              timeout=10 * DEADLINE_S, check=False)
        self.assertEqual(0, done.returncode, done.stderr)
        self.memory_kib = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss  # memory of the largest program so far
        return McapFile(self.file)
