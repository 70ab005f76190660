"""What every example says where something is not as it expects: a plain sentence that names the
reason, an exit code that is not 0, and never an invented answer or a stack. examples.py runs this
for each language."""

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
NOT_THEIRS = re.compile(r"^make(\[\d+\])?: .*\n|^error: ignoring const execution_exception.*\n",
                        re.MULTILINE)  # make says that it failed; for Octave see its README


@dataclasses.dataclass
class Case:
    """`says` is looked for in what the example writes to standard error; None: it is to succeed.
    `before` is done to the robot first, `after` tells what is wrong with it at the end."""

    name: str
    example: str
    says: Optional[str]
    options: tuple = FAST
    port: str = "{robot}"
    host: str = "localhost"
    blocks: bool = True
    before: Callable = lambda robot: None
    after: Callable = lambda monitor: None


def stall(robot):
    """The shoulder bends back until the tip would enter the protected region."""
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


STANDS = r"E stands, 50 counts short of where it was sent\..*limit.*stalled.*xr3 watch"
NO_ROBOT = "no robot answers at localhost port 1: is the server running"
NO_PORT = "port has to be a number from 1 to 65535, not '{}'"
CASES = [
    Case("no server", "1_hello", NO_ROBOT, port="1"),
    Case("no server", "2_move_and_wait", NO_ROBOT, port="1"),
    Case("no number", "1_hello", NO_PORT.format("abc"), port="abc"),
    Case("no number", "2_move_and_wait", NO_PORT.format("70000"), port="70000"),
    Case("no such host", "2_move_and_wait", "no.host.invalid", host="no.host.invalid"),
    Case("an empty host", "1_hello", None, host=""),
    Case("the monitor port", "1_hello", "monitor port.* 9600", port="{monitor}"),
    Case("the monitor port", "2_move_and_wait", "monitor port.* 9600", port="{monitor}"),
    Case("time stands", "2_move_and_wait", STANDS, options=("--clock", "manual"),
         after=nothing_left),
    Case("time stands", "4_two_joints", "F stands, 40 counts short.*xr3 watch",
         options=("--clock", "manual"), after=nothing_left),
    Case("slow jaws", "3_home", None, options=("--clock", "real:10"),
         before=lambda robot: robot.send("A1S"), after=at_home),
    Case("another robot", "3_home", r"\bD\b.*switch.*Rhino XR-3",
         options=(*FAST, "--robot", "adept-one")),
    Case("another profile", "3_home", r"\bD\b.*mark3", options=(*FAST, "--compat", "mark3")),
    Case("stalled", "3_home", r"\bD\b.*stalled", before=stall),
    Case("no block", "5_pick_and_place",
         "the jaws closed on nothing: is the block at x 262, y 0 mm.*Rhino XR-3", blocks=False,
         after=at_home),
    Case("no block", "6_find_and_pick", "the camera sees no block", blocks=False, after=at_home),
]


def check_case(case, command, folder):
    """Runs the example as the case wants; returns what is wrong with it, or None."""
    with tempfile.TemporaryDirectory() as there, \
            Server(*case.options, *empty_table(case, there)) as server, \
            Monitor("localhost", server.monitor_port) as monitor:
        with Robot("localhost", server.robot_port) as robot:
            case.before(robot)
            robot.ask("I")  # now it has got all
        port = case.port.format(robot=server.robot_port, monitor=server.monitor_port)
        clean = {name: value for name, value in os.environ.items() if not name.startswith("XR3_")}
        ran = subprocess.run(command, shell=True, cwd=folder, text=True, stdin=subprocess.DEVNULL,
                             env={**clean, "XR3_HOST": case.host, "XR3_PORT": port},
                             capture_output=True, check=False, timeout=DEADLINE_S)
        return said_wrong(case, ran) or case.after(monitor)


def empty_table(case, folder):
    """Options for a workcell without blocks, where the case wants it."""
    if case.blocks:
        return ()
    cell = json.loads((ROOT / "data" / "workcells" / "rhino-xr3.json").read_text(encoding="utf-8"))
    cell["blocks"] = []
    path = Path(folder) / "empty.json"
    path.write_text(json.dumps(cell), encoding="utf-8")
    return "--workcell", str(path)


def said_wrong(case, ran):
    """What is wrong with how the example ended and what it said, or None."""
    said = NOT_THEIRS.sub("", ran.stderr)
    if (ran.returncode == 0) != (case.says is None):
        return f"it ended with {ran.returncode} and said\n{ran.stdout}{said}"
    if case.says is None:
        return None
    if not re.search(case.says, said):
        return f"it said\n{said}  where this was wanted: {case.says}"
    if STACK.search(said) or said.count("\n") != 1:
        return f"it said more than one sentence\n{said}"
    return None


def faults_of(language, command, folder):
    """Tries all of it in one language, whose first example is run by that command; returns the
    faults as lines."""
    def fault(case):
        try:
            wrong = check_case(case, command.replace("1_hello", case.example), folder)
        except subprocess.TimeoutExpired:
            wrong = f"it did not end within {DEADLINE_S} s"
        return wrong and f"{language}, {case.example}, {case.name}: {wrong}"
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
        return [wrong for wrong in pool.map(fault, CASES) if wrong]
