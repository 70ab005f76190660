"""The arm at the other end of a serial line: bytes first, then what is made of them, from a single
move to picking up a block. It sends nothing that a real arm would not understand, but for
soft_home() and the camera.
"""

import socket
import sys
import time
from types import TracebackType
from typing import Callable, List, Optional, Type, Union

from xr3.address import connect as connect_line
from xr3.arms import RHINO_XR3
from xr3.kinematics import Arm, Counts, Pose, Unreachable
from xr3.vision import CAMERAS, Camera, Picture

SPACE = 32  # what every reply of one byte is counted from: a blank says 0
STRIDE = 60  # most counts of one move: the error counter has 8 bits and must not run over
CLOSING = 100  # counts that close the jaws on anything
LIFT_MM = 100.0  # how far above a block the tool comes and goes
POLL_S = 0.05  # between two questions
# A joint stands if its counter has been the same for 2 s of questions: the slowest speed is one
# count a second, and the simulator's clock may run slowly.
STANDS_AFTER = 40
MOST_COUNTS = 3000  # no joint has so far to go from one end of its way to the other
WHY_IT_STANDS = ("Is it blocked at a limit, or stalled? Is a block in the jaws? Does time stand, or "
                 "run slowly? Look at the page or at `xr3 watch`")


class RobotError(Exception):
    """The arm did not do what it was sent to do."""


class Robot:
    """A robot on a serial line over TCP. Use it in a `with`, or call close().

    Host and port come from XR3_HOST and XR3_PORT where they are not given, else localhost and 9600.
    `at` is where the motors are in counts from the soft home, for as long as they are moved by go()
    and what stands on it; at the start the arm is taken to be there. Every operation raises OSError
    when the line is gone and TimeoutError when an answer does not come within timeout_s.

    A joint counts as standing when its counter is the same for STANDS_AFTER questions, with
    `pause()` between two of them: POLL_S in the usual case, and 2 s in all."""

    def __init__(self, host: Optional[str] = None, port: Union[int, str, None] = None, *,
                 arm: Arm = RHINO_XR3, camera: Optional[Camera] = None, timeout_s: float = 10.0,
                 pause: Callable[[], None] = lambda: time.sleep(POLL_S)) -> None:
        self.arm = arm
        self.camera = camera or CAMERAS.get(arm.name) or Camera()
        self.at: Counts = dict.fromkeys(arm.labels, 0)
        self._pause = pause
        self._timeout_s = timeout_s
        self._socket = connect_line(host, port, "XR3_PORT", 9600, timeout_s)

    def __enter__(self) -> "Robot":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Ends the line. The robot goes on with what it was told."""
        self._socket.close()

    # --- Bytes.

    def send(self, text: str) -> None:
        """Sends commands. A move acts on the first byte behind its number: end it with `\\r`."""
        self._socket.sendall(text.encode("ascii"))

    def read(self, count: int) -> bytes:
        """Exactly so many bytes of replies."""
        reply = b""
        while len(reply) < count:
            try:
                part = self._socket.recv(count - len(reply))
            except socket.timeout:  # before Python 3.10 that is no TimeoutError
                raise TimeoutError(f"the robot did not answer within {self._timeout_s} s: is this "
                                   "the monitor port? The robot port is 9600") from None
            if not part:
                raise ConnectionError("the robot has closed the line")
            reply += part
        return reply

    def ask(self, inquiry: str) -> int:
        """Sends an inquiry and returns the byte that answers it, 0 to 255."""
        self.send(inquiry)
        return self.read(1)[0]

    # --- One joint.

    def move(self, label: str, counts: int) -> None:
        """Starts a move of -128 to 127 counts and does not wait for it."""
        if not -128 <= counts <= 127:
            raise ValueError(f"a move is -128...127 counts, not {counts}")
        self.send(f"{label}{counts:+d}\r")

    def to_go(self, label: str) -> int:
        """How many counts the joint has still to go, without their sign."""
        return self.ask(f"{label}?") - SPACE

    def error(self, label: str) -> int:
        """The same with its sign."""
        byte = self.ask(f"{label}T")
        return byte - 256 if byte > 127 else byte

    def switch_closed(self, label: str) -> bool:
        """Whether the joint's microswitch is closed."""
        return self.ask(f"{label}V") == 1

    def set_speed(self, label: str, counts_per_s: int) -> None:
        """Sets the speed of a joint, 1 to 255 counts a second."""
        if not 1 <= counts_per_s <= 255:
            raise ValueError(f"a speed is 1...255 counts a second, not {counts_per_s}")
        self.send(f"{label}{counts_per_s}S")

    def stop(self, label: str) -> None:
        """Stops the joint where it is."""
        self.send(f"{label}X")

    def wait(self, label: str) -> int:
        """Waits until the joint is there. A joint that stands (at a limit, the jaws at a block,
        the arm stalled, time held) is stopped. Returns the counts that were left: 0 if it got
        there."""
        left, same = self.to_go(label), 0
        while left and same < STANDS_AFTER:
            self._pause()
            before, left = left, self.to_go(label)
            same = same + 1 if left == before else 0
        if left:
            self.stop(label)
        return left

    # --- All joints.

    def go(self, counts: Counts) -> None:
        """Brings these motors to these counts, all together and in equal parts, and waits. Raises
        Unreachable where a joint would be past its limit, before anything moves, and RobotError
        where one does not get there."""
        past_limit = self.arm.past_limit({**self.at, **counts})
        if past_limit:
            raise Unreachable(f"{self.arm.name}: {past_limit}")
        way = {label: wanted - self.at[label] for label, wanted in counts.items()}
        parts = -(-max((abs(whole) for whole in way.values()), default=0) // STRIDE)
        for part in range(1, parts + 1):
            stuck = self._stride({label: whole * part // parts - whole * (part - 1) // parts
                                  for label, whole in way.items()})
            if stuck:
                short = (f"{label} stands at {self.at[label]}, "
                         f"{abs(counts[label] - self.at[label])} counts short of {counts[label]}"
                         for label in stuck)
                raise RobotError(f"{'; '.join(short)}. {WHY_IT_STANDS}")

    def _stride(self, way: Counts) -> List[str]:
        """Moves these joints together and waits; returns those that did not get there."""
        for label, counts in way.items():
            if counts:
                self.move(label, counts)
        return [label for label, counts in way.items() if not self._arrives(label, counts)]

    def _arrives(self, label: str, counts: int) -> bool:
        """Waits for the end of a move of so many counts, and keeps `at` right."""
        left = self.wait(label)
        self.at[label] = self.at.get(label, 0) + (counts - left if counts > 0 else counts + left)
        return left == 0

    def go_to(self, pose: Pose) -> None:
        """Brings the tool there, pointing down. Raises Unreachable or RobotError."""
        self.go(self.arm.solve(pose))

    def soft_home(self) -> None:
        """Puts the arm at its soft home at once, as only a simulator can."""
        self.send("A$")
        self.at = dict.fromkeys(self.arm.labels, 0)

    def home(self) -> None:
        """Brings every joint to its microswitch and opens the jaws: from then on `at` is right
        wherever the arm began. A joint that stands is put off until others have moved out of its
        way. It is for a robot that tells of a closed switch by 1, as in the profile paper. Raises
        RobotError."""
        if self.ask("I") - SPACE >= 32:  # the highest bit belongs to no switch
            raise RobotError("the switches tell 1 when they are open, as in the profile mark3; "
                             "home() is for the profile paper")
        waiting = list(self.arm.homing)
        for _ in range(4):
            before = dict(self.at)
            waiting = [label for label in waiting if not self._find_switch(label)]
            if not waiting or before == self.at:  # all found, or nothing moves any more
                break
        if waiting or not self._find_switch("A"):
            raise RobotError(f"no switch found by {''.join(waiting) or 'A'}. {WHY_IT_STANDS}")
        self.at = dict(self.arm.switches)

    def _find_switch(self, label: str) -> bool:
        """The edge at which the switch closes, coming from the open side. False: the joint
        stands."""
        way = 1 if self.arm.switches[label] > 0 else -1
        return all(self._creep(label, counts * way, until=counts > 0) for counts in (-5, 5, -1, 1))

    def _creep(self, label: str, counts: int, until: bool) -> bool:
        """Small moves until the switch is as wanted. False: the joint stands, or has gone its whole
        way, and it is not."""
        for _ in range(MOST_COUNTS // abs(counts)):
            if self.switch_closed(label) == until:
                return True
            self.move(label, counts)
            if not self._arrives(label, counts):
                break
        return self.switch_closed(label) == until

    # --- Seeing and grasping.

    def look(self) -> Picture:
        """What the camera sees."""
        self.send("A**")
        return Picture.decode(self.read(self.camera.picture_bytes), self.camera)

    def open_jaws(self) -> None:
        """Opens the jaws fully."""
        self.go({"A": self.arm.jaws.switch})

    def close_jaws(self) -> Optional[float]:
        """Closes the jaws until something is between them. Returns their opening in millimetres, or
        None if they closed on nothing. That they stand is known after 2 s, see wait(). What is left in the counter measures the block; it is
        cleared, or they could not open again."""
        self._stride({"A": -CLOSING})
        opening = self.arm.jaws.opening(self.at["A"])
        return opening if opening > self.arm.jaws.precision else None

    def pick(self, pose: Pose) -> Optional[float]:
        """Takes the block whose middle is there and lifts it; returns how wide the jaws found it,
        None if nothing was there. A block looks the same after half a turn: the way that turns the
        tool less is taken."""
        self.open_jaws()
        pose = self._nearer(pose)
        self.go_to(_above(pose))
        self.go_to(pose)
        width = self.close_jaws()
        self.go_to(_above(pose))
        return width

    def place(self, pose: Pose) -> None:
        """Puts down there what the jaws hold, and leaves it."""
        pose = self._nearer(pose)
        self.go_to(_above(pose))
        self.go_to(pose)
        self.open_jaws()
        self.go_to(_above(pose))

    def _nearer(self, pose: Pose) -> Pose:
        """Of the two yaws at which the jaws fit, the one with the smaller roll."""
        either = [Pose(pose.x, pose.y, pose.z, yaw) for yaw in (pose.yaw, pose.yaw + 180)]
        reachable = [each for each in either if self.arm.solutions(each)]
        if not reachable:
            raise Unreachable(f"{self.arm.name} at {pose}: a joint would be past its limit")
        return min(reachable, key=lambda each: abs(self.arm.solve(each)["B"]))


def _above(pose: Pose) -> Pose:
    return Pose(pose.x, pose.y, pose.z + LIFT_MM, pose.yaw)


def connect() -> Robot:
    """For a program that a person runs: the robot at the HOST and PORT of its command line, or as
    Robot() finds it. Where none answers, the program ends with a line that says so."""
    try:
        robot = Robot(*sys.argv[1:3], timeout_s=5)
        robot.ask("I")  # a robot answers at once, another server would not
        return robot
    except (OSError, ValueError) as error:
        sys.exit(str(error))
