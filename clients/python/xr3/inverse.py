"""Inverse kinematics for a tool that points straight down: from a pose to the joint variables. In
closed form for the structures of xr3's three arms, with the lengths of the arm's own table, and
numerically for any other arm.
"""

import math
import random
from typing import List, Sequence, Tuple

from xr3.joints import Joint, Matrix, Pose, Unreachable, Ways, product, two_links

Joints = Sequence[Joint]

STARTS = 96  # numerical: starting points
MAX_STEPS = 60  # numerical: of one descent
DONE = 1e-9  # numerical: residual of a solution, relative to the length of the arm
LEAST = 1e-6  # numerical: improvement of a step that goes on, relative to the squared residual


# --- Closed forms.

def five_axis(joints: Joints, pose: Pose) -> Ways:
    """An arm like the Rhino: base, three parallel axes, roll. The base turns the arm's vertical
    plane towards the block, or away from it with the arm bent backwards. In the plane, two links
    lead to the wrist, which for the Rhino is 168.3 mm above the tip and 9.5 mm nearer to the
    base."""
    base_row, upper_row, forearm_row, pitch_row, roll_row = joints
    ways = []
    up = pose.z + roll_row.d - base_row.d
    for base, upper, forearm in _front_and_back(pose, pitch_row.a, up, upper_row.a, forearm_row.a):
        ways.append((base, -upper, upper - forearm, forearm, base - pose.yaw))
    return ways


def scara(joints: Joints, pose: Pose) -> Ways:
    """An arm like the Adept One. Seen from above, two links. The signs of elbow and roll are
    inverted, since the second frame of the arm points down. Only the sliding joint sets the
    height."""
    first_row, second_row, slide, roll_row = joints
    ways = []
    for first, second in two_links(pose.x, pose.y, first_row.a, second_row.a):
        elbow = first - second
        ways.append((first, elbow, first_row.d - second_row.d - roll_row.d - pose.z,
                     first - elbow - slide.theta - pose.yaw))
    return ways


def six_axis(joints: Joints, pose: Pose) -> Ways:
    """An arm like the Intelledex 660. The shoulder's roll is -90 degrees, or 90 with base and
    shoulder turned by half a turn, so that the arm works in the vertical plane of the base. The
    base turns the plane towards the block or away from it. In the plane, two links lead to the
    wrist, straight above the tip."""
    ways = []
    up = pose.z + joints[5].d - joints[0].d
    for base, upper, forearm in _front_and_back(pose, 0, up, joints[2].a, joints[3].a):
        shoulder, elbow = 90 + upper, forearm - upper
        for roll, turned in ((-90.0, 0), (90.0, 180)):
            ways.append((base + 90 + turned, roll, shoulder + turned, elbow, 90 - shoulder - elbow,
                         base - pose.yaw))
    return ways


def _front_and_back(pose: Pose, in_front: float, up: float, first: float,
                    second: float) -> List[Tuple[float, float, float]]:
    """Solutions (base, upper, forearm) in degrees for an arm in a vertical plane that turns about
    the base axis, with two links of these lengths. The plane points towards the pose, or away from
    it with the arm bent backwards. The wrist is `in_front` nearer to the base than the tip and `up`
    higher than the shoulder, in mm. Raises Unreachable if the links are too short for both."""
    azimuth, distance = math.degrees(math.atan2(pose.y, pose.x)), math.hypot(pose.x, pose.y)
    ways = []
    for base, out in ((azimuth + 180, -distance), (azimuth, distance)):
        try:
            ways += [(base, upper, forearm)
                     for upper, forearm in two_links(out - in_front, up, first, second)]
        except Unreachable as error:
            too_short = error
    if not ways:
        raise too_short
    return ways


# --- Which arms have a closed form.

def is_five_axis(joints: Joints) -> bool:
    """Whether five_axis() fits these joints."""
    return (_twists(joints) == [-90, 0, 0, -90, 0] and not _slides(joints)
            and joints[1].a > 0 and joints[2].a > 0
            and not any((joints[0].a, joints[1].d, joints[2].d, joints[3].d, joints[4].a)))


def is_scara(joints: Joints) -> bool:
    """Whether scara() fits these joints."""
    return (_twists(joints) == [180, 0, 0, 0] and _slides(joints) == [2]
            and joints[0].a > 0 and joints[1].a > 0 and not any((joints[2].a, joints[3].a)))


def is_six_axis(joints: Joints) -> bool:
    """Whether six_axis() fits these joints."""
    return (_twists(joints) == [90, 90, 0, 0, 90, 0] and not _slides(joints)
            and joints[2].a > 0 and joints[3].a > 0
            and not any((joints[0].a, joints[1].a, joints[1].d, joints[2].d, joints[3].d,
                         joints[4].a, joints[4].d, joints[5].a)))


def _twists(joints: Joints) -> List[float]:
    """The link twists, in degrees above -180 up to 180."""
    return [180 - (180 - joint.alpha) % 360 for joint in joints]


def _slides(joints: Joints) -> List[int]:
    return [k for k, joint in enumerate(joints) if joint.slides]


# --- Any other arm.

def numerical(joints: Joints, pose: Pose) -> Ways:
    """Any arm: damped least squares (Levenberg-Marquardt) from the soft home and from points
    scattered over the joints' ranges, the same in every call. May miss solutions; of infinitely many,
    returns up to STARTS. Raises Unreachable with the error of the best approximation."""
    length = max(1.0, sum(abs(joint.a) + abs(joint.d) for joint in joints))
    scatter = random.Random(0)
    ways: List[List[float]] = []
    best = (math.inf, 0.0)
    for start in range(STARTS):
        variables = [joint.home if start == 0 else scatter.uniform(*_usual_range(joint))
                     for joint in joints]
        variables, rest = _descend(joints, pose, length, variables)
        if _square(rest) > DONE ** 2:
            best = min(best, (math.hypot(*rest[:3]) * length, _lean_deg(rest)))
        elif not any(_is_same(joints, variables, way) for way in ways):
            ways.append(variables)
    if not ways:
        raise Unreachable(f"no joint angles found for {pose}: the nearest miss it by {best[0]:.1f} mm and "
                          f"{best[1]:.1f} degrees")
    return ways


def _usual_range(joint: Joint) -> Tuple[float, float]:
    """The limits of the variable, and for an angle at most half a turn about the soft home."""
    low, high = joint.limits
    return (low, high) if joint.slides else (max(low, joint.home - 180), min(high, joint.home + 180))


def _is_same(joints: Joints, one: Sequence[float], other: Sequence[float]) -> bool:
    return all(abs(a - b if joint.slides else math.remainder(a - b, 360)) < 1e-3
               for joint, a, b in zip(joints, one, other))


def _lean_deg(rest: Sequence[float]) -> float:
    """The larger of the angles by which the x and the z axis of the tool are off."""
    return max(math.degrees(2 * math.asin(min(1.0, math.hypot(*rest[k:k + 3]) / 2))) for k in (3, 6))


def _descend(joints: Joints, pose: Pose, length: float,
             variables: List[float]) -> Tuple[List[float], List[float]]:
    """Improves the variables step by step while that helps; returns them with their residual."""
    damping = 1e-3
    frames = _frames(joints, variables)
    rest = _residual(frames[-1], pose, length)
    for _ in range(MAX_STEPS):
        if _square(rest) <= DONE ** 2 or damping > 1e9:
            break
        step = _step(_slopes(joints, frames, length), rest, damping)
        tried = [variable + (delta * length if joint.slides else math.degrees(delta))
                 for joint, variable, delta in zip(joints, variables, step)]
        tried_frames = _frames(joints, tried)
        tried_rest = _residual(tried_frames[-1], pose, length)
        gain = _square(rest) - _square(tried_rest)
        if 0 < gain < LEAST * _square(rest):
            break
        if gain > 0:
            variables, frames, rest, damping = tried, tried_frames, tried_rest, max(damping / 10, 1e-15)
        else:
            damping *= 10
    return variables, rest


def _frames(joints: Joints, variables: Sequence[float]) -> List[Matrix]:
    """The frames of base, links and tool, in base coordinates."""
    frames = [[[float(i == j) for j in range(4)] for i in range(4)]]
    for joint, variable in zip(joints, variables):
        frames.append(product(frames[-1], joint.matrix_at(variable)))
    return frames


def _column(frame: Matrix, k: int) -> List[float]:
    return [row[k] for row in frame[:3]]


def _residual(frame: Matrix, pose: Pose, length: float) -> List[float]:
    """The distances of tip, x axis and z axis of the tool from those of the pose; the tip in lengths of
    the arm."""
    yaw = math.radians(pose.yaw)
    wanted = ((3, (pose.x, pose.y, pose.z), length), (0, (math.cos(yaw), math.sin(yaw), 0.0), 1.0),
              (2, (0.0, 0.0, -1.0), 1.0))
    return [(want - have) / unit for k, place, unit in wanted for want, have in zip(place, _column(frame, k))]


def _slopes(joints: Joints, frames: Sequence[Matrix], length: float) -> List[List[float]]:
    """For each joint, the change of tip, x axis and z axis per radian or length of the arm."""
    tip, x, z = (_column(frames[-1], k) for k in (3, 0, 2))
    columns = []
    for joint, frame in zip(joints, frames):
        axis, arm = _column(frame, 2), [(a - b) / length for a, b in zip(tip, _column(frame, 3))]
        columns.append([*axis, *[0.0] * 6] if joint.slides
                       else [*_cross(axis, arm), *_cross(axis, x), *_cross(axis, z)])
    return columns


def _step(slopes: Sequence[Sequence[float]], rest: Sequence[float], damping: float) -> List[float]:
    """Solves the damped normal equations by Gaussian elimination; they are positive definite, so it
    needs no pivots."""
    n = len(slopes)
    rows = [[*(_dot(slopes[i], slopes[j]) + (damping if i == j else 0.0) for j in range(n)),
             _dot(slopes[i], rest)] for i in range(n)]
    for i in range(n):
        for row in rows[i + 1:]:
            factor = row[i] / rows[i][i]
            row[i:] = [a - factor * b for a, b in zip(row[i:], rows[i][i:])]
    step = [0.0] * n
    for i in reversed(range(n)):
        step[i] = (rows[i][n] - _dot(rows[i][i + 1:n], step[i + 1:])) / rows[i][i]
    return step


def _cross(a: Sequence[float], b: Sequence[float]) -> List[float]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b))


def _square(values: Sequence[float]) -> float:
    return _dot(values, values)
