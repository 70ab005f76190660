"""A client of the robot port, from single bytes to picking up a block. It sends only commands that
a Rhino with its Mark III controller understands, except where a method says otherwise.
"""

import operator
import os
import re
import socket
import sys
import time
import warnings
from types import TracebackType
from typing import Callable, List, Optional, Sequence, Type, Union

import xr3
from xr3.address import check_type, connect as connect_line
from xr3.arms import RHINO_XR3
from xr3.joints import Pose, Unreachable, check_pose
from xr3.kinematics import Arm, Counts, check_counts
from xr3.line import straight
from xr3.monitor import server_version
from xr3.vision import CAMERAS, Camera, Picture

SPACE = 32  # added to one-byte replies: a blank means 0
STRIDE = 60  # maximum counts of one move: the 8-bit error counter must not overflow
CLOSING = 100  # counts that close the jaws from any opening
LIFT_MM = 100.0  # height above a block for approach and departure
POLL_S = 0.05  # pause between two questions, unless XR3_POLL_MS says otherwise
# A joint counts as stopped if its counter is the same for this many questions, over 2 s: the
# slowest speed is one count per second, and the simulator's clock may run slowly.
STANDS_AFTER = 40
STEP = 5  # counts of one move in the search for a switch; a switch stays closed for longer
LEAN = 400  # counts that bring a joint of Arm.near_first out of its backmost position
FAR = 1600  # more counts than any joint has from a limit to its switch
MARGIN = 40  # counts by which a switch may stay closed longer than Switch.width says
TEXT = "a text, such as 'E?'"
WHY_IT_STANDS = ("Is it blocked at a limit, or stalled? Did the arm start elsewhere than at its "
                 "soft home? Is a block in the jaws? Is the clock paused or slow? Look at the page, "
                 "or at `xr3 watch`")


def poll_pause() -> None:
    """The default of Robot.pause()."""
    time.sleep(float(os.environ.get("XR3_POLL_MS") or 1000 * POLL_S) / 1000)


class RobotError(Exception):
    """The arm did not do what it was told: a joint is blocked or was stopped, or a microswitch was
    not found. The message says which and where."""


class Robot:
    """A robot on a serial line over TCP. Use it in a `with` statement, or call `close()`.

    `host` and `port` default to the variables XR3_HOST and XR3_PORT, else to localhost and 9600.
    `arm` is the arm at the other end. `camera` defaults to that of the arm's own workcell; for an
    arm that xr3 does not supply, to the Rhino's.

    The attribute `at` has the position of each motor in counts from the soft home, by label, as
    tracked by `go()` and the methods that use it. The arm is assumed to start at the soft home. The
    attribute `table_mm` is the height of the table; `go_to()` and `line_to()` warn of poses below it.
    It is 0 until a program sets it.

    The constructor raises ValueError if the port is no port, and ConnectionError if no robot
    answers. All methods raise OSError if the connection is lost, and TimeoutError if an answer does
    not arrive within `timeout_s` seconds. A `label` that is no joint of the arm, a number that is
    not whole, or an argument of another type raises ValueError, and nothing is sent.

    A joint counts as stopped if its error counter is the same for 40 questions, with `pause()`
    between two of them: by default 0.05 s, so 2 s in total, or as many milliseconds as the variable
    XR3_POLL_MS says. `xr3 exec` sets it to 0 where simulated time follows the questions."""

    def __init__(self, host: Optional[str] = None, port: Union[int, str, None] = None, *,
                 arm: Arm = RHINO_XR3, camera: Optional[Camera] = None, timeout_s: float = 10.0,
                 pause: Callable[[], None] = poll_pause) -> None:
        check_type(arm, Arm, "an arm, such as xr3.ADEPT_ONE, or that of xr3.Arm.load(file)")
        check_type(camera or Camera(), Camera, "a camera, such as xr3.Camera(x=290)")
        self.arm = arm
        self.camera = camera or CAMERAS.get(arm.name) or Camera()
        self.at: Counts = dict.fromkeys(arm.labels, 0)
        self.table_mm = 0.0
        self._closed: Optional[bool] = None  # the bit of a closed switch, once it is known
        self._waiting: List[str] = []  # the joints that home() has still to find
        self._has_answered = False
        self._pause = pause
        self._timeout_s = timeout_s
        self._socket = connect_line(host, port, "XR3_PORT", 9600, timeout_s)

    def __enter__(self) -> "Robot":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Closes the connection. The robot completes its current moves."""
        self._socket.close()

    # --- Bytes.

    def send(self, text: str) -> None:
        """Sends commands, in ASCII, and does not wait. A move starts at the first byte after its
        number, so end it with a carriage return: `send("E+50\\r")`."""
        check_type(text, str, TEXT)
        self._socket.sendall(text.encode("ascii"))

    def read(self, count: int) -> bytes:
        """Reads exactly `count` bytes of replies. Waits for them for up to `timeout_s` seconds."""
        reply = b""
        while len(reply) < count:
            try:
                part = self._socket.recv(count - len(reply))
            except socket.timeout:  # a subclass of TimeoutError only since Python 3.10
                why = ("is it disabled (A@), or does it not know the inquiry?" if self._has_answered
                       else "is this the monitor port? The robot port is 9600")
                raise TimeoutError(f"the robot did not answer within {self._timeout_s} s: "
                                   f"{why}") from None
            if not part:
                raise ConnectionError("the robot has closed the line")
            self._has_answered = True
            reply += part
        return reply

    def ask(self, inquiry: str) -> int:
        """Sends an inquiry and returns the one-byte answer, 0 to 255. Raises ValueError, and sends
        nothing, if the text contains no inquiry (`?` `T` `V` `I` `J` `K` or `*`)."""
        check_type(inquiry, str, TEXT)
        if not re.search(r"[?TVIJK*]", inquiry, re.IGNORECASE):
            raise ValueError(f"{inquiry!r} is no inquiry, so that the robot does not answer: ask "
                             "'E?' for the counts that E still has to go; send() is for commands")
        self.send(inquiry)
        return self.read(1)[0]

    def _check(self, label: str, number: int = 0) -> None:
        """Raises ValueError if the label is no joint of the arm or the number is not whole. The
        server ignores such commands and does not answer such inquiries."""
        if label not in tuple(self.arm.labels):
            raise ValueError(f"there is no joint {label!r}: {self.arm.name} has the joints "
                             f"{', '.join(self.arm.labels)}, A being the jaws. For another robot "
                             "give its arm, as in Robot(arm=xr3.ADEPT_ONE)")
        try:
            operator.index(number)
        except TypeError:
            raise ValueError(f"joint {label}: counts are whole numbers, not {number!r}; round() "
                             "makes one") from None

    # --- One joint.

    def move(self, label: str, counts: int) -> None:
        """Starts a move by -128 to 127 counts and does not wait for it: see `wait()`. The counts
        are added to those that the joint still has to go. Raises ValueError for more counts."""
        self._check(label, counts)
        if not -128 <= counts <= 127:
            raise ValueError(f"a move is -128...127 counts, not {counts}: go() moves further")
        self.send(f"{label}{counts:+d}\r")

    def to_go(self, label: str) -> int:
        """The counts that the joint still has to go, 0 to 128, without the direction. A Mark III
        answers with seven bits, so that 128 counts look like 0 there."""
        self._check(label)
        byte = self.ask(f"{label}?")
        return byte - SPACE if byte >= SPACE else byte + 128 - SPACE

    def error(self, label: str) -> int:
        """The counts that the joint still has to go, with their sign, -128 to 127. A Mark III does
        not know this inquiry."""
        self._check(label)
        byte = self.ask(f"{label}T")
        return byte - 256 if byte > 127 else byte

    def switch(self, label: str) -> bool:
        """The joint's bit in the reply to I or J. Whether a closed microswitch reads 1 or 0 depends
        on the controller: it is True in the profile paper and False in mark3. Raises RobotError if
        the switch has no bit in either reply."""
        self._check(label)
        mask = self.arm.switch(label).mask
        if not mask:
            raise RobotError(f"the switch of joint {label} is in the reply neither to I nor to J")
        return (self.ask("J" if label in "AB" else "I") - SPACE) & mask != 0

    def set_speed(self, label: str, counts_per_s: int) -> None:
        """Sets the speed of a joint, 1 to 255 counts per second; else raises ValueError. Not for a
        Mark III: it has no such command and would read the number as a move."""
        self._check(label, counts_per_s)
        if not 1 <= counts_per_s <= 255:
            raise ValueError(f"a speed is 1...255 counts a second, not {counts_per_s}")
        self.send(f"{label}{counts_per_s}S")

    def stop(self, label: str) -> None:
        """Stops the joint at once and cancels the rest of its move."""
        self._check(label)
        self.send(f"{label}X")

    def pause(self) -> None:
        """Pauses between two questions: by default 0.05 s, or as many milliseconds as XR3_POLL_MS
        says."""
        self._pause()

    def wait(self, label: str) -> int:
        """Waits until the joint has arrived. If it is blocked (at a limit, jaws at a block, arm
        stalled, clock paused), cancels its move. Returns the counts that were left, 0 if it has
        arrived."""
        left, same = self.to_go(label), 0
        while left and same < STANDS_AFTER:
            self.pause()
            before, left = left, self.to_go(label)
            same = same + 1 if left == before else 0
        if left:
            self.stop(label)
        return left

    # --- All joints.

    def go(self, counts: Counts) -> None:
        """Moves these motors to these positions, in counts from the soft home by label, all
        together and in equal parts, and waits: `go({"E": 200, "D": -100})`. Other motors stay where
        they are. Raises ValueError if the arm has no such joint or a count is not whole, and
        Unreachable if a joint would be past its limit, both before anything moves. Raises
        RobotError if a joint does not arrive; `at` then has the positions where the joints
        stand."""
        check_counts(counts)
        for label, count in counts.items():
            self._check(label, count)
        past_limit = self.arm.past_limit({**self.at, **counts})
        if past_limit:
            raise Unreachable(f"{self.arm.name}: {past_limit}")
        way = {label: wanted - self.at[label] for label, wanted in counts.items()}
        parts = -(-max((abs(whole) for whole in way.values()), default=0) // STRIDE)
        for part in range(1, parts + 1):
            stuck = self._stride({label: whole * part // parts - whole * (part - 1) // parts
                                  for label, whole in way.items()})
            if stuck:
                short = (f"{label} stopped at {self.at[label]}, "
                         f"{abs(counts[label] - self.at[label])} counts short of {counts[label]}"
                         for label in stuck)
                raise RobotError(f"{'; '.join(short)}. {WHY_IT_STANDS}")

    def _stride(self, way: Counts) -> List[str]:
        """Moves these joints together and waits; returns those that did not arrive."""
        for label, counts in way.items():
            if counts:
                self.move(label, counts)
        return [label for label, counts in way.items() if not self._arrives(label, counts)]

    def _arrives(self, label: str, counts: int) -> bool:
        """Waits for the end of a move and updates `at`. Returns whether the joint has arrived."""
        left = self.wait(label)
        self.at[label] = self.at.get(label, 0) + (counts - left if counts > 0 else counts + left)
        return left == 0

    def go_to(self, pose: Pose) -> None:
        """Moves the tool to a pose, pointing down, and waits; a slide stays where it is. All motors
        move together, so the path of the tip is no straight line. Raises Unreachable before
        anything moves, also for a pose in the protected region, or RobotError. Warns of a pose
        below the table."""
        counts = self.arm.solve(pose, self.arm.slide_at(self.at))
        self._check_table(pose)
        self.go(counts)

    def line_to(self, pose: Pose, step_mm: float = 5.0) -> None:
        """Moves the tip to a pose on a straight line and waits, pointing down, in steps of at most
        `step_mm` mm; between them the path bends a little. The hand must point down before. Raises
        Unreachable before anything moves if the arm cannot be at some point of the line, ValueError
        if the step is not above 0, or RobotError. Warns of a pose below the table."""
        way = straight(self.arm, self.at, pose, step_mm)
        self._check_table(pose)
        for counts in way:
            self.go(counts)

    def _check_table(self, pose: Pose) -> None:
        if pose.z < self.table_mm:
            warnings.warn(f"{pose} is {self.table_mm - pose.z:g} mm below the table: the tip goes "
                          "into it, and the robot may stall", stacklevel=3)

    def soft_home(self) -> None:
        """Puts the arm at its soft home at once, without a move. Only the simulator can do this."""
        self.send("A$")
        self.at = dict.fromkeys(self.arm.labels, 0)

    def home(self) -> None:
        """Opens the jaws, and moves every joint to the edge of its microswitch that is nearer to
        the soft home. Afterwards `at` is correct, wherever the arm started, except for whole turns
        of a joint that meets its switch once a turn. It does not matter whether a closed switch
        reads 1 or 0: home() watches that of the jaws change. A joint whose switch is not found is
        retried after the others have moved. Raises RobotError."""
        for label in self.arm.labels:
            self.stop(label)  # cancels the rest of earlier moves
        self._closed, self._waiting = None, list(self.arm.homing)
        if not self._find_switch("A"):
            raise RobotError(f"no switch found by A. {WHY_IT_STANDS}")
        # A joint that leans back goes first: otherwise the others would fold the arm into its base.
        self._find([label for label in self.arm.near_first if self.switch(label) == self._closed])
        for _ in range(4):
            before = dict(self.at)
            self._find(self._waiting)
            if not self._waiting or before == self.at:  # all found, or nothing has moved
                break
        if self._waiting:
            raise RobotError(f"no switch found by {''.join(self._waiting)}. {WHY_IT_STANDS}")
        self.at = dict(self.arm.switches)

    def _find(self, labels: Sequence[str]) -> None:
        """Searches for these switches; those that are found no longer wait."""
        for label in list(labels):
            if self._find_switch(label):
                self._waiting.remove(label)

    def _find_switch(self, label: str) -> bool:
        """Moves to the near edge of the switch, from the open side. Returns False if the switch has
        not changed."""
        away = self.arm.switch(label).away
        if self._closed is None:
            if not self._learn_closed(label):
                return False
        elif self.switch(label) != self._closed and not self._search(label):
            return False
        # Back to the open side, and slowly up to the exact count at which the switch closes.
        return all(self._changes(label, counts * away, FAR) for counts in (-STEP, 1))

    def _learn_closed(self, label: str) -> bool:
        """Closes the switch while it is unknown how a closed switch reads, and learns that. Returns
        False if the switch has not changed."""
        switch = self.arm.switch(label)
        if not any(self._changes(label, STEP * way, FAR) for way in (switch.away, -switch.away)):
            return False
        # Back past every edge. On the side of the soft home the switch is open up to the limit, so
        # it is open if it has not changed for longer than it can be closed.
        while self._changes(label, -STEP * switch.away, switch.width + MARGIN):
            pass
        found = self._changes(label, STEP * switch.away, FAR)
        self._closed = self.switch(label)
        return found

    def _search(self, label: str) -> bool:
        """Moves until the open switch closes: away from the soft home and, where that ends, the
        other way. The joints of Arm.near_first start towards the soft home; they also lean there
        before another joint turns round, so that the arm does not fold into its base."""
        away = self.arm.switch(label).away
        if label in self.arm.near_first:
            return (self._changes(label, -STEP * away, LEAN)
                    or self._changes(label, STEP * away, 2 * FAR))
        if self._changes(label, STEP * away, FAR):
            return True
        for leaning in set(self.arm.near_first).intersection(self._waiting):
            self._changes(leaning, -STEP * self.arm.switch(leaning).away, LEAN)
        return self._changes(label, -STEP * away, 2 * FAR)

    def _changes(self, label: str, counts: int, farthest: int) -> bool:
        """Moves in steps of `counts` until the switch changes. Returns False if it does not within
        `farthest` counts, or up to the place where the joint is blocked."""
        before = self.switch(label)
        for _ in range(farthest // abs(counts)):
            self.move(label, counts)
            arrived = self._arrives(label, counts)
            if self.switch(label) != before:
                return True
            if not arrived:
                break
        return False

    # --- Seeing and grasping.

    def look(self) -> Picture:
        """Takes a picture with the camera of the simulator, whose size `camera` must have. Raises
        ValueError if the reply is no picture."""
        self.send("A**")
        return Picture.decode(self.read(self.camera.picture_bytes), self.camera)

    def open_jaws(self) -> None:
        """Opens the jaws fully and waits. Raises RobotError if they do not arrive."""
        self.go({"A": self.arm.jaws.fully_open})

    def close_jaws(self) -> Optional[float]:
        """Closes the jaws until something is between them. Returns their opening in mm, or None if
        they closed on nothing. Takes 2 s to detect that the jaws have stopped, see `wait()`. The
        counts left in the error counter give the width of the block and are then cleared, since
        otherwise the jaws could not open again."""
        self._stride({"A": -CLOSING * self.arm.jaws.direction})
        opening = self.arm.jaws.opening(self.at["A"])
        return opening if opening > self.arm.jaws.precision else None

    def pick(self, pose: Pose) -> Optional[float]:
        """Picks up the block whose centre is at the pose: opens the jaws, moves 100 mm above the
        pose, down, closes the jaws, and up again. Returns the width of the block in mm, or None if
        the jaws closed on nothing. A block looks the same after half a turn, so the yaw that needs
        the smaller roll of the tool is used. Raises Unreachable or RobotError."""
        pose = self._nearer(pose)
        self.open_jaws()
        self.go_to(_above(pose))
        self.go_to(pose)
        width = self.close_jaws()
        self.go_to(_above(pose))
        return width

    def place(self, pose: Pose) -> None:
        """Puts down the block in the jaws with its centre at the pose: moves 100 mm above it, down,
        opens the jaws, and up again. Raises Unreachable or RobotError."""
        pose = self._nearer(pose)
        self.go_to(_above(pose))
        self.go_to(pose)
        self.open_jaws()
        self.go_to(_above(pose))

    def _nearer(self, pose: Pose) -> Pose:
        """The pose, or the pose after half a turn, whichever needs the smaller roll."""
        check_pose(pose)
        either = [Pose(pose.x, pose.y, pose.z, yaw) for yaw in (pose.yaw, pose.yaw + 180)]
        slide, roll = self.arm.slide_at(self.at), self.arm.joints[-1].label
        reachable = [each for each in either if self.arm.solutions(each, slide)]
        if not reachable:
            raise Unreachable(f"{self.arm.name} at {pose}: a joint would be past its limit")
        return min(reachable, key=lambda each: abs(self.arm.solve(each, slide)[roll]))


def _above(pose: Pose) -> Pose:
    return Pose(pose.x, pose.y, pose.z + LIFT_MM, pose.yaw)


def connect(arm: Arm = RHINO_XR3, camera: Optional[Camera] = None, *,
            host: Optional[str] = None, port: Union[int, str, None] = None) -> Robot:
    """For interactive programs: a Robot at `host` and `port`, else at the HOST and PORT of the
    command line, else at its defaults. If no robot answers within 5 s, ends the program with a
    message of one line. Warns on standard error if a monitor port answers at the host, and its
    server has another version than the package."""
    there = [*sys.argv[1:3], None, None]
    try:
        robot = Robot(host or there[0], port or there[1], arm=arm, camera=camera, timeout_s=5)
        robot.ask("I")  # a robot answers at once, another kind of server does not
    except (OSError, ValueError) as error:
        sys.exit(str(error))
    _compare_versions(host or there[0])
    return robot


def _compare_versions(host: Optional[str]) -> None:
    """Warns if a server of another version answers at the monitor port."""
    server = server_version(host)
    if server is not None and server != f"xr3 {xr3.__version__}":
        print(f"xr3: the package has the version {xr3.__version__}, and the server at the monitor "
              f"port is {server}: use the package of its version", file=sys.stderr)
