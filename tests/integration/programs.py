"""Three programs that drove the real arm, as the bytes they send and what they make of the replies.

They know a serial line and a way to let milliseconds pass, nothing else: `wait(ms)` steps the monitor's
clock, or does nothing where the clock runs. The first two want --compat mark3, where a switch bit of
`I` reads 1 for open.
"""

SPACE = 32  # what every reply of one byte is counted from
BIT = {"F": 8, "E": 4, "D": 2, "C": 1}


class Trs80:
    """The driver of 1983: blocks on single reply bytes, sends no CR behind an inquiry, and never lets
    95 counts wait in an error counter. Two equal replies 22 ms apart mean a motor that is stuck."""

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
        """Asks until the counts to go are few enough. False: the motor is stuck and was stopped."""
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
        """One move, as soon as there is room for it."""
        if not self.until(label, lambda left: left + abs(count) < self.ROOM):
            return False
        self.line.send(f"{label}{count:+d}\r")
        return True

    def move(self, label, count):
        """A move of any size in chunks, waiting for its end."""
        while count:
            chunk = max(-self.LARGEST_MOVE, min(self.LARGEST_MOVE, count))
            if not self.step(label, chunk):
                return False
            count -= chunk
        return self.until(label, lambda left: left == 0)

    def search(self, label, stride, follower):
        """Strides until the switch closes; the follower turns against it. False: stuck, or not found."""
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
        """Single counts until the switch opens; returns how many it took."""
        steps = 0
        while not self.is_open(label):
            assert self.move(label, count), f"{label} is stuck while it creeps"
            steps += 1
        return steps

    def home(self, label, follower=None):
        """Finds the middle of the range in which the switch is closed. False: not found."""
        if not (self.search(label, -self.STRIDE, follower) or self.search(label, self.STRIDE, follower)):
            return False
        self.creep(label, -1)
        self.move(label, 20)
        width = 20 + self.creep(label, 1)
        return self.move(label, -(width // 2))


class LabProgram:
    """Steps of two counts, each polled every 10 ms until it is done; homes with a bare `I`."""

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
        """An even number of counts; ends with a move of none, which the hardware never minded."""
        sign = 1 if count > 0 else -1
        for _ in range(abs(count) // 2):
            self.line.send(f"{label}{2 * sign:+d}\r\n")
            self.finish(label)
        self.line.send(f"{label}+0\r\n")

    def home(self, label):
        """Single counts up until the bit of the switch clears."""
        while self.line.ask("I") - SPACE & BIT[label]:
            self.line.send(f"{label}+1\r\n")
            self.finish(label)


def write_only(line, wait):
    """Never reads: trusts that 240 ms are enough for most of a move. E ends at -224, D at +219."""
    for write in [*["E-50\r\n"] * 4, "E-24\r\n", *["D+50\r\n"] * 4, "D+19\r\n", "D-0\r\n"]:
        line.send(write)
        wait(240)
