"""docs/monitor.md and the schema have every call with its arguments, every member of `state`, and every event with its
codes and members, and the values of those members that have few."""
# labels: full

import pathlib
import re
import unittest

from monitor_schema import load
from support import ROOT, Server


LISTED_ELSEWHERE = {"warning", "fault"}  # codes listed in docs/protocol.md and docs/faults.md


def part(heading):
    """The text below a heading of docs/monitor.md."""
    page = pathlib.Path(ROOT, "docs/monitor.md").read_text(encoding="utf-8")
    return page.split(f"\n## {heading}\n")[1].split("\n## ")[0]


def rows(heading):
    """The names in the first cells of the tables below a heading of docs/monitor.md."""
    return re.findall(r"^\| `(\w+)` \|", part(heading), re.MULTILINE)


def documented_events():
    """{event: (codes, members)} of the table of events."""
    table = re.findall(r"^\| `(\w+)` \| (.+?) \| (.*?)\|", part("Events"), re.MULTILINE)
    return {name: (quoted(codes), quoted(members)) for name, codes, members in table}


def quoted(text):
    return set(re.findall(r"`(\w+)`", text))


def events_of_schema():
    """{event: (codes, members)}; an event may have several forms."""
    schema = load("monitor-v1")["$defs"]
    common = {"op", "id", "cell", "epoch", "seq", "tick", "event", "line", "code", "message"}
    found = {}
    for name, form in schema.items():
        if name.startswith("event_") and "properties" in form:
            code = form["properties"]["code"]
            codes, members = found.setdefault(form["properties"]["event"]["const"], (set(), set()))
            codes.update(code.get("enum", [code["const"]] if "const" in code else []))
            members.update(set(form["properties"]) - common)
    return found


def values_of_schema():
    """{event: the values of its members that are one of a few words}"""
    schema = load("monitor-v1")["$defs"]
    found = {}
    for name, form in schema.items():
        if name.startswith("event_") and "properties" in form:
            words = found.setdefault(form["properties"]["event"]["const"], set())
            for member, values in form["properties"].items():
                if member != "code":
                    words.update(schema.get(values.get("$ref", "").removeprefix("#/$defs/"), values).get("enum", []))
    return found


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

    def test_events(self):
        documented, wanted = documented_events(), events_of_schema()
        self.assertEqual(set(documented), set(wanted))
        for event, (codes, members) in wanted.items():
            with self.subTest(event):
                if event not in LISTED_ELSEWHERE:
                    self.assertEqual(documented[event][0], codes)
                self.assertEqual(documented[event][1], members)

    def test_values_of_members_of_events(self):
        texts = dict(re.findall(r"^\| `(\w+)` \|.*\| (.*?) \|$", part("Events"), re.MULTILINE))
        for event, values in values_of_schema().items():
            with self.subTest(event):
                self.assertLessEqual(values, quoted(texts[event]))


if __name__ == "__main__":
    unittest.main()
