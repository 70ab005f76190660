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
        return self.home + self.direction * self.precision * position

    def exact_counts(self, variable: float) -> float:
        """The position in counts, not yet rounded, at which the joint has this variable."""
        return (variable - self.home) / (self.direction * self.precision)

    def allows(self, position: int) -> bool:
        """Whether the position lies within the limits (a millionth of a count is not looked at)."""
        low, high = sorted(self.exact_counts(limit) for limit in self.limits)
        return low - 1e-6 <= position <= high + 1e-6

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
    the candidates for a pose as joint variables."""

    name: str
    joints: Tuple[Joint, ...]
    jaws: Jaws
    inverse: Callable[[Pose], Ways]
    homing: str
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
        solutions = self.solutions(pose)
        if not solutions:
            raise Unreachable(f"{self.name} at {pose}: a joint would be past its limit")
        return min(solutions, key=lambda counts: max(abs(count) for count in counts.values()))

    def solutions(self, pose: Pose) -> List[Counts]:
        """Every way to bring the tool there within the limits. Raises Unreachable where the arm is
        too short."""
        candidates = (self.motor_counts(variables) for variables in self.inverse(pose))
        return [counts for counts in candidates if self.allows(counts)]

    def motor_counts(self, variables: Sequence[float]) -> Counts:
        """The motors' whole counts that give these joint variables. What one joint adds to another
        is taken out of the exact numbers, and then each motor is rounded, so that two roundings
        never meet in one joint."""
        exact = [joint.exact_counts(variable) for joint, variable in zip(self.joints, variables)]
        motors: List[float] = []
        for k, position in enumerate(exact):
            motors.append(position - self._added(k, motors))
        return {joint.label: round(motor) for joint, motor in zip(self.joints, motors)}

    def allows(self, counts: Counts) -> bool:
        """Whether every joint is within its limits at these counts."""
        positions = self.positions(counts)
        return all(joint.allows(position) for joint, position in zip(self.joints, positions))


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


def _cosine(value: float) -> float:
    return max(-1.0, min(1.0, value))  # a rounding error beyond 1 would have no angle


def _product(left: Matrix, right: Matrix) -> Matrix:
    return [[sum(left[i][k] * right[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
