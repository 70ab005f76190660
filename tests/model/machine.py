"""The machine: motors that count towards a zero error counter, one tick at a time. From docs/protocol.md."""

from .robot import micrometres

THOUSANDTHS = 1000  # parts of a count; a tick is a millisecond, so a motor makes `speed` thousandths per tick


def to_8_bits(number):
    return (number + 128) % 256 - 128


class Machine:
    def __init__(self, robot, surface_mm, surface_stalls, warn):
        self.robot = robot
        self.surface = micrometres(surface_mm)
        self.surface_stalls = surface_stalls
        self.warn = warn
        self.size = len(robot.motors)
        self.place = {motor.label: place for place, motor in enumerate(robot.motors)}
        self.tick = 0
        self.home()
        self.reset_controller()

    def home(self):
        self.counts = [0] * self.size
        self.positions = [0] * self.size
        self.errors = [0] * self.size
        self.phases = [0] * self.size
        self.stalled = None
        self.is_below = False  # whether the tip is below the work surface

    def reset_controller(self):
        self.errors = [0] * self.size
        self.phases = [0] * self.size
        self.speeds = [motor.speed for motor in self.robot.motors]

    def move(self, place, counts):
        """Adds to the error counter. Returns whether it wrapped."""
        total = self.errors[place] + counts
        self._set_error(place, to_8_bits(total))
        return total != self.errors[place]

    def stop(self, place):
        self._set_error(place, 0)

    def _set_error(self, place, error):
        """A motor that stops or turns round begins a new count; one that only gets more to do does not."""
        if error * self.errors[place] <= 0:
            self.phases[place] = 0
        self.errors[place] = error

    def is_closed(self, place):
        return self.robot.motors[place].is_closed(self.counts[place])

    def will_count(self, place):
        """Whether the motor will make a count without new input."""
        return self.errors[place] != 0 and not self.stalled and not self.is_blocked(place)

    def is_blocked(self, place):
        """Whether the next count would take its own joint, or one that is coupled to it, past a limit."""
        step = self._step(place)
        return step != 0 and any(
            not self.robot.motors[joint].low <= self.positions[joint] + sign * step <= self.robot.motors[joint].high
            for joint, sign in self.robot.moved_by[place])

    def _step(self, place):
        """The next count: 1, -1, or 0 if there is none to go."""
        return (self.errors[place] > 0) - (self.errors[place] < 0)

    def advance(self, ticks):
        for done in range(ticks):
            running = [place for place in range(self.size) if self.will_count(place)]
            if not running:
                self.tick += ticks - done
                return
            self._advance_one(running)

    def _advance_one(self, running):
        """One tick. The motors that are not blocked at its start run; then those that are due make their counts in
        order, from the base to the tool."""
        self.tick += 1
        before = list(self.counts), list(self.positions), list(self.errors), list(self.phases)
        for place in running:
            self.phases[place] += self.speeds[place]
            if self.phases[place] >= THOUSANDTHS:
                self.phases[place] -= THOUSANDTHS
                if not self.is_blocked(place):
                    self._count(place)
        for place in running:
            if self.is_blocked(place):
                self.phases[place] = 0
        if self.counts != before[0]:
            self._check_tip()
            if self.stalled:
                self.counts, self.positions, self.errors, self.phases = before

    def _count(self, place):
        step = self._step(place)
        self.counts[place] += step
        for joint, sign in self.robot.moved_by[place]:
            self.positions[joint] += sign * step
        self._set_error(place, self.errors[place] - step)

    def _check_tip(self):
        tip = self.robot.tip(self.positions)
        is_below = tip[2] < self.surface
        if self.robot.is_protected(tip):
            self.stalled = "protected_region"
        elif is_below and self.surface_stalls:
            self.stalled = "work_surface"
        else:
            if is_below and not self.is_below:
                self.warn("below_surface")
            self.is_below = is_below
