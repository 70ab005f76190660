"""Forward and inverse kinematics between motor counts and the tip of the tool, for arms in general;
the three arms of xr3 are in arms.py. Lengths are in mm, angles in degrees. `Counts` maps the label
of each motor to its position in counts from the soft home.

Both work for any arm with a Denavit-Hartenberg table: Arm.load() reads one from a robot file.
Inverse kinematics (inverse.py) is for a tool that points straight down, as when picking blocks off a
table.
"""

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Callable, Dict, List, Optional, Sequence, Tuple, Union

from xr3 import arm_file
from xr3.address import check_type
from xr3.joints import IDENTITY, Jaws, Joint, Matrix, Pose, Switch, Unreachable, Ways, check_pose, product

Counts = Dict[str, int]


@dataclass(frozen=True)
class Arm:
    """The parameters of an arm, and its kinematics. `Arm.load()` reads them from a file. `joints`
    are in order from base to tool. A coupling (j, k, sign) means that joint j, counted from 0,
    moves joint k in the same (+1) or the opposite (-1) direction. `inverse` returns candidate joint
    variables for a pose. `homing` is the order in which joints are homed; those in `near_first`
    would run into the base if they leaned back, so they search for their switch towards the soft
    home first. `protected` is radius and height in mm of the protected region, a cylinder about the
    base axis: the robot stalls before its tip enters it. `mount` is the transformation from the
    base frame to frame 0. If the first joint slides and the arm on it has a closed form, `inverse`
    is that of the arm. `carousel` is the motor of a turntable, a Joint of which only the motor
    counts. `switches` has the edge of every switch."""

    name: str
    joints: Tuple[Joint, ...]
    jaws: Jaws
    inverse: Callable[[Sequence[Joint], Pose], Ways]
    homing: str
    protected: Tuple[float, float]
    coupling: Tuple[Tuple[int, int, int], ...] = ()
    near_first: str = ""
    mount: Tuple[Tuple[float, ...], ...] = IDENTITY
    is_on_slide: bool = False
    carousel: Optional[Joint] = None
    switches: Counts = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "switches",
                           {label: self.switch(label).edge for label in self.labels})

    def __repr__(self) -> str:
        return f"<Arm {self.name}>"  # all parameters would fill a page of help()

    def switch(self, label: str) -> Switch:
        """The microswitch of a joint, of the carousel or, for A, of the jaws."""
        motors = [*self.joints, *([self.carousel] if self.carousel else [])]
        return next((motor.switch for motor in motors if motor.label == label), self.jaws.switch)

    @classmethod
    def load(cls, file: Union[str, "os.PathLike[str]"]) -> "Arm":
        """The arm of a robot file in JSON, such as data/robots/rhino-xr3.json or one of your own:
        joints, limits, coupling, jaws and protected region come from the file, lengths in inches are
        converted, and the name is that of the file without its ending. Raises OSError if the file
        cannot be read, and ValueError if it is no robot file."""
        return arm_file.load(file, cls)

    @property
    def labels(self) -> str:
        """The joints' letters from the base to the tool, A, and that of the carousel, if any."""
        return ("".join(joint.label for joint in self.joints) + "A"
                + (self.carousel.label if self.carousel else ""))

    # --- Forward.

    def positions(self, counts: Counts) -> List[int]:
        """The position of each joint in counts: its own motor and the coupled ones."""
        check_counts(counts)
        motors = [counts.get(joint.label, 0) for joint in self.joints]
        return [motor + round(self._added(k, motors)) for k, motor in enumerate(motors)]

    def _added(self, k: int, motors: Sequence[float]) -> float:
        """The counts that coupled motors add to joint k. Couplings are defined on joint variables,
        so both directions enter."""
        way = self.joints[k].direction
        return sum(sign * self.joints[j].direction * way * motors[j]
                   for j, to, sign in self.coupling if to == k)

    def frame(self, counts: Counts) -> Matrix:
        """The tool frame in base coordinates; its columns are the normal, sliding and approach
        vectors and the tip."""
        result = [list(row) for row in self.mount]
        for joint, position in zip(self.joints, self.positions(counts)):
            result = product(result, joint.matrix(position))
        return result

    def slide_at(self, counts: Counts) -> Optional[float]:
        """The place of the slide in mm at these counts; None if the arm stands on none."""
        return self.joints[0].variable(self.positions(counts)[0]) if self.is_on_slide else None

    @property
    def is_upright(self) -> bool:
        """Whether the arm's own base axis points up, behind the mount and the slide."""
        return math.isclose(self._carrier(self.joints[0].home)[2][2], 1.0)

    def _carrier(self, slide: float) -> Matrix:
        """The pose of the arm itself, behind the mount and the slide."""
        mount = [list(row) for row in self.mount]
        return product(mount, self.joints[0].matrix_at(slide)) if self.is_on_slide else mount

    def tip(self, counts: Counts) -> Tuple[float, float, float]:
        """The position of the tool tip at these motor counts, mm."""
        x, y, z = (row[3] for row in self.frame(counts)[:3])
        return x, y, z

    def yaw(self, counts: Counts) -> float:
        """The direction of the tool's x axis about the vertical, in degrees from -180 to 180."""
        frame = self.frame(counts)
        return math.degrees(math.atan2(frame[1][0], frame[0][0]))

    # --- Inverse.

    def solve(self, pose: Pose, slide: Optional[float] = None) -> Counts:
        """The motor counts for a pose. Of several solutions, returns the one with the smallest
        maximum distance of a motor from the soft home. If the arm stands on a slide, this is kept at
        `slide` mm, or at its soft home. Raises Unreachable."""
        ways = self._ways(pose, slide)
        solutions = [counts for counts in ways if self.refusal(counts) is None]
        if not solutions:
            why = "; or ".join(dict.fromkeys(str(self.refusal(counts)) for counts in ways))
            raise Unreachable(f"{self.name} at {pose}: {why}")
        return min(solutions, key=lambda counts: max(abs(count) for count in counts.values()))

    def solutions(self, pose: Pose, slide: Optional[float] = None) -> List[Counts]:
        """All solutions for a pose within the limits and outside the protected region, with the
        slide as in solve(). Of angles that differ by whole turns, only the one nearest to the soft
        home. Without a closed form, those found. Raises Unreachable if the arm is too short."""
        return [counts for counts in self._ways(pose, slide) if self.refusal(counts) is None]

    def _ways(self, pose: Pose, slide: Optional[float]) -> List[Counts]:
        """Motor counts for each elbow configuration, whether allowed or not."""
        check_pose(pose)
        at = self.joints[0].home if slide is None else slide
        before = [at] if self.is_on_slide else []
        found = self.inverse(self.joints[len(before):], _seen_from(self._carrier(at), pose))
        return [self.motor_counts([joint.within(variable)
                                   for joint, variable in zip(self.joints, [*before, *variables])])
                for variables in found]

    def motor_counts(self, variables: Sequence[float]) -> Counts:
        """The rounded motor counts for these joint variables. Couplings are subtracted from the
        exact values before rounding, so that rounding errors do not add up."""
        exact = [joint.exact_counts(variable) for joint, variable in zip(self.joints, variables)]
        motors = list(exact)
        for _ in self.joints:  # as many times as a chain of couplings can be long
            motors = [position - self._added(k, motors) for k, position in enumerate(exact)]
        return {joint.label: _whole(motor) for joint, motor in zip(self.joints, motors)}

    # --- Limits and protected region.

    def allows(self, counts: Counts) -> bool:
        """Whether every joint is within its limits at these counts."""
        return self.past_limit(counts) is None

    def past_limit(self, counts: Counts) -> Optional[str]:
        """A message that names the joint past its limit at these counts; None if none is."""
        for joint, position in zip(self.joints, self.positions(counts)):
            if not joint.allows(position):
                low, high = joint.range
                return (f"joint {joint.label} would be past its limit, {position} counts from the "
                        f"soft home; it can be from {low} to {high}")
        return None

    def is_protected(self, counts: Counts) -> bool:
        """Whether the tip would be in the protected region, before which the robot stalls. Compares
        lengths in integer micrometres, as the simulator does."""
        x, y, z, radius, height = (round(1000 * mm) for mm in (*self.tip(counts), *self.protected))
        if self.is_on_slide:  # the region moves with the base
            now, home = (self._carrier(self.slide_at(at) or 0.0) for at in (counts, {}))
            x, y = (a - round(1000 * (now[k][3] - home[k][3])) for k, a in enumerate((x, y)))
        return z < height and x * x + y * y < radius * radius

    def refusal(self, counts: Counts) -> Optional[str]:
        """A message with the reason why these counts are not allowed; None if they are."""
        if self.is_protected(counts):
            radius, height = self.protected
            return (f"the tip would be in the protected region, nearer than {radius:g} mm to the "
                    f"base axis and lower than {height:g} mm")
        return self.past_limit(counts)


def check_counts(counts: object) -> None:
    """Raises ValueError if these are no counts by label."""
    check_type(counts, Mapping, "counts, such as {'E': 50}")


def _seen_from(frame: Matrix, pose: Pose) -> Pose:
    """The pose in a frame whose z axis points up."""
    x, y = pose.x - frame[0][3], pose.y - frame[1][3]
    cos, sin = frame[0][0], frame[1][0]
    return Pose(cos * x + sin * y, cos * y - sin * x, pose.z - frame[2][3],
                pose.yaw - math.degrees(math.atan2(sin, cos)))


def _whole(counts: float) -> int:
    return int(counts + math.copysign(0.5, counts))  # rounds halves away from 0, as xr3 kin does
