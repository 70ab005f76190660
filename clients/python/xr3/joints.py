"""The parts of an arm and the pose of its tool: joints, jaws and microswitches, and transformations
between them. Lengths are in mm, angles in degrees.
"""

import math
from dataclasses import dataclass
from numbers import Real
from typing import List, Optional, Sequence, Tuple

from xr3.address import check_type

Ways = Sequence[Sequence[float]]  # joint variables from the base, for each elbow configuration
Matrix = List[List[float]]  # 4 x 4 homogeneous transformation, row by row


IDENTITY = tuple(tuple(float(i == j) for j in range(4)) for i in range(4))


class Unreachable(ValueError):
    """The arm cannot be there: it is too short, a joint would be past its limit, or the tip would
    be in the protected region. The message says which."""


@dataclass(frozen=True)
class Pose:
    """The pose of a tool that points straight down: the position of the tip in mm, in base
    coordinates with z up, and `yaw`, the angle in degrees of the tool's x axis about the vertical,
    from the x axis of the table. A block with this yaw fits squarely between the jaws. Raises
    ValueError if one of them is no finite number."""

    x: float
    y: float
    z: float
    yaw: float = 0.0

    def __post_init__(self) -> None:
        for value in (self.x, self.y, self.z, self.yaw):
            if not (isinstance(value, Real) and math.isfinite(value)):
                raise ValueError(f"x, y, z and yaw of a pose are numbers, not {value!r}")


def check_pose(pose: object) -> None:
    """Raises ValueError if this is no pose."""
    check_type(pose, Pose, "a pose, such as xr3.Pose(262, 0, 20, 90)")


@dataclass(frozen=True)
class Switch:
    """A microswitch. `edge` is the count of its motor at which it closes when the motor moves away
    from the soft home, `mask` its bit in the reply to I (joints C to H) or J (A and B), 0 if it has
    none. `width` is the number of counts after which it opens again; some never do. `side` is the
    direction in which the motor crosses the edge, +1 or -1, where that is not the sign of `edge`."""

    edge: int
    mask: int
    width: int = 60
    side: int = 0

    @property
    def away(self) -> int:
        """The direction in which the motor reaches the edge from the soft home, +1 or -1."""
        return self.side or (1 if self.edge > 0 else -1)


@dataclass(frozen=True)
class Joint:
    """One row of the Denavit-Hartenberg table at the soft home, with `theta` and `alpha` in degrees
    and `d` and `a` in mm, and the motor with its `label`. `precision` is in degrees (mm for a
    sliding joint) per count, `direction` is +1 or -1, `limits` apply to the joint variable."""

    label: str
    theta: float
    d: float
    a: float
    alpha: float
    precision: float
    limits: Tuple[float, float]
    switch: Switch
    direction: int = 1
    slides: bool = False

    @property
    def home(self) -> float:
        """The joint variable at count 0."""
        return self.d if self.slides else self.theta

    def variable(self, position: int) -> float:
        """The joint variable, in degrees or mm, at this position in counts."""
        return self.home + self.direction * self.precision * position

    def exact_counts(self, variable: float) -> float:
        """The position in counts, not rounded, for this joint variable."""
        return (variable - self.home) / (self.direction * self.precision)

    @property
    def range(self) -> Tuple[int, int]:
        """The first and the last position within the limits, with a tolerance of 1e-6 counts."""
        low, high = sorted(self.exact_counts(limit) for limit in self.limits)
        return math.ceil(low - 1e-6), math.floor(high + 1e-6)

    def allows(self, position: int) -> bool:
        """Whether the position lies within the limits."""
        low, high = self.range
        return low <= position <= high

    def within(self, variable: float) -> float:
        """The equivalent angle (plus or minus full turns) within the limits, if there is one, and
        nearest to the soft home. The variable of a sliding joint is returned unchanged."""
        if self.slides:
            return variable
        nearest = near(variable, self.home)
        return min((nearest, nearest + 360, nearest - 360), key=self._beyond)

    def _beyond(self, variable: float) -> float:
        """The distance of the variable past the limits; 0 if it rounds to a count within them."""
        low, high = (self.variable(position) for position in self.range)
        low, high = min(low, high) - self.precision / 2, max(low, high) + self.precision / 2
        return max(low - variable, variable - high, 0.0)

    def matrix(self, position: int) -> Matrix:
        """The transformation from the previous frame to the frame of this link."""
        return self.matrix_at(self.variable(position))

    def matrix_at(self, variable: float) -> Matrix:
        """The transformation of matrix() at a joint variable, which need not lie on a count."""
        theta, d = (self.theta, variable) if self.slides else (variable, self.d)
        turn, twist = math.radians(theta), math.radians(self.alpha)
        ct, st, ca, sa = math.cos(turn), math.sin(turn), math.cos(twist), math.sin(twist)
        return [[ct, -ca * st, sa * st, self.a * ct],
                [st, ca * ct, -sa * ct, self.a * st],
                [0.0, sa, ca, d],
                [0.0, 0.0, 0.0, 1.0]]


@dataclass(frozen=True)
class Jaws:
    """The gripper, joint A. `precision` is in mm (degrees for rotating fingers) per count, `home`
    is the opening at count 0 in mm or, for rotating fingers (`finger` is their length in mm), the
    angle between them in degrees. `fully_open` is the count at which the gripper is fully open.
    `direction` is +1 if positive counts open it, else -1."""

    precision: float
    home: float
    switch: Switch
    fully_open: int
    finger: Optional[float] = None
    direction: int = 1

    def opening(self, count: int) -> float:
        """The distance between the fingertips at this count, mm."""
        value = self.home + self.direction * self.precision * count
        return value if self.finger is None else 2 * self.finger * math.sin(math.radians(value) / 2)


def two_links(out: float, up: float, first: float, second: float) -> List[Tuple[float, float]]:
    """The directions in degrees of two links that lead from (0, 0) to (out, up), with the elbow
    above and below the straight line. Raises Unreachable if the point is too far or too near."""
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
    """The equivalent angle (plus or minus full turns) nearest to the middle."""
    return middle + math.remainder(angle - middle, 360)


def _cosine(value: float) -> float:
    return max(-1.0, min(1.0, value))  # acos fails on rounding errors beyond 1


def product(left: Matrix, right: Matrix) -> Matrix:
    """The product of two transformations."""
    return [[sum(left[i][k] * right[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
