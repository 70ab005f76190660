"""Pixels, patches and their measures, with drawn pictures and with pictures of the camera."""

import json
import math
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from context import Server
from xr3 import ARMS, Camera, Monitor, Patch, Picture, Robot
from xr3.vision import CAMERAS

SMALL = Camera(x=0, y=0, width=20, height=6, columns=10, rows=3)
DATA = Path(os.environ.get("XR3_ROOT", Path(__file__).resolve().parents[3])) / "data"


def drawn(*rows):
    """The reply of a camera for a picture given as rows from the top."""
    reply = b""
    for row in rows:
        padded = row + "." * (-len(row) % 6)
        for start in range(0, len(padded), 6):
            bits = padded[start:start + 6].replace(".", "0").replace("#", "1")
            reply += bytes([32 + int(bits, 2)])
    return reply


class Decoding(unittest.TestCase):
    def test_the_example_of_the_protocol(self):
        picture = Picture.decode(b"\\$" + b"  " * 2, SMALL)
        self.assertEqual({(0, 0), (1, 0), (2, 0), (3, 0), (9, 0)}, picture.ones)

    def test_text_is_the_picture(self):
        rows = ["#........#", "..........", ".####....."]
        self.assertEqual("\n".join(rows), str(Picture.decode(drawn(*rows), SMALL)))

    def test_refuses_what_is_no_picture(self):
        with self.assertRaisesRegex(ValueError, "6 bytes, not 5"):
            Picture.decode(b" " * 5, SMALL)
        with self.assertRaisesRegex(ValueError, "byte 2"):
            Picture.decode(b"  \x1f   ", SMALL)
        with self.assertRaisesRegex(ValueError, "byte 0"):
            Picture.decode(b"\x60     ", SMALL)


class Patches(unittest.TestCase):
    def find(self, *rows):
        return Picture.decode(drawn(*rows), SMALL).patches()

    def test_corners_do_not_join_and_the_largest_is_first(self):
        patches = self.find("#.........", ".##.......", ".##.......")
        self.assertEqual([4, 1], [len(patch.pixels) for patch in patches])

    def test_nothing_in_the_picture(self):
        self.assertEqual([], self.find(*["." * 10] * 3))

    def test_measures_of_a_bar(self):
        patch, = self.find("..........", "..####....", "..........")
        self.assertEqual((16, -2, 0, 0), (patch.area, patch.x, patch.y, patch.yaw))
        self.assertAlmostEqual(math.sqrt(60), patch.length)  # from pixel centres 2 mm apart

    def test_direction_of_a_slope(self):
        camera = Camera(0, 0, 100, 100, 100, 100)
        patch = Patch.of({(k, 60 - k + side) for k in range(60) for side in (0, 1)}, camera)
        self.assertAlmostEqual(45, patch.yaw, delta=0.1)


class FromMonitor(unittest.TestCase):
    def test_is_that_of_each_arm(self):
        for name, camera in CAMERAS.items():
            with self.subTest(name), Server("--robot", name) as server, \
                    Monitor(port=server.monitor_port) as monitor:
                self.assertEqual(camera, Camera.from_monitor(monitor))
                self.assertEqual((camera.width / 192, camera.height / 192), camera.mm_per_pixel)
                for block in monitor.request("get", channel="model")["workcell"]["blocks"]:
                    self.assertEqual(camera.table, block["centroid"][2] - block["size"][2] / 2)

    def workcell(self, **members):
        return {"name": "bench", "length_unit": "inch", "workspace": {"x": 30, "y": 30, "z": 30},
                "work_surface": 2, "blocks": [], **members}

    def serve(self, workcell):
        path = Path(self.enterContext(tempfile.TemporaryDirectory())) / "bench.json"
        path.write_text(json.dumps(workcell), encoding="utf-8")
        return self.enterContext(Server("--workcell", str(path)))

    def test_inches_and_the_default_port(self):
        server = self.serve(self.workcell(
            camera={"location": [12, 1, 40], "field": [10, 5], "pixels": [100, 50]}))
        with mock.patch.dict(os.environ, XR3_HOST="", XR3_MONITOR_PORT=str(server.monitor_port)):
            camera = Camera.from_monitor()
        self.assertEqual((304.8, 25.4, 254, 127, 100, 50, 50.8),
                         (camera.x, camera.y, camera.width, camera.height, camera.columns, camera.rows,
                          camera.table))
        with Robot(port=server.robot_port, camera=camera) as robot:
            self.assertEqual([], robot.look().patches())

    def test_a_workcell_without_a_camera(self):
        server = self.serve(self.workcell())
        with Monitor(port=server.monitor_port) as monitor, \
                self.assertRaisesRegex(ValueError, "'bench' has no camera: add .* or start"):
            Camera.from_monitor(monitor)


class RealPictures(unittest.TestCase):
    def test_every_block_of_every_workcell(self):
        for arm in ARMS.values():
            blocks = json.loads((DATA / "workcells" / f"{arm.name}.json").read_text())["blocks"]
            with Server("--robot", arm.name) as server, \
                    Robot(port=server.robot_port, arm=arm) as robot:
                patches = robot.look().patches()
            self.assertEqual(len(blocks), len(patches))
            for block in blocks:
                with self.subTest(arm.name, block=block["name"]):
                    self.check(block, min(patches, key=lambda patch: self.distance(block, patch)))

    @staticmethod
    def distance(block, patch):
        return math.dist(block["centroid"][:2], (patch.x, patch.y))

    def check(self, block, patch):
        self.assertLess(self.distance(block, patch), 1)
        self.assertLess(abs(math.remainder(patch.yaw - block["yaw_deg"], 180)), 2)
        self.assertAlmostEqual(block["size"][0], patch.length, delta=2)
        self.assertAlmostEqual(block["size"][1], patch.width, delta=2)


if __name__ == "__main__":
    unittest.main()
