"""The robot file as the model needs it: motors with limits in whole counts, coupling, and the tip of the tool.

From docs/data-files.md and docs/kinematics.md. Motors are numbered from the base; the tool is the last one.
"""

import json
import math

MM_PER_UNIT = {"mm": 1.0, "inch": 25.4}
MARK3_SWITCH_RANGE = 60
MILLIONTH = 0.000001


def read_json(path):
    """A data file: JSON with comment lines."""
    with open(path, encoding="utf-8") as file:
        return json.loads("".join(line for line in file if not line.lstrip().startswith("*")))


def micrometres(mm):
    """Lengths that affect a decision are compared in whole micrometres."""
    return round(mm * 1000)


class Motor:
    """The constants of one motor. `low` and `high` limit the position of its joint, in counts. `home` is the joint
    variable at the soft home, in `unit`."""

    def __init__(self, entry, home, is_length, mm, profile):
        scale = mm if is_length else 1.0
        self.unit = "mm" if is_length else "deg"
        self.label = entry["label"]
        self.speed = entry["speed"]
        self.direction = entry["direction"]
        self.precision = entry["precision"] * scale
        self.home = home * scale
        self.low, self.high = self._limits([limit * scale for limit in entry["limits"]])
        switch = entry["switch"]
        self.switch_position = switch["position"]
        self.switch_mask = switch["mask"]
        self.switch_width = switch.get("width")
        self.switch_period = switch.get("period") if profile == "mark3" else None
        self.switch_range = MARK3_SWITCH_RANGE if profile == "mark3" else math.inf

    def _limits(self, limits):
        low = math.ceil((limits[0] - self.home) / self.precision - MILLIONTH)
        high = math.floor((limits[1] - self.home) / self.precision + MILLIONTH)
        return (low, high) if self.direction == 1 else (-high, -low)

    def variable(self, position):
        """The joint variable, in `unit`."""
        return self.home + self.direction * self.precision * position

    def is_closed(self, count):
        """The state of the microswitch at this count of the motor."""
        turns = [0]
        if self.switch_period is not None:
            nearest = round((count - self.switch_position) / self.switch_period)
            turns = [turn * self.switch_period for turn in range(nearest - 1, nearest + 2)]
        return any(self._is_closed_once(count - turn) for turn in turns)

    def _is_closed_once(self, count):
        if self.switch_width is not None:
            return 2 * abs(count - self.switch_position) <= self.switch_width
        away = 1 if self.switch_position > 0 else -1
        return 0 <= away * (count - self.switch_position) <= self.switch_range


class Link:
    """One row of the D-H table, in mm and degrees."""

    def __init__(self, joint, motor, mm):
        self.motor = motor
        self.theta, self.d, self.a = joint["theta_deg"], joint["d"] * mm, joint["a"] * mm
        alpha = math.radians(joint["alpha_deg"])
        self.cos_alpha, self.sin_alpha = math.cos(alpha), math.sin(alpha)

    def transform(self, point, position):
        """A point of frame k in frame k-1, when the joint is at this position in counts."""
        variable = self.motor.variable(position)
        theta = math.radians(variable if self.motor.unit == "deg" else self.theta)
        d = variable if self.motor.unit == "mm" else self.d
        cos, sin = math.cos(theta), math.sin(theta)
        x, y, z = point
        return (cos * x - self.cos_alpha * sin * y + self.sin_alpha * sin * z + self.a * cos,
                sin * x + self.cos_alpha * cos * y - self.sin_alpha * cos * z + self.a * sin,
                self.sin_alpha * y + self.cos_alpha * z + d)


class Robot:
    def __init__(self, path, profile):
        data = read_json(path)
        mm = MM_PER_UNIT[data["length_unit"]]
        self.motors = []
        self.links = []
        for joint in data["joints"]:
            is_length = joint["variable"] == "d"
            self.motors.append(Motor(joint, joint["d" if is_length else "theta_deg"], is_length, mm, profile))
            self.links.append(Link(joint, self.motors[-1], mm))
        tool = data["tool"]
        self.motors.append(Motor(tool, tool["home"], tool["kind"] == "parallel", mm, profile))
        self.moved_by = self._moved_by_motors(data["coupling"])
        self.protected_radius = micrometres(data["protected_region"]["radius"] * mm)
        self.protected_height = micrometres(data["protected_region"]["height"] * mm)

    def _moved_by_motors(self, pairs):
        """For each motor the list of (joint, counts that one count of the motor adds to its position): its own joint,
        or the tool, and those that are coupled to it."""
        moved = [[(place, 1)] for place in range(len(self.motors))]
        for motor, joint in pairs:
            sign = (1 if joint > 0 else -1) * self.motors[motor - 1].direction * self.motors[abs(joint) - 1].direction
            moved[motor - 1].append((abs(joint) - 1, sign))
        return moved

    def tip(self, positions):
        """The tip of the tool in whole micrometres."""
        point = (0.0, 0.0, 0.0)
        for link, position in zip(reversed(self.links), reversed(positions[:len(self.links)])):
            point = link.transform(point, position)
        return [micrometres(length) for length in point]

    def is_protected(self, tip):
        """Whether a tip, in micrometres, is inside the protected cylinder."""
        return tip[0] ** 2 + tip[1] ** 2 < self.protected_radius ** 2 and tip[2] < self.protected_height
