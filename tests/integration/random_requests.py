"""Random valid and invalid requests, reproducible by their seed: each request has exactly one answer, which
matches the schema, and the server and its cell keep working. Used by test_random_requests.py and, with more
requests, by soak_requests.py."""

import json
import random

from support import Server

CHANNELS = ["state", "image", "display", "model", "event", "line"]
MEMBERS = ["joints", "tool", "blocks", "clock", "moving", "rows", "rev", "message", "hex", "status", "workcell", "event",
           "parsed"]
FUNCTIONS = ["display", "view", "home", "status", "enabled", "function_keys", "period", "path", "jump"]
BYTES = ["E+5\r", "E-100\r", "A+120\r", "A-60\r", "D+127\rD+127\r", "E?", "I", "A**", "A@", "A#", "A$", "Q",
         "LP3", "E+200\r", "z\0\x7f", "A!1,1,1!", "A%3", "\xff", "GET / HTTP/1.1\r\n\r\n"]
LAST_TICK = 2**53 - 1
ODD = [None, True, False, 0, 1, -1, 5, 2**31, 2**53 - 1, 2**53, -2**63, 10**30, 0.5, -0.0, 1e-9, 1e308, "", "red",
       "\0", "x" * 200, "\ud800", [], [1, 2, 3], [0, 0, 0], [None] * 3, {}, {"a": {"b": []}}, "main", "rle"]


class Asker:
    def __init__(self, seed):
        self.chance = random.Random(seed)
        self.snapshots = [{}]

    def one_of(self, *values):
        return self.chance.choice(values)

    def odd(self):
        return self.chance.choice(ODD)

    def length(self):
        return self.chance.choice([0, 1, 10.5, 20, 262, 320.675, -50, 1e5, 1e6])

    def point(self):
        return [self.length() for _ in range(3)]

    def name(self):
        return self.one_of("red", "green", "a", "b", "c", "nobody", "")

    def fields(self):
        return self.chance.sample(MEMBERS, self.chance.randint(0, 3))

    def args(self, fn):
        """Arguments of a call, mostly valid."""
        count = self.chance.randint
        makers = {
            "rate": lambda: {"factor": self.one_of(1, 0.001, 100, 100000, 0)},
            "step": lambda: {"ticks": count(0, 2000), **self.maybe(fields=self.fields(), after=self.after())},
            "run_until": lambda: {"max_ticks": count(0, 5000),
                                  **self.one_of({"idle": True}, {"tick": count(0, 10**5)})},
            "send": lambda: self.one_of({"text": self.chance.choice(BYTES)},
                                        {"hex": self.one_of("453f", "ff", "4", "")}),
            "inverse": lambda: {"xyz_mm": self.point(), **self.maybe(
                pitch_deg=count(-400, 400), roll_deg=count(-400, 400), branch=self.one_of("front, elbow up", "z"),
                near=self.one_of({}, {"E": 50}, {"E": 10**7}, {"Z": 1}))},
            "input": lambda: {"input": count(0, 9), "value": self.one_of(True, False)},
            "block_add": lambda: {"name": self.name(), "size_mm": self.point(), "xyz_mm": self.point(),
                                  "yaw_deg": count(-400, 400), "color": count(-1, 16)},
            "block_move": lambda: {"name": self.name(), **self.maybe(xyz_mm=self.point(), yaw_deg=count(-400, 400))},
            "block_remove": lambda: {"name": self.name()},
            "workcell": lambda: {"workcell": self.workcell()},
            "snapshot_save": lambda: self.one_of({"name": self.one_of("a", "b", "c" * 64)}, {"inline": True}),
            "snapshot_load": lambda: self.one_of({"name": self.one_of("a", "b", "z")},
                                                 {"snapshot": self.chance.choice(self.snapshots)}),
            "fault_set": lambda: {"fault": self.fault(), **self.maybe(seed=count(0, 9))},
            "fault_clear": lambda: self.maybe(name=self.one_of("a", "b", "c")),
            "trace": lambda: {"tick": count(0, 20000), **self.maybe(epoch=count(0, 3), every=count(5, 500))},
            "line_disconnect": lambda: {"line": count(0, 5)},
            "key": lambda: {"function": self.chance.choice(FUNCTIONS),
                            **self.maybe(value=self.one_of(3, [1, 2, 3], [0, 0, 0], 300))},
            "describe": lambda: self.maybe(fn=self.one_of("step", "fly")),
        }
        args = makers.get(fn, dict)()
        return self.spoiled(args) if self.chance.random() < 0.2 else args

    def maybe(self, **members):
        return {name: value for name, value in members.items() if self.chance.random() < 0.4}

    def after(self):
        return {"line": self.chance.randint(0, 4), "bytes_in": self.chance.randint(0, 30),
                "within_ms": self.one_of(0, 1, 5)}

    def workcell(self):
        blocks = [{"name": name, "size": [20, 30, 40], "centroid": self.point(), "yaw_deg": 5, "color": 3}
                  for name in self.chance.sample("abcdef", self.chance.randint(0, 4))]
        workcell = {"name": "random", "length_unit": self.one_of("mm", "inch"),
                    "workspace": {"x": 600, "y": 500, "z": 700}, "blocks": blocks,
                    **self.maybe(work_surface=self.length(), surface_stalls=True, camera={
                        "location": [290, 0, 1000], "field": [384, 384], "pixels": [self.chance.randint(0, 40), 30]})}
        return self.spoiled(workcell) if self.chance.random() < 0.3 else workcell

    def fault(self):
        """A fault, mostly valid."""
        kinds = {"byte_flipped": {"line": "any"}, "reply_lost": {}, "stray_byte": {"byte": 88}, "power_cycle": {},
                 "motor_stuck": {"joint": "E"}, "motor_slow": {"joint": "F", "percent": 7}, "grip_slip": {},
                 "encoder_slip": {"joint": "E"}, "switch_stuck_open": {"joint": "D"}, "camera_offset": {"rows": 3},
                 "switch_stuck_closed": {"joint": "G"}, "switch_bouncing": {"joint": "E"}, "camera_noise": {}}
        kind = self.chance.choice(list(kinds))
        trigger = self.one_of({"at_tick": self.chance.randint(0, 5000)}, {"probability": 0.2}, {"from_tick": 5})
        return {"name": self.one_of("a", "b", "c"), "kind": kind, **kinds[kind], **trigger,
                **self.maybe(ticks=self.chance.randint(0, 3000))}

    def spoiled(self, members):
        """A copy with an odd, an additional or a missing member, at any depth."""
        members = dict(members)
        if not members or self.chance.random() < 0.2:
            return {**members, self.one_of("more", "", "fields", "tick"): self.odd()}
        name = self.chance.choice(list(members))
        if isinstance(members[name], dict) and self.chance.random() < 0.6:
            members[name] = self.spoiled(members[name])
        elif self.chance.random() < 0.3:
            del members[name]
        else:
            members[name] = self.odd()
        return members

    def request(self, calls):
        what = self.chance.random()
        if what < 0.55:
            fn = self.chance.choice(calls)
            request = {"op": "call", "fn": fn, "args": self.args(fn)}
        elif what < 0.75:
            request = {"op": "get", "channel": self.chance.choice(CHANNELS),
                       **self.maybe(fields=self.fields(), encoding="rle", since=self.chance.randint(0, 5000))}
        elif what < 0.9:
            request = {"op": "sub", "channel": self.chance.choice(CHANNELS),
                       **self.maybe(fields=self.fields(), encoding="rle", since=self.chance.randint(0, 5000),
                                    on_change=False, max_hz=self.one_of(0.1, 1, 59.9, 60, 0))}
        else:
            request = {"op": self.one_of("unsub", "ping", "auth", "dance"), "channel": self.chance.choice(CHANNELS)}
        return self.spoiled(request) if self.chance.random() < 0.1 else request


def is_answer(message, number):
    """Whether the message answers the request of this number, or one that is no JSON (a lone surrogate)."""
    assert message is not None, f"closed after request {number}"
    if message["op"] == "result" and message["id"] is None:
        return message["error"]["code"] == "bad_json"
    return message.get("id") == number and message["op"] not in ("event", "line")


def ask(test, seed, requests, *options, clock="manual"):
    """Sends random requests from one client and checks the answers and the subscribed messages."""
    asker = Asker(seed)
    with Server("--log-level", "error", *options, clock=clock) as xr3, xr3.monitor() as monitor:
        calls = monitor.hello["calls"]
        for number in range(requests):
            request = {**asker.request(calls), "id": number}
            monitor.send(json.dumps(request).encode() + b"\n")
            answer = monitor.read(is_whole=False)
            while not is_answer(answer, number):
                answer = monitor.read(is_whole=False)
            if answer["op"] == "result" and answer["ok"] and "snapshot" in answer["value"]:
                asker.snapshots = [answer["value"]["snapshot"], *asker.snapshots[:3]]
            if answer["op"] == "result" and not answer["ok"]:
                test.assertNotEqual("internal", answer["error"]["code"], f"seed {seed}: {request}")
        with xr3.monitor() as other:
            lives_on(test, seed, other)


def lives_on(test, seed, monitor):
    """Checks that the state can be saved and loaded, that time advances, and that a reset works."""
    monitor.call("unfreeze")
    monitor.call("resume")  # a request may have taken the robot back to its past
    if monitor.get("clock")["clock"]["mode"] == "real":
        monitor.call("pause")
    if monitor.get()["tick"] > LAST_TICK - 1000:
        monitor.call("reset")  # a snapshot was of the end of time
    saved = monitor.call("snapshot_save", inline=True)
    monitor.call("step", ticks=1000)
    loaded = monitor.call("snapshot_load", snapshot=saved["snapshot"])
    test.assertEqual(saved["hash"], loaded["hash"], f"seed {seed}")
    monitor.call("reset")
    test.assertEqual(0, monitor.get()["tick"])
