"""The arm at the other end of a serial line: bytes first, then what is made of them, from a single
move to picking up a block. It sends nothing that a real arm would not understand, but for
soft_home() and the camera.
"""

import os
import socket
import time
from types import TracebackType
from typing import Callable, List, Optional, Type, Union

from xr3.arms import RHINO_XR3
from xr3.kinematics import Arm, Counts, Pose, Unreachable
from xr3.vision import CAMERAS, Camera, Picture

SPACE = 32  # what every reply of one byte is counted from: a blank says 0
STRIDE = 60  # most counts of one move: the error counter has 8 bits and must not run over
CLOSING = 100  # counts that close the jaws on anything
LIFT_MM = 100.0  # how far above a block the tool comes and goes
POLL_S = 0.05  # between two questions; a motor of 20 counts/s and more makes a count meanwhile


class RobotError(Exception):
    """The arm did not do what it was sent to do."""


class Robot:
    """A robot on a serial line over TCP. Use it in a `with`, or call close().

    Host and port come from XR3_HOST and XR3_PORT where they are not given, else localhost and 9600.
    `at` is where the motors are in counts from the soft home, for as long as they are moved by go()
    and what stands on it; at the start the arm is taken to be there. Every operation raises OSError
    when the line is gone and TimeoutError when an answer does not come within timeout_s."""

    def __init__(self, host: Optional[str] = None, port: Union[int, str, None] = None, *,
                 arm: Arm = RHINO_XR3, camera: Optional[Camera] = None, timeout_s: float = 10.0,
                 pause: Callable[[], None] = lambda: time.sleep(POLL_S)) -> None:
        host = host or os.environ.get("XR3_HOST") or "localhost"
        port = int(port or os.environ.get("XR3_PORT") or 9600)
        self.arm = arm
        self.camera = camera or CAMERAS.get(arm.name) or Camera()
        self.at: Counts = dict.fromkeys(arm.labels, 0)
        self._pause = pause
        self._socket = socket.create_connection((host, port), timeout_s)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # bytes go out at once

    def __enter__(self) -> "Robot":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        self._socket.close()

    # --- Bytes.

    def send(self, text: str) -> None:
        """Sends commands. A move acts on the first byte behind its number: end it with `\\r`."""
        self._socket.sendall(text.encode("ascii"))

    def read(self, count: int) -> bytes:
        """Exactly so many bytes of replies. Raises EOFError when the line ends before."""
        reply = b""
        while len(reply) < count:
            part = self._socket.recv(count - len(reply))
            if not part:
                raise EOFError("the robot closed the line")
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
        """Sets the speed of a joint, 1 to 255 counts a second. Below 20, wait() takes it for
        standing."""
        if not 1 <= counts_per_s <= 255:
            raise ValueError(f"a speed is 1...255 counts a second, not {counts_per_s}")
        self.send(f"{label}{counts_per_s}S")

    def stop(self, label: str) -> None:
        """Stops the joint where it is."""
        self.send(f"{label}X")

    def wait(self, label: str) -> int:
        """Waits until the joint is there. A joint that makes no count between two questions stands
        (at a limit, or the jaws at a block) and is stopped. Returns the counts that were left: 0 if
        it got there."""
        left = self.to_go(label)
        while left:
            self._pause()
            before, left = left, self.to_go(label)
            if left == before:
                self.stop(label)
                break
        return left

    # --- All joints.

    def go(self, counts: Counts) -> None:
        """Brings these motors to these counts, all together and in equal parts, and waits. Raises
        RobotError where one of them does not get there."""
        way = {label: wanted - self.at[label] for label, wanted in counts.items()}
        parts = max(1, -(-max(abs(whole) for whole in way.values()) // STRIDE))
        for part in range(1, parts + 1):
            self._stride({label: whole * part // parts - whole * (part - 1) // parts
                          for label, whole in way.items()})

    def _stride(self, way: Counts) -> None:
        for label, counts in way.items():
            if counts:
                self.move(label, counts)
        stuck: List[str] = []
        for label, counts in way.items():
            left = self.wait(label)
            self.at[label] += counts - left if counts > 0 else counts + left
            if left:
                stuck.append(f"{label} stands {left} counts short of where it was sent")
        if stuck:
            raise RobotError("; ".join(stuck))

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
        way. Raises RobotError."""
        waiting = list(self.arm.homing)
        for _ in range(4 * len(waiting)):
            if waiting and not self._find_switch(waiting[0]):
                waiting.append(waiting[0])
            waiting = waiting[1:]
        if waiting or not self._find_switch("A"):
            raise RobotError(f"no switch found by {''.join(waiting) or 'A'}")
        self.at = dict(self.arm.switches)

    def _find_switch(self, label: str) -> bool:
        """The edge at which the switch closes, coming from the open side. False: the joint
        stands."""
        way = 1 if self.arm.switches[label] > 0 else -1
        return all(self._creep(label, counts * way, until=counts > 0) for counts in (-5, 5, -1, 1))

    def _creep(self, label: str, counts: int, until: bool) -> bool:
        """Small moves until the switch is as wanted. False: the joint stands and it is not."""
        while self.switch_closed(label) != until:
            self.move(label, counts)
            if self.wait(label):
                return self.switch_closed(label) == until
        return True

    # --- Seeing and grasping.

    def look(self) -> Picture:
        """What the camera sees."""
        self.send("A**")
        return Picture.decode(self.read(self.camera.picture_bytes), self.camera)

    def open_jaws(self) -> None:
        self.go({"A": self.arm.jaws.switch})

    def close_jaws(self) -> Optional[float]:
        """Closes the jaws until something is between them. Returns their opening in millimetres, or
        None if they closed on nothing. What is left in the counter measures the block; it is
        cleared, or they could not open again."""
        self.move("A", -CLOSING)
        left = self.wait("A")
        self.at["A"] -= CLOSING - left
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
