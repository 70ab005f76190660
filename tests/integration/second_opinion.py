"""Compares the server with the model of tests/model on random programs: every reply at its tick, then the state, the
display and the diagnostics. Used by test_second_opinion.py and, with more programs, by soak_second_opinion.py."""

import collections
import contextlib
import math
import pathlib
import sys

from support import ROOT, Server, motors

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
from model.controller import Controller, Line  # noqa: E402
from model.programs import write_program  # noqa: E402
from model.robot import Robot, read_json  # noqa: E402
from model.state import state  # noqa: E402

ROBOTS = pathlib.Path(ROOT) / "data/robots"
MODEL = pathlib.Path(ROOT) / "tests/model"
PROFILES = ["paper", "mark3"]
SETUPS = [(ROBOTS / "rhino-xr3.json", MODEL / "far-block.json"),
          (MODEL / "odd-robot.json", MODEL / "far-block-stall.json"),
          (ROBOTS / "adept-one.json", MODEL / "far-block.json"),
          (ROBOTS / "rhino-xr3.json", MODEL / "far-block-stall.json"),
          (ROBOTS / "intelledex-660.json", MODEL / "far-block.json")]
LATE_S = 2.0  # for a reply that the kernel delivers late
ROUNDING = 0.0015  # mm or degrees
MOTOR_MEMBERS = ("count", "error", "speed", "value", "switch", "moving", "blocked")


class Difference(AssertionError):
    """The server and the model differ."""


def setup_of(seed):
    return SETUPS[seed % len(SETUPS)]


class Pair:
    """A server and its model, with the same robot, workcell and profile."""

    def __init__(self, profile, setup):
        self.profile = profile
        self.robot_file, workcell_file = setup
        self.robot = Robot(self.robot_file, profile)
        self.workcell = read_json(workcell_file)
        self.server = Server("--log-level", "off", "--compat", profile, "--robot", self.robot_file,
                             "--workcell", workcell_file)
        self.next_event = 1

    def __enter__(self):
        self.server.__enter__()
        self.monitor = self.server.monitor()
        return self

    def __exit__(self, *problem):
        self.monitor.close()
        self.server.__exit__(*problem)

    def program(self, seed):
        return write_program(seed, [motor.label for motor in self.robot.motors])

    def compare(self, program):
        """Runs a program from a reset on; raises Difference at the first difference."""
        self.monitor.call("reset")
        self.seen_warnings()
        self.model = Controller(self.robot, self.profile, self.workcell)
        self.lines = {}
        try:
            for step in program:
                getattr(self, step[0])(*step[1:])
            self.compare_ends()
        finally:
            for number in list(self.lines):
                self.close(number)

    # Steps of a program, by name

    def send(self, number, data, ticks):
        if number not in self.lines:
            self.lines[number] = self.server.line(), Line(self.model)
            data = b"\r" + data  # after a CR, the robot port does not wait for an HTTP client
        line, model_line = self.lines[number]
        line.send(data)
        expected = model_line.send(data)
        self.monitor.step(ticks, after=line, fields=[])
        seen = read_reply(line, len(expected))
        if expected != seen:
            raise Difference(f"tick {self.model.machine.tick}: the reply to {data!r}\n"
                             f"  expected {expected!r}\n  seen     {seen!r}")
        self.model.machine.advance(ticks)

    def close(self, number):
        if number in self.lines:
            self.lines.pop(number)[0].close()

    def input(self, number, value):
        self.model.inputs[number - 1] = value
        self.monitor.call("input", input=number, value=value)

    def home(self):
        self.model.soft_home()
        self.monitor.call("home")

    def reset(self):
        self.model.reset()
        for _, model_line in self.lines.values():
            model_line.parser.reset()
        self.monitor.call("reset")

    # The comparison after a program

    def compare_ends(self):
        expected = {**state(self.model), "warnings": dict(collections.Counter(self.model.warnings))}
        seen = {**self.seen_state(), "warnings": dict(self.seen_warnings())}
        different = [name for name in expected if not alike(expected[name], seen[name])]
        if different:
            raise Difference("\n".join([f"tick {expected['tick']}: the state after the program",
                                        *(f"  {name}: expected {expected[name]}\n  {name}: seen     {seen[name]}"
                                          for name in different)]))

    def seen_state(self):
        """The state and the display of the server, in the form of the model's."""
        seen, display = self.monitor.get(), self.monitor.look("display")
        return {**{label: {member: motor[member] for member in MOTOR_MEMBERS} for label, motor in motors(seen).items()},
                "tip": seen["tool"]["xyz_mm"], **seen["switches"], **seen["io"],
                **{member: seen[member] for member in ("moving", "stalled", "enabled", "tick")},
                "display": {**{member: display[member] for member in ("on", "view", "erase", "period_ticks")},
                            "status": display["status"]["option"]}}

    def seen_warnings(self):
        """The number of reports of each diagnostic since the last call."""
        counter = collections.Counter()
        for event in self.monitor.recall("event", since=self.next_event, fields=["event", "code", "count"]):
            self.next_event = event["seq"] + 1
            if event["event"] == "warning":
                counter[event["code"]] += event["count"]
        return counter


def read_reply(line, size):
    """All bytes that have arrived; waits a little if they are fewer than `size`."""
    seen = line.unread() or b""
    line.socket.settimeout(LATE_S)
    with contextlib.suppress(TimeoutError, EOFError, ConnectionResetError):
        while len(seen) < size:
            seen += line.read(1)
    return seen


def alike(expected, seen):
    """Whether two values are equal; lengths and angles may be rounded differently."""
    if isinstance(expected, float):
        return math.isclose(expected, seen, abs_tol=ROUNDING)
    if isinstance(expected, dict):
        return expected.keys() == seen.keys() and all(alike(expected[name], seen[name]) for name in expected)
    if isinstance(expected, list):
        return len(expected) == len(seen) and all(map(alike, expected, seen))
    return expected == seen


def difference(pair, program):
    """The message about the first difference, or "" if there is none."""
    try:
        pair.compare(program)
    except (Difference, OSError) as error:
        return str(error)
    return ""


def shortened(pair, program):
    """A program that still fails, after the removal of every step that is not needed for that."""
    size = len(program)
    while size:
        start = 0
        while start < len(program):
            shorter = program[:start] + program[start + size:]
            if difference(pair, shorter):
                program = shorter
            else:
                start += size
        size //= 2
    return program


def report(pair, seed, program, message):
    """A description of a failure, with the command that repeats it."""
    return "\n".join([f"seed {seed}: {' '.join(pair.server.options)}", *map(str, program), message,
                      "Repeat it from the root of the project with", "  XR3=$PWD/build/release/xr3 XR3_ROOT=$PWD "
                      f"/usr/bin/python3 tests/integration/soak_second_opinion.py {seed}"])
