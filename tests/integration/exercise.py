"""The classic exercise: home the arm with its microswitches, take a picture of the table, compute the
position of each block, pick the block up, place it elsewhere, and take another picture.

The program uses only the serial line, the arm's data sheet (exercise_arms.py) and image processing
(exercise_sight.py). `wait(ms)` advances simulated time.
"""

from collections import deque

from exercise_sight import Picture

SPACE = 32  # offset of every one-byte reply
STRIDE = 60  # maximum counts of one command of a coordinated move
STANDS_MS = 100  # a motor whose error counter stays equal for this time is blocked
CLOSING = 100  # counts that close the jaws on a block of any width
STEP = 5  # counts of one move in the search for a switch
WIDEST = 100  # more counts than a switch is closed, if it opens again beyond
LIFT_MM = 100


class Robot:
    """A robot at the other end of a serial line. `at` has the encoder counts, known after home()."""

    def __init__(self, arm, line, wait):
        self.arm = arm
        self.line = line
        self.wait = wait
        self.at = {}

    # --- Bytes.

    def send(self, label, counts):
        self.line.send(f"{label}{counts:+d}\r")

    def to_go(self, label):
        """The counts to go, up to 127; in the profile mark3 the reply has seven bits."""
        return (self.line.ask(f"{label}?") - SPACE) % 128

    def switch(self, label):
        """The bit of the switch; whether a closed one reads 1 or 0 depends on the profile."""
        return bool(self.line.ask("J" if label < "C" else "I") - SPACE & self.arm.masks[label])

    def finish(self, label):
        """Waits until the move is done, or stops the joint if it is blocked; returns the counts left."""
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
        """Moves every joint to its microswitch; retries a blocked joint after others have moved. Then
        opens the jaws fully."""
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
        """Finds the count at which the switch closes, from the open side, which is the side of the soft home.
        False: the switch does not change before the joint is blocked."""
        away = STEP if self.arm.hard_home[label] > 0 else -STEP
        if not (self.changes(label, away) or self.changes(label, -away)):
            return False
        while self.changes(label, -away, WIDEST):
            pass
        return self.changes(label, away) and self.changes(label, -away) and self.changes(label, away // STEP)

    def changes(self, label, counts, farthest=2000):
        """Moves in small steps until the switch changes. False: it does not, or the joint is blocked before."""
        before = self.switch(label)
        for _ in range(farthest // abs(counts)):
            self.send(label, counts)
            left = self.finish(label)
            if self.switch(label) != before:
                return True
            if left:
                break
        return False

    # --- See.

    def see(self):
        camera = self.arm.camera
        self.line.send("A**")
        return Picture.decode(self.line.read(camera.bytes), camera)

    # --- Move.

    def move(self, counts):
        """Moves all motors at the same time to these counts, in equal parts."""
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
            assert not left, f"{label} stopped {left} counts short of its target"
            self.at[label] += counts

    def move_to(self, x, y, z, yaw):
        self.move(self.arm.solve(x, y, z, yaw))

    # --- Pick and place.

    def open_jaws(self):
        self.move({"A": self.arm.hard_home["A"]})

    def close_jaws(self):
        """Closes the jaws; returns the opening in mm, or None if they closed on nothing. The counts that
        remain in the error counter measure the block; finish() clears them so that the jaws can open."""
        self.send("A", CLOSING)
        left = self.finish("A")
        self.at["A"] += CLOSING - left
        return self.arm.opening(self.at["A"]) if left else None

    def pick(self, x, y, z, yaw):
        """Picks up the block with this centroid; returns its width as measured by the jaws."""
        self.open_jaws()
        self.move_to(x, y, z + LIFT_MM, yaw)
        self.move_to(x, y, z, yaw)
        width = self.close_jaws()
        self.move_to(x, y, z + LIFT_MM, yaw)
        return width

    def place(self, x, y, z, yaw):
        """Places the held block with its centroid there."""
        self.move_to(x, y, z + LIFT_MM, yaw)
        self.move_to(x, y, z, yaw)
        self.open_jaws()
        self.move_to(x, y, z + LIFT_MM, yaw)


def exercise(robot, looked=lambda *_: None):
    """Moves every block of the table to its new place. The first picture identifies blocks by their sizes,
    the later ones by which block has moved. After each block `looked(name, width, patches)` receives the
    width that the jaws measured and the patch of each block in the new picture."""
    robot.home()
    patches = robot.see().find(robot.arm.sizes)
    for name, (x, y, yaw) in robot.arm.places.items():
        block = patches[name]
        z = robot.arm.surface + robot.arm.sizes[name][2] / 2
        width = robot.pick(block.x, block.y, z, block.yaw)
        robot.place(x, y, z, yaw)
        patches = robot.see().follow(patches, name)
        looked(name, width, patches)
