"""Four programs for the real arm, reduced to the bytes that they send and their reactions to the replies.

They use only a serial line and `wait(ms)`, which steps the manual clock, or does nothing if the clock
runs. The first three need --compat mark3, where a switch bit of `I` is 1 for open.
"""

SPACE = 32  # offset of every one-byte reply
BIT = {"F": 8, "E": 4, "D": 2, "C": 1, "B": 32, "A": 16}  # bits of the reply to I; to J for B and A


class Trs80:
    """The driver of 1983: it blocks on single reply bytes, sends no CR after an inquiry, and keeps error
    counters below 95 counts. Two equal replies 22 ms apart mean that the motor is stuck."""

    LARGEST_MOVE = 85
    ROOM = 95
    PAUSE_MS = 22
    MOST_TRIES = 25
    STRIDE = 50

    def __init__(self, line, wait):
        self.line = line
        self.wait = wait
        self.stuck = []  # the motors that were found stuck, in order

    def to_go(self, label):
        return self.line.ask(f"{label}?") - SPACE

    def is_open(self, label):
        return bool(self.line.ask("I") - SPACE & BIT[label])

    def until(self, label, is_enough):
        """Polls until is_enough(counts to go). False: the motor is stuck and was stopped."""
        left = self.to_go(label)
        while not is_enough(left):
            self.wait(self.PAUSE_MS)
            before, left = left, self.to_go(label)
            if left == before:
                self.line.send(f"{label}X")
                self.stuck.append(label)
                return False
        return True

    def step(self, label, count):
        """Sends one move when the error counter has room for it. False: the motor is stuck."""
        if not self.until(label, lambda left: left + abs(count) < self.ROOM):
            return False
        self.line.send(f"{label}{count:+d}\r")
        return True

    def move(self, label, count):
        """Moves by any number of counts in chunks and waits for the end. False: the motor is stuck."""
        while count:
            chunk = max(-self.LARGEST_MOVE, min(self.LARGEST_MOVE, count))
            if not self.step(label, chunk):
                return False
            count -= chunk
        return self.until(label, lambda left: left == 0)

    def search(self, label, stride, follower):
        """Moves in strides until the switch closes; the follower moves in the opposite direction. False:
        stuck, or not found."""
        for _ in range(self.MOST_TRIES):
            self.is_open(label)
            if not self.step(label, stride):
                return False
            if not self.is_open(label):
                self.line.send(f"{label}X")
                return True
            if follower:
                self.step(follower, -stride)
        return False

    def creep(self, label, count):
        """Moves by single counts until the switch opens; returns the number of counts."""
        steps = 0
        while not self.is_open(label):
            assert self.move(label, count), f"{label} is stuck while it creeps"
            steps += 1
        return steps

    def home(self, label, follower=None):
        """Moves to the middle of the range in which the switch is closed. False: not found, or stuck."""
        if not (self.search(label, -self.STRIDE, follower) or self.search(label, self.STRIDE, follower)):
            return False
        self.creep(label, -1)
        self.move(label, 20)
        width = 20 + self.creep(label, 1)
        return self.move(label, -(width // 2))


class LabProgram:
    """Moves in steps of two counts and polls each every 10 ms until it is done; homes with `I`."""

    POLL_MS = 10

    def __init__(self, line, wait):
        self.line = line
        self.wait = wait
        self.polls = 0

    def finish(self, label):
        while self.line.ask(f"{label}?") != SPACE:
            self.polls += 1
            self.wait(self.POLL_MS)

    def move(self, label, count):
        """Moves by an even number of counts; ends with a move by 0, which the hardware accepted."""
        sign = 1 if count > 0 else -1
        for _ in range(abs(count) // 2):
            self.line.send(f"{label}{2 * sign:+d}\r\n")
            self.finish(label)
        self.line.send(f"{label}+0\r\n")

    def home(self, label):
        """Moves up by single counts until the bit of the switch is 0."""
        while self.line.ask("I") - SPACE & BIT[label]:
            self.line.send(f"{label}+1\r\n")
            self.finish(label)


class LabDriver:
    """The driver of a laboratory: it resets, keeps error counters below 95 counts, takes ten equal replies for a
    stalled motor and backs off, homes in steps of 20 by `I` and `J`, and closes the gripper by A+."""

    SILENCE_MS = 500  # after the reset
    POLL_MS = 20
    ROOM = 95
    STALL_REPLIES = 10
    STEP = 20
    MOST_STEPS = 60  # a turn of B, and a little
    TOWARD = {"E": -1, "D": 1, "B": 1, "C": 1, "F": 1}  # the way of homing, in its order
    GRIP = 50

    def __init__(self, line, wait):
        self.line = line
        self.wait = wait
        line.send("Q")
        wait(self.SILENCE_MS)

    def to_go(self, label):
        return self.line.ask(f"{label}?") - SPACE

    def finish(self, label):
        """Waits for the end of a move. False: the motor stalled; its move was cancelled."""
        replies = [self.to_go(label)]
        while replies[-1]:
            self.wait(self.POLL_MS)
            replies.append(self.to_go(label))
            if replies[-self.STALL_REPLIES:].count(replies[-1]) == self.STALL_REPLIES:
                self.line.send(f"{label}X")
                return False
        return True

    def move(self, label, count, back_off=STEP):
        """Moves by any number of counts. False: it stalled, and moved back by `back_off` counts."""
        sign = 1 if count > 0 else -1
        left = abs(count)
        while left:
            part = min(left, self.ROOM - self.to_go(label))
            self.line.send(f"{label}{sign * part:+d}\r")
            left -= part
            if not self.finish(label):
                self.line.send(f"{label}{-sign * back_off:+d}\r")
                self.finish(label)
                return False
        return True

    def reads(self, label):
        """The bit of the switch."""
        return self.line.ask("J" if label in "AB" else "I") - SPACE & BIT[label]

    def is_home(self, label, _):
        return self.reads(label) == 0

    def home(self):
        for label, way in self.TOWARD.items():
            before = self.reads(label)
            for _ in range(self.MOST_STEPS):
                if self.is_home(label, before):
                    break
                assert self.move(label, way * self.STEP), f"{label} stalled before its switch closed"
            else:
                raise AssertionError(f"{label} met no switch")
        self.move("A", 200, back_off=0)
        self.ungrip()

    def grip(self):
        return self.move("A", self.GRIP, back_off=0)

    def ungrip(self):
        return self.move("A", -self.GRIP)


class LabDriverForPaper(LabDriver):
    """The program with two changes, for the profile `paper`: there a bit of 1 means closed, so it learns the polarity by
    watching a switch change; and B meets its switch on one side only, so it turns B towards it."""

    TOWARD = {**LabDriver.TOWARD, "B": -1}

    def is_home(self, label, before):
        return self.reads(label) != before


def write_only(line, wait):
    """Never reads; assumes that most of a move is done after 240 ms. E ends at -224, D at +219."""
    for write in [*["E-50\r\n"] * 4, "E-24\r\n", *["D+50\r\n"] * 4, "D+19\r\n", "D-0\r\n"]:
        line.send(write)
        wait(240)
