#!/usr/bin/python3
"""A robot without a workcell has an empty table in every command that takes one, by default and with --workcell none."""

import json
import pathlib
import re
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, ROOT, XR3, MonitorError, Server, run_xr3

EMPTY = {"name": "empty table", "length_unit": "mm", "workspace": {"x": 600, "y": 500, "z": 700}, "blocks": []}


class NoWorkcell(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.robot = self.folder / "my-arm.json"
        text = pathlib.Path(ROOT, "data/robots/rhino-xr3.json").read_text(encoding="utf-8")
        robot = json.loads(re.sub(r"(?m)^\s*\*.*$", "", text))
        del robot["links"], robot["tool"]["parts"]
        self.robot.write_text(json.dumps(robot), encoding="utf-8")

    def run_here(self, *arguments, code=0):
        done = run_xr3(*arguments, cwd=self.folder)
        self.assertEqual(code, done.returncode, done.stderr)
        return done

    def test_serve_has_an_empty_table_without_a_camera(self):
        for arguments in [("--robot", self.robot), ("--workcell", "none")]:
            with self.subTest(arguments), Server(*arguments) as xr3, xr3.monitor() as monitor:
                workcell = monitor.look("model")["workcell"]
                self.assertEqual(EMPTY, {key: workcell[key] for key in EMPTY})
                self.assertNotIn("camera", workcell)
                with self.assertRaises(MonitorError) as caught:
                    monitor.look("image")
                self.assertEqual("no_camera", caught.exception.code)

    def test_draw_has_lines_for_each_part_of_the_arm(self):
        self.run_here("draw", "a.svg", "--robot", self.robot)
        picture = (self.folder / "a.svg").read_text(encoding="utf-8")
        for part in "base", "link1", "link2", "link3", "link4", "tool", "finger+1", "finger-1", "surface":
            self.assertIn(f'"{part}"', picture)
        self.run_here("draw", "b.svg", "--robot", self.robot, "--workcell", "none")
        self.assertEqual(picture, (self.folder / "b.svg").read_text(encoding="utf-8"))

    def test_cells_exec_and_the_editor_take_none(self):
        with Server("--cell", "a=rhino-xr3,none", "--cell", f"b={self.robot},") as xr3:
            for cell in "ab":
                with xr3.monitor() as monitor:
                    self.assertEqual(EMPTY["name"], monitor.look("model", cell=cell)["workcell"]["name"])
        self.run_here("exec", "--workcell", "none", "--", "true")
        self.run_here("exec", "--robot", self.robot, "--", "true")
        done = subprocess.run([XR3, "workcell", "lab.json", "--from", "none"], cwd=self.folder, input="list\nquit\nno\n",
                              capture_output=True, text=True, timeout=DEADLINE_S, check=False)
        self.assertIn("empty table: 0 blocks, no camera", done.stdout, done.stderr)

    def test_names_of_workcells_have_none(self):
        self.assertIn("none", self.run_here("completion", "workcells").stdout.split())
        self.assertIn("use one of: adept-one, intelledex-660, none, rhino", self.run_here("draw", "a.svg", "--workcell", "nun", code=2).stderr)

    def test_a_recording_on_an_empty_table_replays(self):
        with Server("--robot", self.robot, "--record", self.folder / "run.xr3rec") as xr3, xr3.monitor() as monitor:
            monitor.call("send", text="E+20\r")
            monitor.call("run_until", idle=True, max_ticks=10000)
        self.run_here("replay", "run.xr3rec")


if __name__ == "__main__":
    unittest.main()
