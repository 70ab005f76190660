"""A straight line of the tip, as motor counts at points along it."""

import math
from typing import List, Optional

from xr3.joints import Pose, Unreachable, check_pose
from xr3.kinematics import Arm, Counts

DOWN = 0.02  # the sine by which a hand may be off straight down: some counts of a joint


def straight(arm: Arm, start: Counts, pose: Pose, step_mm: float) -> List[Counts]:
    """Counts for points at most `step_mm` mm apart on the line from the tip at the counts `start` to
    the pose; the last is that of the pose. The yaw turns evenly, the short way. Each point has the
    solution nearest to the one before. Raises Unreachable if the arm cannot be at one of them, or
    if the hand does not point down at the start; ValueError if the step is not above 0."""
    check_pose(pose)
    if not step_mm > 0:
        raise ValueError(f"the step is a number of mm above 0, not {step_mm!r}")
    frame = arm.frame(start)
    if math.hypot(frame[0][2], frame[1][2]) > DOWN or frame[2][2] > 0:
        raise Unreachable(f"{arm.name}: the hand does not point straight down, as on the line: "
                          "go_to() a pose first")
    x, y, z = arm.tip(start)
    turn = math.remainder(pose.yaw - arm.yaw(start), 360)
    parts = max(1, math.ceil(math.dist((x, y, z), (pose.x, pose.y, pose.z)) / step_mm))
    way: List[Counts] = []
    for part in (number / parts for number in range(1, parts + 1)):
        point = Pose(x + part * (pose.x - x), y + part * (pose.y - y), z + part * (pose.z - z),
                     pose.yaw - (1 - part) * turn)
        way.append(_nearest(arm, point, way[-1] if way else start, arm.slide_at(start)))
    return way


def _nearest(arm: Arm, pose: Pose, before: Counts, slide: Optional[float]) -> Counts:
    found = arm.solutions(pose, slide)
    if not found:
        arm.solve(pose, slide)  # raises Unreachable with the reason
    return min(found, key=lambda counts: max(abs(counts[label] - before.get(label, 0))
                                             for label in counts))
