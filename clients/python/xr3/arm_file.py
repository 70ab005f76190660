"""Reads an arm from a robot file, the JSON of docs/data-files.md. Only what kinematics and the
Robot need: outlines and speeds are ignored. `xr3 check` finds all errors of a file, this
only some.
"""

import json
import math
import os
from pathlib import Path
from typing import Any, Callable, Dict, List, Sequence, Tuple, TypeVar, Union

from xr3 import inverse
from xr3.kinematics import Arm, Jaws, Joint, Pose, Switch, Ways

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


def load(file: Union[str, "os.PathLike[str]"]) -> Arm:
    """See Arm.load()."""
    path = Path(file)
    try:
        text = path.read_text(encoding="utf-8")
        robot = json.loads("\n".join("" if line.lstrip().startswith("*") else line
                                     for line in text.split("\n")))
        return _arm(path.stem, robot)
    except KeyError as error:
        why = f"the member {error.args[0]!r} is missing"
    except (ArithmeticError, IndexError, TypeError, ValueError) as error:  # of json, too
        why = str(error)
    raise ValueError(f"{path} is no robot file in JSON: {why}. `xr3 check` lists all errors of a robot "
                     "file; `xr3 convert` makes JSON of the paper's plain form")


def _arm(name: str, robot: Dict[str, Any]) -> Arm:
    unit = _choice(robot, "length_unit", {"mm": 1.0, "inch": 25.4})
    joints = tuple(_joint(each, unit) for each in robot["joints"])
    labels = [joint.label for joint in joints]
    if not joints:
        raise ValueError("the list of joints is empty")
    if not set(labels) <= set("BCDEFGH") or len(set(labels)) < len(joints):
        raise ValueError(f"the joints are {', '.join(joint.label for joint in joints)}, not different letters B to H")
    for j, k in robot["coupling"]:
        if not (1 <= j <= len(joints) and 1 <= abs(k) <= len(joints)):
            raise ValueError(f"the coupling [{j}, {k}] is not between joints 1 to {len(joints)}")
    region = robot["protected_region"]
    way, homing, near_first = _form(joints)
    return Arm(name=name, joints=joints, jaws=_jaws(robot["tool"], unit), inverse=way,
               homing="".join(labels[k] for k in homing),
               near_first="".join(labels[k] for k in near_first),
               protected=(region["radius"] * unit, region["height"] * unit),
               coupling=tuple((j - 1, abs(k) - 1, 1 if k > 0 else -1) for j, k in robot["coupling"]))


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
