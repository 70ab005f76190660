"""The data sheets of xr3's three arms, as in its data/robots/*.json, and the inverse kinematics of
each with the tool pointing down: from a pose to the joint variables, for every way in which the
elbow can lie.
"""

import math
from typing import Dict, List, Tuple

from xr3.kinematics import Arm, Jaws, Joint, Pose, Ways, near, two_links


def _rhino(pose: Pose) -> Ways:
    """The base turns the arm's upright plane to the block, or away from it with the arm bent back
    over itself. In the plane two links lead to the wrist, which is 168.3 mm above the tip and 9.5
    mm nearer to the base."""
    ways = []
    up = pose.z + 168.3 - 260.4
    for base, distance in _front_and_back(pose):
        for upper, forearm in two_links(distance - 9.5, up, 228.6, 228.6):
            ways.append((base, -upper, upper - forearm, forearm, near(base - pose.yaw, -90)))
    return [(base, near(e, -90), near(d, 90), near(c, 0), b) for base, e, d, c, b in ways]


def _front_and_back(pose: Pose) -> List[Tuple[float, float]]:
    base, distance = math.degrees(math.atan2(pose.y, pose.x)), math.hypot(pose.x, pose.y)
    return [(base, distance), (near(base + 180, 0), -distance)]


def _adept(pose: Pose) -> Ways:
    """Seen from above, two links; the elbow and the roll count the other way round, for the arm's
    second frame hangs upside down. The height is the slide's alone."""
    ways = []
    for first, second in two_links(pose.x, pose.y, 425, 375):
        elbow = near(first - second, 0)
        ways.append((near(first, 0), elbow, 877 - 200 - pose.z, near(first - elbow - pose.yaw, 90)))
    return ways


def _intelledex(pose: Pose) -> Ways:
    """The shoulder's roll stays at the soft home, so that the arm works in the upright plane of the
    base (there are other ways, which lay the arm's plane over). In the plane two links lead to the
    wrist, 228.6 mm above the tip."""
    ways = []
    up = pose.z + 228.6 - 373.4
    azimuth = math.degrees(math.atan2(pose.y, pose.x))
    for upper, forearm in two_links(math.hypot(pose.x, pose.y), up, 304.8, 304.8):
        shoulder, elbow = 90 + upper, forearm - upper
        wrist = near(90 - shoulder - elbow, 90)
        roll = near(azimuth - pose.yaw, 0)
        ways.append((azimuth + 90, -90.0, near(shoulder, 90), near(elbow, 0), wrist, roll))
    return ways


RHINO_XR3 = Arm(
    name="rhino-xr3",
    joints=(
        Joint("F", 0, 260.4, 0, -90, 0.2269, (-175, 175), switch=30),
        Joint("E", -90, 0, 228.6, 0, 0.1135, (-140, 10), switch=-40),
        Joint("D", 90, 0, 228.6, 0, 0.1135, (-15, 165), switch=40, direction=-1),
        Joint("C", 0, 0, 9.5, -90, 0.1135, (-125, 125), switch=40, direction=-1),
        Joint("B", -90, 168.3, 0, 0, 0.3125, (-360000, 360000), switch=-25),
    ),
    coupling=((1, 2, -1), (2, 3, -1)),
    jaws=Jaws(precision=0.79375, home=50.8, switch=16),
    homing="DECBF",
    inverse=_rhino,
)

ADEPT_ONE = Arm(
    name="adept-one",
    joints=(
        Joint("E", 0, 877, 425, 180, 0.1, (-150, 150), switch=-20),
        Joint("D", 0, 0, 375, 0, 0.1, (-147, 147), switch=-20),
        Joint("C", 0, 100, 0, 0, 0.5, (0, 195), switch=-30, slides=True),
        Joint("B", 90, 200, 0, 0, 0.3125, (-277, 277), switch=25),
    ),
    jaws=Jaws(precision=0.5, home=60, switch=40),
    homing="CEDB",
    inverse=_adept,
)

INTELLEDEX_660 = Arm(
    name="intelledex-660",
    joints=(
        Joint("G", 90, 373.4, 0, 90, 0.1, (-60, 240), switch=20),
        Joint("F", -90, 0, 0, 90, 0.1, (-240, 60), switch=-20),
        Joint("E", 90, 0, 304.8, 0, 0.1, (-30, 210), switch=-25),
        Joint("D", 0, 0, 304.8, 0, 0.1, (-150, 150), switch=25),
        Joint("C", 90, 0, 0, 90, 0.1, (-30, 210), switch=30),
        Joint("B", 0, 228.6, 0, 0, 0.3125, (-360, 360), switch=-30),
    ),
    jaws=Jaws(precision=0.5, home=40, switch=40, finger=60),
    homing="DECBFG",
    inverse=_intelledex,
)

ARMS: Dict[str, Arm] = {arm.name: arm for arm in (RHINO_XR3, ADEPT_ONE, INTELLEDEX_660)}
