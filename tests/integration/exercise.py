"""The classic exercise: home the arm by its microswitches, look at the table through the camera, work
out where each block lies, pick it up, put it elsewhere, and look again.

A program for the robot's serial line and nothing else: what it knows are the arm's data sheet
(exercise_arms.py), what a picture is (exercise_sight.py), and the bytes that come back. `wait(ms)` lets
simulated time pass.
"""

from collections import deque

from exercise_sight import Picture

SPACE = 32  # what every reply of one byte is counted from
STRIDE = 60  # most counts of one move of an arm that goes somewhere in a straight line of counts
STANDS_MS = 100  # a counter that stays for so long is that of a motor that stands
CLOSING = 100  # counts that close the jaws on anything
LIFT_MM = 100


class Robot:
    """The arm at the other end of a serial line. After home() it knows its own counts: `at`."""

    def __init__(self, arm, line, wait):
        self.arm = arm
        self.line = line
        self.wait = wait
        self.at = {}

    # --- Bytes.

    def send(self, label, counts):
        self.line.send(f"{label}{counts:+d}\r")

    def to_go(self, label):
        return self.line.ask(f"{label}?") - SPACE

    def is_closed(self, label):
        return self.line.ask(f"{label}V") == 1

    def finish(self, label):
        """Waits until the joint is there, or stands and is stopped; returns the counts that were left."""
        left = self.to_go(label)
        while left:
            self.wait(STANDS_MS)
            before, left = left, self.to_go(label)
            if left == before:
                self.line.send(f"{label}X")
                break
        return left

    # --- Home.

    def home(self):
        """Every joint to its microswitch; one that stands is put off until others have moved. Then the
        jaws, fully open."""
        waiting = deque(self.arm.homing)
        for _ in range(4 * len(waiting)):
            if not waiting:
                break
            label = waiting.popleft()
            if not self.find_switch(label):
                waiting.append(label)
        assert not waiting, f"{waiting} found no switch"
        assert self.find_switch("A"), "the jaws found no switch"
        self.at = dict(self.arm.hard_home)

    def find_switch(self, label):
        """The edge at which the switch closes, coming from the open side. False: the joint stands."""
        way = 1 if self.arm.hard_home[label] > 0 else -1
        return (self.creep(label, -5 * way, closed=False) and self.creep(label, 5 * way, closed=True)
                and self.creep(label, -way, closed=False) and self.creep(label, way, closed=True))

    def creep(self, label, counts, closed):
        """Small moves until the switch is as wanted. False: the joint stands and it is not."""
        while self.is_closed(label) != closed:
            self.send(label, counts)
            if self.finish(label):
                return self.is_closed(label) == closed
        return True

    # --- See.

    def see(self):
        camera = self.arm.camera
        self.line.send("A**")
        return Picture.decode(self.line.read(camera.bytes), camera)

    # --- Move.

    def move(self, counts):
        """All motors together to these counts, in equal parts."""
        way = {label: wanted - self.at[label] for label, wanted in counts.items()}
        parts = -(-max(map(abs, way.values())) // STRIDE) or 1
        for part in range(1, parts + 1):
            self.stride({label: round(left * part / parts) - round(left * (part - 1) / parts)
                         for label, left in way.items()})

    def stride(self, way):
        for label, counts in way.items():
            if counts:
                self.send(label, counts)
        for label, counts in way.items():
            left = self.finish(label)
            assert not left, f"{label} stands {left} counts short of where it was sent"
            self.at[label] += counts

    def move_to(self, x, y, z, yaw):
        self.move(self.arm.solve(x, y, z, yaw))

    # --- Pick and place.

    def open_jaws(self):
        self.move({"A": self.arm.hard_home["A"]})

    def close_jaws(self):
        """Closes until something is in the way; returns the opening in mm, or None if nothing was. What
        is left in the counter measures the block; it has to go before the jaws can open again."""
        self.send("A", -CLOSING)
        left = self.finish("A")
        self.at["A"] -= CLOSING - left
        return self.arm.opening(self.at["A"]) if left else None

    def pick(self, x, y, z, yaw):
        """Takes the block whose centroid is there; returns how wide the jaws found it."""
        self.open_jaws()
        self.move_to(x, y, z + LIFT_MM, yaw)
        self.move_to(x, y, z, yaw)
        width = self.close_jaws()
        self.move_to(x, y, z + LIFT_MM, yaw)
        return width

    def place(self, x, y, z, yaw):
        """Puts what it holds down there."""
        self.move_to(x, y, z + LIFT_MM, yaw)
        self.move_to(x, y, z, yaw)
        self.open_jaws()
        self.move_to(x, y, z + LIFT_MM, yaw)


def exercise(robot, looked=lambda *_: None):
    """Moves every block of the table to its new place. The first look tells blocks by their sizes, the
    next ones by what has moved; `looked(name, width, patches)` is told what the jaws measured and
    which patch of the picture is which block now."""
    robot.home()
    patches = robot.see().find(robot.arm.sizes)
    for name, (x, y, yaw) in robot.arm.places.items():
        block = patches[name]
        z = robot.arm.surface + robot.arm.sizes[name][2] / 2
        width = robot.pick(block.x, block.y, z, block.yaw)
        robot.place(x, y, z, yaw)
        patches = robot.see().follow(patches, name)
        looked(name, width, patches)
