"""docs/monitor.md and the schema have every call with its arguments, and every member of `state`."""

import pathlib
import re
import unittest

from monitor_schema import load
from support import ROOT, Server


def rows(heading):
    """The names in the first cells of the tables below a heading of docs/monitor.md."""
    page = pathlib.Path(ROOT, "docs/monitor.md").read_text(encoding="utf-8")
    part = page.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    return re.findall(r"^\| `(\w+)` \|", part, re.MULTILINE)


class Lists(unittest.TestCase):
    def test_calls(self):
        with Server() as xr3, xr3.monitor() as monitor:
            calls = {each["fn"]: each["args"] for each in monitor.call("describe")["calls"]}
        self.assertEqual(set(calls), set(rows("Calls")))
        schema = load("monitor-v1")["$defs"]
        for fn, args in calls.items():
            with self.subTest(fn):
                wanted = schema.get(f"args_{fn}", {})
                self.assertEqual({each["name"] for each in args}, set(wanted.get("properties", {})))
                self.assertEqual({each["name"] for each in args if each["required"]}, set(wanted.get("required", [])))

    def test_members_of_state(self):
        with Server() as xr3, xr3.monitor() as monitor:
            shown = set(monitor.get()) - {"op", "id", "cell", "epoch", "tick"}
        self.assertEqual(shown, set(rows("The state")))


if __name__ == "__main__":
    unittest.main()
