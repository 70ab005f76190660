"""Error handling of the examples: each prints one sentence with the reason and exits with a
non-zero code, without a stack trace. examples.py runs this for each language."""

import concurrent.futures
import dataclasses
import json
import os
import re
import subprocess
import tempfile
from pathlib import Path
from typing import Callable, Optional

from context import Server
from xr3 import Monitor, Robot

ROOT = Path(__file__).resolve().parents[2]
FAST = ("--clock", "real:50")
AT_ONCE = 3
DEADLINE_S = 120
STACK = re.compile(r"Traceback|node:internal|panicked|Exception in thread|^\s+at |called from|"
                   r"terminate called", re.MULTILINE)
NOT_THEIRS = re.compile(r"^make(\[\d+\])?: .*\n", re.MULTILINE)  # make reports the failure


@dataclasses.dataclass
class Case:
    """`says` is a regular expression for standard error; None if the example must succeed. `before`
    prepares the robot; `after` returns what is wrong with it at the end, or None."""

    name: str
    example: str
    says: Optional[str]
    options: tuple = FAST
    port: str = "{robot}"
    host: str = "localhost"
    environment: dict = dataclasses.field(default_factory=dict)
    blocks: bool = True
    before: Callable = lambda robot: None
    after: Callable = lambda monitor: None


def stall(robot):
    """Moves the shoulder back until the robot stalls at the protected region."""
    for _ in range(7):
        robot.move("E", -60)
        robot.wait("E")


def at_home(monitor):
    counts = monitor.counts()
    if any(counts.values()):
        return f"the motors are at {counts}, not at the soft home"
    return None


def nothing_left(monitor):
    monitor.settle()
    return at_home(monitor)


STOPPED = r"E stopped 50 counts short of its target\..*limit.*stalled.*xr3 watch"
NO_ROBOT = "no robot answers at localhost port 1: is the server running"
NO_PORT = "port has to be a number from 1 to 65535, not '{}'"
NO_PAUSE = {"XR3_POLL_MS": "0"}  # as xr3 exec sets it
CASES = [
    Case("no server", "1_hello", NO_ROBOT, port="1"),
    Case("no server", "2_move_and_wait", NO_ROBOT, port="1"),
    Case("no number", "1_hello", NO_PORT.format("abc"), port="abc"),
    Case("no number", "2_move_and_wait", NO_PORT.format("70000"), port="70000"),
    Case("no such host", "2_move_and_wait", "no.host.invalid", host="no.host.invalid"),
    Case("an empty host", "1_hello", None, host=""),
    Case("the monitor port", "1_hello", "monitor port.* 9600", port="{monitor}"),
    Case("the monitor port", "2_move_and_wait", "monitor port.* 9600", port="{monitor}"),
    Case("manual clock", "2_move_and_wait", STOPPED, options=("--clock", "manual"),
         after=nothing_left),
    Case("manual clock", "4_two_joints", "F stopped 40 counts short.*xr3 watch",
         options=("--clock", "manual"), environment=NO_PAUSE, after=nothing_left),
    Case("manual clock, no pause", "2_move_and_wait", STOPPED, options=("--clock", "manual"),
         environment=NO_PAUSE, after=nothing_left),
    Case("no pause", "5_pick_and_place", None, options=("--clock", "bytes:100"),
         environment=NO_PAUSE, after=at_home),
    Case("slow jaws", "3_home", None, options=("--clock", "real:10"),
         before=lambda robot: robot.send("A1S"), after=at_home),
    Case("another robot", "3_home", r"switch of D does not change.*Rhino XR-3",
         options=(*FAST, "--robot", "adept-one")),
    Case("stalled", "3_home", r"switch of A does not change.*stalled", before=stall),
    Case("no block", "5_pick_and_place",
         "the jaws closed on nothing: is the block at x 262, y 0 mm.*Rhino XR-3", blocks=False,
         after=at_home),
    Case("no block", "6_find_and_pick", "the camera sees no block", blocks=False, after=at_home),
]


def check_case(case, command, folder):
    """Runs the example of a case; returns what is wrong with it, or None."""
    with tempfile.TemporaryDirectory() as there, \
            Server(*case.options, *empty_table(case, there)) as server, \
            Monitor("localhost", server.monitor_port) as monitor:
        with Robot("localhost", server.robot_port) as robot:
            case.before(robot)
            robot.ask("I")  # all bytes sent before have been executed
        port = case.port.format(robot=server.robot_port, monitor=server.monitor_port)
        clean = {name: value for name, value in os.environ.items() if not name.startswith("XR3_")}
        ran = subprocess.run(command, shell=True, cwd=folder, text=True, stdin=subprocess.DEVNULL,
                             env={**clean, "XR3_HOST": case.host, "XR3_PORT": port, **case.environment},
                             capture_output=True, check=False, timeout=DEADLINE_S)
        return said_wrong(case, ran) or case.after(monitor)


def empty_table(case, folder):
    """Options for a workcell without blocks, if the case needs it."""
    if case.blocks:
        return ()
    cell = json.loads((ROOT / "data" / "workcells" / "rhino-xr3.json").read_text(encoding="utf-8"))
    cell["blocks"] = []
    path = Path(folder) / "empty.json"
    path.write_text(json.dumps(cell), encoding="utf-8")
    return "--workcell", str(path)


def said_wrong(case, ran):
    """The fault in the exit code or the messages of the example, or None."""
    said = NOT_THEIRS.sub("", ran.stderr)
    if (ran.returncode == 0) != (case.says is None):
        return f"it exited with {ran.returncode} and printed\n{ran.stdout}{said}"
    if case.says is None:
        return None
    if not re.search(case.says, said):
        return f"it printed\n{said}  expected: {case.says}"
    if STACK.search(said) or said.count("\n") != 1:
        return f"it printed more than one sentence\n{said}"
    return None


def faults_of(language, command, folder):
    """Runs all cases in one language, with `command` for its first example; returns the faults as
    lines."""
    def fault(case):
        try:
            wrong = check_case(case, command.replace("1_hello", case.example), folder)
        except subprocess.TimeoutExpired:
            wrong = f"it did not finish within {DEADLINE_S} s"
        return wrong and f"{language}, {case.example}, {case.name}: {wrong}"
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
        return [wrong for wrong in pool.map(fault, CASES) if wrong]
