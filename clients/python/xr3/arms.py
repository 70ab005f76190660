"""The parameters of xr3's three arms, as in data/robots/*.json, for use without these files. Their
inverse kinematics has a closed form, see inverse.py.
"""

from typing import Dict

from xr3.inverse import five_axis, scara, six_axis
from xr3.joints import Jaws, Joint, Switch
from xr3.kinematics import Arm

RHINO_XR3 = Arm(
    name="rhino-xr3",
    joints=(
        Joint("F", 0, 260.4, 0, -90, 0.2269, (-175, 175), switch=Switch(30, 8)),
        Joint("E", -90, 0, 228.6, 0, 0.1135, (-140, 10), switch=Switch(-40, 4)),
        Joint("D", 90, 0, 228.6, 0, 0.1135, (-15, 165), switch=Switch(40, 2), direction=-1),
        Joint("C", 0, 0, 9.5, -90, 0.1135, (-125, 125), switch=Switch(40, 1), direction=-1),
        Joint("B", -90, 168.3, 0, 0, 0.3125, (-360000, 360000), switch=Switch(-25, 32)),
    ),
    coupling=((1, 2, -1), (2, 3, -1)),
    jaws=Jaws(precision=0.79375, home=50.8, switch=Switch(-16, 16), fully_open=-16, direction=-1),
    homing="DECBF",
    near_first="E",
    protected=(100, 340),
    inverse=five_axis,
)

ADEPT_ONE = Arm(
    name="adept-one",
    joints=(
        Joint("E", 0, 877, 425, 180, 0.1, (-150, 150), switch=Switch(-20, 4)),
        Joint("D", 0, 0, 375, 0, 0.1, (-147, 147), switch=Switch(-20, 2)),
        Joint("C", 0, 100, 0, 0, 0.5, (0, 195), switch=Switch(-30, 1), slides=True),
        Joint("B", 90, 200, 0, 0, 0.3125, (-277, 277), switch=Switch(25, 32)),
    ),
    jaws=Jaws(precision=0.5, home=60, switch=Switch(-40, 16), fully_open=-40, direction=-1),
    homing="CEDB",
    protected=(300, 900),
    inverse=scara,
)

INTELLEDEX_660 = Arm(
    name="intelledex-660",
    joints=(
        Joint("G", 90, 373.4, 0, 90, 0.1, (-60, 240), switch=Switch(20, 16)),
        Joint("F", -90, 0, 0, 90, 0.1, (-240, 60), switch=Switch(-20, 8)),
        Joint("E", 90, 0, 304.8, 0, 0.1, (-30, 210), switch=Switch(-25, 4)),
        Joint("D", 0, 0, 304.8, 0, 0.1, (-150, 150), switch=Switch(25, 2)),
        Joint("C", 90, 0, 0, 90, 0.1, (-30, 210), switch=Switch(30, 1)),
        Joint("B", 0, 228.6, 0, 0, 0.3125, (-360, 360), switch=Switch(-30, 32)),
    ),
    jaws=Jaws(precision=0.5, home=40, switch=Switch(-40, 16), fully_open=-40, direction=-1,
              finger=60),
    homing="DECBFG",
    near_first="E",
    protected=(150, 500),
    inverse=six_axis,
)

ARMS: Dict[str, Arm] = {arm.name: arm for arm in (RHINO_XR3, ADEPT_ONE, INTELLEDEX_660)}
