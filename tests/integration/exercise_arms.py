"""Data sheets of the three arms for exercise.py: the resolution of the encoders, the positions of the
switches, the camera, and the inverse kinematics in closed form, with the tool pointing down."""

import math

from exercise_sight import Camera


def two_links(out, up, first, second):
    """Elevations in degrees of two links that reach the point (out, up), with the elbow up."""
    reach = math.hypot(out, up)
    to_point = math.atan2(up, out)
    inside = math.acos((reach ** 2 + first ** 2 - second ** 2) / (2 * reach * first))
    bend = math.acos((reach ** 2 - first ** 2 - second ** 2) / (2 * first * second))
    return math.degrees(to_point + inside), math.degrees(to_point + inside - bend)


def least(roll):
    """The equivalent roll of minimum magnitude: a block looks the same after half a turn."""
    return roll - 180 * round(roll / 180)


class RhinoXr3:
    name = "rhino-xr3"
    homing = "DECBF"
    masks = {"F": 8, "E": 4, "D": 2, "C": 1, "B": 32, "A": 16}
    hard_home = {"F": 30, "E": -40, "D": 40, "C": 40, "B": -25, "A": -16}
    displaced = {"F": 80, "E": 100, "D": -120, "B": 60, "A": 20}
    camera = Camera(290, 0, 384, 192)
    surface = 0
    sizes = {"red": (64, 32, 40), "green": (56, 28, 30), "blue": (60, 28, 30), "yellow": (48, 28, 24),
             "magenta": (52, 32, 36)}
    places = {"red": (400, 0, 0), "green": (392, 60, 0), "blue": (392, -60, 0), "yellow": (300, 0, 90),
              "magenta": (250, 0, 90)}

    @staticmethod
    def opening(jaws):
        return 50.8 - 0.79375 * jaws

    @staticmethod
    def solve(x, y, z, yaw):
        """The couplings of shoulder, elbow and wrist cancel, so that each motor sets the attitude of one
        link against the horizontal. With C at 0 the hand points down."""
        base = math.degrees(math.atan2(y, x))
        upper, forearm = two_links(math.hypot(x, y) - 9.5, z + 168.3 - 260.4, 228.6, 228.6)
        roll = base - yaw
        return {"F": round(base / 0.2269), "E": round((90 - upper) / 0.1135), "D": round(forearm / 0.1135),
                "C": 0, "B": round(least(roll + 90) / 0.3125)}


class AdeptOne:
    name = "adept-one"
    homing = "CEDB"
    masks = {"E": 4, "D": 2, "C": 1, "B": 32, "A": 16}
    hard_home = {"E": -20, "D": -20, "C": -30, "B": 25, "A": -40}
    displaced = {"E": 150, "D": 90, "C": 40, "B": -100, "A": 30}
    camera = Camera(540, 0, 480, 192)
    surface = 500
    sizes = {"red": (80, 40, 40), "green": (72, 36, 40), "blue": (70, 40, 30), "yellow": (60, 32, 30),
             "magenta": (64, 36, 50)}
    places = {"red": (700, 0, 0), "green": (700, 90, 0), "blue": (700, -90, 30), "yellow": (500, 0, 90),
              "magenta": (400, 0, 90)}

    @staticmethod
    def opening(jaws):
        return 60 - 0.5 * jaws

    @staticmethod
    def solve(x, y, z, yaw):
        """Two links in the horizontal plane; the second joint and the roll turn in the opposite sense."""
        first, second = two_links(x, y, 425, 375)
        elbow = first - second
        roll = first - elbow - yaw
        return {"E": round(first / 0.1), "D": round(elbow / 0.1), "C": round((877 - 200 - z - 100) / 0.5),
                "B": round((least(roll) - 90) / 0.3125)}


class Intelledex660:
    name = "intelledex-660"
    homing = "DECBFG"
    masks = {"G": 16, "F": 8, "E": 4, "D": 2, "C": 1, "B": 32, "A": 16}
    hard_home = {"G": 20, "F": -20, "E": -25, "D": 25, "C": 30, "B": -30, "A": -40}
    displaced = {"G": 100, "E": 120, "D": -120, "C": -100, "B": 60, "A": 20}
    camera = Camera(400, 0, 480, 192)
    surface = 0
    sizes = {"red": (60, 30, 40), "green": (56, 28, 30), "blue": (60, 28, 30), "yellow": (50, 30, 24),
             "magenta": (52, 30, 36)}
    places = {"red": (540, 0, 0), "green": (540, 70, 0), "blue": (540, -70, 150), "yellow": (330, 0, 90),
              "magenta": (250, 0, 90)}

    @staticmethod
    def opening(jaws):
        return 2 * 60 * math.sin(math.radians(40 - 0.5 * jaws) / 2)

    @staticmethod
    def solve(x, y, z, yaw):
        """The shoulder roll stays at 0, so that the arm moves in the vertical plane of the base."""
        azimuth = math.degrees(math.atan2(y, x))
        upper, forearm = two_links(math.hypot(x, y), z + 228.6 - 373.4, 304.8, 304.8)
        shoulder, elbow = 90 + upper, forearm - upper
        wrist = 90 - shoulder - elbow
        return {"G": round(azimuth / 0.1), "F": 0, "E": round((shoulder - 90) / 0.1), "D": round(elbow / 0.1),
                "C": round((wrist - 90) / 0.1), "B": round(least(azimuth - yaw) / 0.3125)}


ARMS = RhinoXr3, AdeptOne, Intelledex660
