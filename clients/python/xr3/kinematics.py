"""From motor counts to the tip of the tool and back. Lengths are millimetres, angles degrees; a
`Counts` is how far each motor is from the soft home, by its label. Knows arms in general; the three
of xr3 are in arms.py.

The way forward works for every arm that a Denavit-Hartenberg table describes. The way back is here
for a tool that points straight down, as it does for picking blocks off a table, in closed form.
"""

import math
from dataclasses import dataclass, field
from typing import Callable, Dict, List, Optional, Sequence, Tuple

Counts = Dict[str, int]
Ways = Sequence[Sequence[float]]  # joint variables from the base, for each way of the elbow
Matrix = List[List[float]]  # four rows of four: turns and shifts in one, as in the textbooks


class Unreachable(ValueError):
    """The arm cannot put its tool there; the message says why."""


@dataclass(frozen=True)
class Pose:
    """Where the tip of a tool is that points straight down. `yaw` is the direction of the tool's x
    axis about the vertical, from the x axis of the table: a block of this yaw lies flat between the
    jaws."""

    x: float
    y: float
    z: float
    yaw: float = 0.0


@dataclass(frozen=True)
class Joint:
    """One row of the Denavit-Hartenberg table, at the soft home, and what its motor does to it.
    `precision` is degrees (or millimetres, where the joint slides) a count, `direction` +1 or -1;
    the limits are those of the variable. `switch` is the motor's count at which the microswitch
    closes."""

    label: str
    theta: float
    d: float
    a: float
    alpha: float
    precision: float
    limits: Tuple[float, float]
    switch: int
    direction: int = 1
    slides: bool = False

    @property
    def home(self) -> float:
        """The joint variable at count 0."""
        return self.d if self.slides else self.theta

    def variable(self, position: int) -> float:
        """The joint variable, in degrees or millimetres, at this position in counts."""
        return self.home + self.direction * self.precision * position

    def exact_counts(self, variable: float) -> float:
        """The position in counts, not yet rounded, at which the joint has this variable."""
        return (variable - self.home) / (self.direction * self.precision)

    @property
    def range(self) -> Tuple[int, int]:
        """The first and the last position within the limits (a millionth of a count is not looked
        at)."""
        low, high = sorted(self.exact_counts(limit) for limit in self.limits)
        return math.ceil(low - 1e-6), math.floor(high + 1e-6)

    def allows(self, position: int) -> bool:
        """Whether the position lies within the limits."""
        low, high = self.range
        return low <= position <= high

    def within(self, variable: float) -> float:
        """The same direction, whole turns added or taken away: within the limits where that can be,
        and as near as can be to the soft home. Where the joint slides there is only one."""
        if self.slides:
            return variable
        nearest = near(variable, self.home)
        return min((nearest, nearest + 360, nearest - 360), key=self._beyond)

    def _beyond(self, variable: float) -> float:
        """How far the variable is past the limits; what rounds to a count within them is not."""
        low, high = (self.variable(position) for position in self.range)
        low, high = min(low, high) - self.precision / 2, max(low, high) + self.precision / 2
        return max(low - variable, variable - high, 0.0)

    def matrix(self, position: int) -> Matrix:
        """The frame at the far end of this link, seen from the frame before it."""
        variable = self.variable(position)
        theta, d = (self.theta, variable) if self.slides else (variable, self.d)
        turn, twist = math.radians(theta), math.radians(self.alpha)
        ct, st, ca, sa = math.cos(turn), math.sin(turn), math.cos(twist), math.sin(twist)
        return [[ct, -ca * st, sa * st, self.a * ct],
                [st, ca * ct, -sa * ct, self.a * st],
                [0.0, sa, ca, d],
                [0.0, 0.0, 0.0, 1.0]]


@dataclass(frozen=True)
class Jaws:
    """The tool, joint A. `home` is the opening at count 0 in millimetres or, for fingers that turn
    (`finger` is their length in millimetres), the angle between them in degrees. `switch` is the
    count at which they are fully open."""

    precision: float
    home: float
    switch: int
    finger: Optional[float] = None

    def opening(self, count: int) -> float:
        """Millimetres between the fingertips at this count."""
        value = self.home + self.precision * count
        return value if self.finger is None else 2 * self.finger * math.sin(math.radians(value) / 2)


@dataclass(frozen=True)
class Arm:
    """The data sheet of an arm. `joints` go from the base to the tool. A coupling (j, k, sign) says
    that joint j, counted from 0, turns joint k with (+1) or against (-1) itself. `inverse` gives
    the candidates for a pose as joint variables. `protected` is radius and height in millimetres of
    the cylinder about the base axis in which the robot stalls before its tip comes in."""

    name: str
    joints: Tuple[Joint, ...]
    jaws: Jaws
    inverse: Callable[[Pose], Ways]
    homing: str
    protected: Tuple[float, float]
    coupling: Tuple[Tuple[int, int, int], ...] = ()
    switches: Counts = field(init=False)

    def __post_init__(self) -> None:
        switches = {joint.label: joint.switch for joint in self.joints}
        object.__setattr__(self, "switches", {**switches, "A": self.jaws.switch})

    @property
    def labels(self) -> str:
        """The joints' letters from the base to the tool, which is A."""
        return "".join(joint.label for joint in self.joints) + "A"

    # --- Forward.

    def positions(self, counts: Counts) -> List[int]:
        """What each joint does: the counts of its own motor and what other motors add."""
        motors = [counts.get(joint.label, 0) for joint in self.joints]
        return [motor + round(self._added(k, motors)) for k, motor in enumerate(motors)]

    def _added(self, k: int, motors: Sequence[float]) -> float:
        """What other motors add to joint k. Couplings speak of joint variables, so that in counts
        both directions enter."""
        way = self.joints[k].direction
        return sum(sign * self.joints[j].direction * way * motors[j]
                   for j, to, sign in self.coupling if to == k)

    def frame(self, counts: Counts) -> Matrix:
        """The tool's frame in the base frame: columns normal, sliding and approach vector, and the
        tip."""
        result = [[float(i == j) for j in range(4)] for i in range(4)]
        for joint, position in zip(self.joints, self.positions(counts)):
            result = _product(result, joint.matrix(position))
        return result

    def tip(self, counts: Counts) -> Tuple[float, float, float]:
        """Where the tip of the tool is at these motor counts."""
        x, y, z = (row[3] for row in self.frame(counts)[:3])
        return x, y, z

    def yaw(self, counts: Counts) -> float:
        """The direction of the tool's x axis about the vertical, in degrees from -180 to 180."""
        frame = self.frame(counts)
        return math.degrees(math.atan2(frame[1][0], frame[0][0]))

    # --- Back.

    def solve(self, pose: Pose) -> Counts:
        """The motor counts that bring the tool there, pointing down; of several ways the one that
        turns the busiest motor least from the soft home. Raises Unreachable."""
        ways = self._ways(pose)
        solutions = [counts for counts in ways if self.refusal(counts) is None]
        if not solutions:
            why = "; or ".join(dict.fromkeys(str(self.refusal(counts)) for counts in ways))
            raise Unreachable(f"{self.name} at {pose}: {why}")
        return min(solutions, key=lambda counts: max(abs(count) for count in counts.values()))

    def solutions(self, pose: Pose) -> List[Counts]:
        """Every way to bring the tool there within the limits and outside the protected region.
        Raises Unreachable where the arm is too short."""
        return [counts for counts in self._ways(pose) if self.refusal(counts) is None]

    def _ways(self, pose: Pose) -> List[Counts]:
        """Motor counts for each way that the elbow can lie, whether they are allowed or not."""
        return [self.motor_counts([joint.within(variable)
                                   for joint, variable in zip(self.joints, variables)])
                for variables in self.inverse(pose)]

    def motor_counts(self, variables: Sequence[float]) -> Counts:
        """The motors' whole counts that give these joint variables. What one joint adds to another
        is taken out of the exact numbers, and then each motor is rounded, so that two roundings
        never meet in one joint."""
        exact = [joint.exact_counts(variable) for joint, variable in zip(self.joints, variables)]
        motors: List[float] = []
        for k, position in enumerate(exact):
            motors.append(position - self._added(k, motors))
        return {joint.label: _whole(motor) for joint, motor in zip(self.joints, motors)}

    # --- What the arm may do.

    def allows(self, counts: Counts) -> bool:
        """Whether every joint is within its limits at these counts."""
        return self.past_limit(counts) is None

    def past_limit(self, counts: Counts) -> Optional[str]:
        """Which joint would be past its limit at these counts, as a sentence; None if none."""
        for joint, position in zip(self.joints, self.positions(counts)):
            if not joint.allows(position):
                low, high = joint.range
                return (f"joint {joint.label} would be past its limit, {position} counts from the "
                        f"soft home; it can be from {low} to {high}")
        return None

    def is_protected(self, counts: Counts) -> bool:
        """Whether the tip would be in the protected region: the robot stalls before it comes in.
        Lengths are compared in whole micrometres, as the robot does."""
        x, y, z, radius, height = (round(1000 * mm) for mm in (*self.tip(counts), *self.protected))
        return z < height and x * x + y * y < radius * radius

    def refusal(self, counts: Counts) -> Optional[str]:
        """Why the robot would not go there, as a sentence; None if it would."""
        if self.is_protected(counts):
            radius, height = self.protected
            return (f"the tip would be in the protected region, nearer than {radius:g} mm to the "
                    f"base axis and lower than {height:g} mm")
        return self.past_limit(counts)


def two_links(out: float, up: float, first: float, second: float) -> List[Tuple[float, float]]:
    """The directions in degrees of two links that lead from (0, 0) to (out, up): with the elbow
    above the straight way, and below it. Raises Unreachable where they are too short, or the point
    is too near."""
    reach = math.hypot(out, up)
    if not abs(first - second) <= reach <= first + second or reach == 0:
        raise Unreachable(f"the wrist would have to be {reach:.1f} mm from the shoulder; "
                          f"the links reach {abs(first - second):.1f} to {first + second:.1f} mm")
    way = math.atan2(up, out)
    inside = math.acos(_cosine((reach**2 + first**2 - second**2) / (2 * reach * first)))
    bend = math.acos(_cosine((reach**2 - first**2 - second**2) / (2 * first * second)))
    return [(math.degrees(way + sign * inside), math.degrees(way + sign * (inside - bend)))
            for sign in (1, -1)]


def near(angle: float, middle: float) -> float:
    """The same direction, whole turns added or taken away, as near to the middle as can be."""
    return middle + math.remainder(angle - middle, 360)


def _whole(counts: float) -> int:
    return int(counts + math.copysign(0.5, counts))  # a half goes away from 0, as in xr3 kin


def _cosine(value: float) -> float:
    return max(-1.0, min(1.0, value))  # a rounding error beyond 1 would have no angle


def _product(left: Matrix, right: Matrix) -> Matrix:
    return [[sum(left[i][k] * right[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
