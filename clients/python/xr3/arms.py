"""The parameters of xr3's three arms, as in data/robots/*.json, and their inverse kinematics with
the tool pointing down: from a pose to the joint variables, one solution per elbow configuration.
"""

import math
from typing import Dict, List, Tuple

from xr3.kinematics import Arm, Jaws, Joint, Pose, Unreachable, Ways, two_links


def _rhino(pose: Pose) -> Ways:
    """The base turns the arm's vertical plane towards the block, or away from it with the arm bent
    backwards. In the plane, two links lead to the wrist, which is 168.3 mm above the tip and 9.5 mm
    nearer to the base."""
    ways = []
    up = pose.z + 168.3 - 260.4
    for base, upper, forearm in _front_and_back(pose, 9.5, up, 228.6):
        ways.append((base, -upper, upper - forearm, forearm, base - pose.yaw))
    return ways


def _adept(pose: Pose) -> Ways:
    """Seen from above, two links. The signs of elbow and roll are inverted, since the second frame
    of the arm points down. Only the sliding joint sets the height."""
    ways = []
    for first, second in two_links(pose.x, pose.y, 425, 375):
        elbow = first - second
        ways.append((first, elbow, 877 - 200 - pose.z, first - elbow - pose.yaw))
    return ways


def _intelledex(pose: Pose) -> Ways:
    """The shoulder's roll stays at the soft home, so that the arm works in the vertical plane of
    the base. (Other solutions tilt this plane but exceed the limits.) The base turns the plane
    towards the block or away from it. In the plane, two links lead to the wrist, 228.6 mm above the
    tip."""
    ways = []
    up = pose.z + 228.6 - 373.4
    for base, upper, forearm in _front_and_back(pose, 0, up, 304.8):
        shoulder, elbow = 90 + upper, forearm - upper
        ways.append((base + 90, -90.0, shoulder, elbow, 90 - shoulder - elbow, base - pose.yaw))
    return ways


def _front_and_back(pose: Pose, in_front: float, up: float,
                    link: float) -> List[Tuple[float, float, float]]:
    """Solutions (base, upper, forearm) in degrees for an arm in a vertical plane that turns about
    the base axis, with two links of length `link`. The plane points towards the pose, or away from
    it with the arm bent backwards. The wrist is `in_front` nearer to the base than the tip and `up`
    higher than the shoulder, in mm. Raises Unreachable if the links are too short for both."""
    azimuth, distance = math.degrees(math.atan2(pose.y, pose.x)), math.hypot(pose.x, pose.y)
    ways = []
    for base, out in ((azimuth + 180, -distance), (azimuth, distance)):
        try:
            ways += [(base, upper, forearm)
                     for upper, forearm in two_links(out - in_front, up, link, link)]
        except Unreachable as error:
            too_short = error
    if not ways:
        raise too_short
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
    protected=(100, 340),
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
    protected=(300, 900),
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
    protected=(150, 500),
    inverse=_intelledex,
)

ARMS: Dict[str, Arm] = {arm.name: arm for arm in (RHINO_XR3, ADEPT_ONE, INTELLEDEX_660)}
