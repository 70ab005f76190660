"""Exercise 10: sorts three blocks by size, with a robot that loses replies, counts and blocks."""

import math
import sys

import xr3

PLACES = {"large": (380, 80), "medium": (380, 0), "small": (380, -80)}  # by area, mm
Z = 15  # half the height of all blocks, mm
NEAR_MM = 8  # a block that is so near to its place is there
HOME = {"F": 0, "E": 0, "D": 0, "C": 0, "B": 0}
ROUNDS = 10  # then the program gives up
TRIES = 5  # of an inquiry
STANDS_AFTER = 6  # equal replies: the joint stands
EDGE = -40  # count at which the switch of E closes
STEP = 5  # counts of a quick step in the search for it


class CarefulRobot(xr3.Robot):
    """Asks again if no reply comes: an inquiry changes nothing, so it may be repeated. A move may not."""

    def ask(self, inquiry):
        for _ in range(TRIES):
            try:
                return super().ask(inquiry)
            except TimeoutError:
                print(f"no reply to {inquiry}: ask again")
        sys.exit(f"no reply to {inquiry} in {TRIES} times")

    def look(self):
        for _ in range(TRIES):
            try:
                return super().look()
            except TimeoutError:
                print("no picture: ask again")
        sys.exit("the camera does not answer")

    def wait(self, label):
        left, same = self.to_go(label), 0
        while left and same < STANDS_AFTER:
            before, left = left, self.to_go(label)
            same = same + 1 if left == before else 0
        if left:
            self.stop(label)
        return left

    def home_shoulder(self):
        """Finds the edge of E's switch, and so where E really is. Returns by how much it was wrong."""
        self.go(HOME)
        while self.switch("E"):
            self.go({"E": self.at["E"] + STEP})
        while not self.switch("E"):
            self.go({"E": self.at["E"] - STEP})
        while self.switch("E"):
            self.go({"E": self.at["E"] + STEP})
        while not self.switch("E"):
            self.go({"E": self.at["E"] - 1})
        drift = EDGE - self.at["E"]
        self.at["E"] = EDGE
        return drift


def find(robot):
    """The patches by name, in the order of their areas."""
    patches = robot.look().patches()
    if len(patches) != len(PLACES):
        sys.exit(f"the picture has {len(patches)} patches, not {len(PLACES)}")
    return dict(zip(PLACES, patches))


def sort(robot):
    """Carries a block that is not at its place, looks again, and so on. Returns whether all are there."""
    for _ in range(ROUNDS):
        drift = robot.home_shoulder()
        if drift:
            print(f"E was wrong by {drift} counts")
        wrong = {name: patch for name, patch in find(robot).items()
                 if math.hypot(patch.x - PLACES[name][0], patch.y - PLACES[name][1]) > NEAR_MM}
        if not wrong:
            return True
        name, patch = next(iter(wrong.items()))
        width = robot.pick(xr3.Pose(patch.x, patch.y, Z, patch.yaw))
        if width is None:
            print(f"{name}: the jaws closed on nothing")
            continue
        print(f"{name}: the jaws hold {width:.1f} mm")
        robot.place(xr3.Pose(*PLACES[name], Z, 90))
    return False


with CarefulRobot(timeout_s=1) as arm:
    if not sort(arm):
        sys.exit(f"not sorted after {ROUNDS} rounds")
    print("sorted")
