"""Reads an arm from a robot file, the JSON of docs/data-files.md. Only what kinematics and the
Robot need: outlines and speeds are ignored. `xr3 check` finds all errors of a file, this
only some.
"""

import json
import math
import os
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Protocol, Sequence, Tuple, TypeVar, Union

from xr3 import inverse
from xr3.joints import IDENTITY, Jaws, Joint, Pose, Switch, Ways

Inverse = Callable[[Sequence[Joint], Pose], Ways]

# Structures with a closed form, the order in which their joints are homed, counted from 0, and
# Arm.near_first. The hand is lifted off the table first; then the shoulder must not lean far back.
FORMS: Sequence[Tuple[Callable[[Sequence[Joint]], bool], Inverse, Sequence[int], Sequence[int]]] = (
    (inverse.is_five_axis, inverse.five_axis, (2, 1, 3, 4, 0), (1,)),
    (inverse.is_scara, inverse.scara, (2, 0, 1, 3), ()),
    (inverse.is_six_axis, inverse.six_axis, (3, 2, 4, 5, 1, 0), (2,)),
)


SIGNS = {1: 1, -1: -1}
Value = TypeVar("Value")


class _Stands(Protocol):
    @property
    def is_upright(self) -> bool: ...


Made = TypeVar("Made", bound=_Stands)


def load(file: Union[str, "os.PathLike[str]"], make: Callable[..., Made]) -> Made:
    """See Arm.load(). `make` is Arm."""
    path = Path(file)
    try:
        text = path.read_text(encoding="utf-8")
        robot = json.loads("\n".join("" if line.lstrip().startswith("*") else line
                                     for line in text.split("\n")))
        return arm_of(path.stem, robot, make)
    except KeyError as error:
        why = f"the member {error.args[0]!r} is missing"
    except (ArithmeticError, IndexError, TypeError, ValueError) as error:  # json raises some of them, too
        why = str(error)
    raise ValueError(f"{path} is no robot file in JSON: {why}. `xr3 check` lists all errors of a robot "
                     "file; `xr3 convert` makes JSON of the paper's plain form")


def arm_of(name: str, robot: Dict[str, Any], make: Callable[..., Made]) -> Made:
    """The arm with this name, of the members of a robot file. `make` is Arm."""
    unit = _choice(robot, "length_unit", {"mm": 1.0, "inch": 25.4})
    joints = tuple(_joint(each, unit) for each in robot["joints"])
    labels = [joint.label for joint in joints]
    if not joints:
        raise ValueError("the list of joints is empty")
    if not set(labels) <= set("BCDEFGH") or len(set(labels)) < len(joints):
        raise ValueError(f"the joints are {', '.join(joint.label for joint in joints)}, not different letters B to H")
    coupling = robot.get("coupling", [])
    for j, k in coupling:
        if not (1 <= j <= len(joints) and 1 <= abs(k) <= len(joints)):
            raise ValueError(f"the coupling [{j}, {k}] is not between joints 1 to {len(joints)}")
    region = robot.get("protected_region", {"radius": 0, "height": 0})
    mount = _mount(robot, unit)
    is_on_slide = joints[0].slides and _has_form(joints[1:])
    if mount != IDENTITY and not (is_on_slide or _has_form(joints)):
        raise ValueError("the arm has a mount and no closed form of the inverse kinematics")
    way, homing, near_first = _form(joints[1:] if is_on_slide else joints)
    if is_on_slide:
        homing, near_first = [*(k + 1 for k in homing), 0], [k + 1 for k in near_first]
    carousel = _carousel(robot)
    arm = make(name=name, joints=joints, jaws=_jaws(robot["tool"], unit), inverse=way,
               homing="".join(labels[k] for k in homing) + (carousel.label if carousel else ""),
               near_first="".join(labels[k] for k in near_first),
               protected=(region["radius"] * unit, region["height"] * unit),
               coupling=tuple((j - 1, abs(k) - 1, 1 if k > 0 else -1) for j, k in coupling),
               mount=mount, is_on_slide=is_on_slide, carousel=carousel)
    if not arm.is_upright:
        raise ValueError("the base axis of the arm does not point up")
    return arm


def _mount(robot: Dict[str, Any], unit: float) -> Tuple[Tuple[float, ...], ...]:
    """The transformation from the base frame to frame 0, which most robots do not have."""
    if "mount" not in robot:
        return IDENTITY
    row = robot["mount"]
    joint = Joint("", row["theta_deg"], row["d"] * unit, row["a"] * unit, row["alpha_deg"], 1.0,
                  (0.0, 0.0), switch=Switch(1, 0))
    return tuple(tuple(each) for each in joint.matrix_at(joint.theta))


def _carousel(robot: Dict[str, Any]) -> Optional[Joint]:
    """The motor of the carousel, if there is one."""
    if "carousel" not in robot:
        return None
    table = robot["carousel"]
    low, high = table["limits"]
    return Joint(table["label"], 0.0, 0.0, 0.0, 0.0, _precision(table), (low, high),
                 switch=_switch(table["switch"]), direction=_choice(table, "direction", SIGNS))


def _choice(members: Dict[str, Any], name: str, meanings: Dict[Any, Value]) -> Value:
    """The meaning of a member that has a few possible values."""
    if members[name] not in meanings:
        raise ValueError(f"{name} is {members[name]!r}, not {' or '.join(map(repr, meanings))}")
    return meanings[members[name]]


def _precision(motor: Dict[str, Any]) -> float:
    precision: float = motor["precision"]
    if not precision > 0:
        raise ValueError(f"the precision of {motor['label']} is {precision}, not above 0")
    return precision


def _has_form(joints: Sequence[Joint]) -> bool:
    return any(fits(joints) for fits, *_ in FORMS)


def _form(joints: Sequence[Joint]) -> Tuple[Inverse, Sequence[int], Sequence[int]]:
    """The inverse kinematics, the homing order and Arm.near_first for this structure. Other arms
    are homed from the tool to the base, sliding joints first."""
    for fits, way, homing, near_first in FORMS:
        if fits(joints):
            return way, homing, near_first
    order: List[int] = sorted(range(len(joints)), key=lambda k: (not joints[k].slides, -k))
    return inverse.numerical, order, ()


def _joint(joint: Dict[str, Any], unit: float) -> Joint:
    slides = bool(_choice(joint, "variable", {"theta": False, "d": True}))
    scale = unit if slides else 1.0
    low, high = joint["limits"]
    return Joint(joint["label"], joint["theta_deg"], joint["d"] * unit, joint["a"] * unit, joint["alpha_deg"],
                 _precision(joint) * scale, (low * scale, high * scale), switch=_switch(joint["switch"]),
                 direction=_choice(joint, "direction", SIGNS), slides=slides)


def _switch(switch: Dict[str, Any]) -> Switch:
    """A switch with a width closes before its position, while twice the distance is at most the
    width."""
    away = -1 if switch["position"] < 0 else 1
    edge = switch["position"] - away * (switch.get("width", 0) // 2)
    return Switch(edge, switch["mask"], switch.get("width", Switch.width),
                  side=0 if edge * away > 0 else away)


def _jaws(tool: Dict[str, Any], unit: float) -> Jaws:
    angular = bool(_choice(tool, "kind", {"parallel": False, "angular": True}))
    scale = 1.0 if angular else unit
    direction = _choice(tool, "direction", SIGNS)
    precision, home = _precision(tool) * scale, tool["home"] * scale
    counts = math.floor((tool["limits"][1] * scale - home) / precision + 1e-6)
    return Jaws(precision, home, switch=_switch(tool["switch"]), direction=direction,
                fully_open=direction * counts,
                finger=tool["finger_length"] * unit if angular else None)
