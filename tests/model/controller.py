"""A second implementation of the robot controller: slow, plain, and written from the documentation alone.

It was written from docs/protocol.md, docs/kinematics.md, docs/data-files.md and data/*.json, without the sources of
the server, so that a mistake of one is not a mistake of both. Not modelled: blocks within the robot's reach and the
jaws that grip them, blocks with a yaw and perspective in the camera's image, HTTP clients on a line, and the pictures
of the display.
"""

from .camera import image
from .machine import Machine
from .parser import Parser
from .telnet import Telnet

SPACE = 32
ALL_BITS = 63
MOVES = range(-128, 128)
SPEEDS = range(1, 256)
PERIODS = range(1, 256)


class Line:
    """A serial line: its own telnet filter and parser; the controller is shared."""

    def __init__(self, controller):
        self.controller = controller
        self.telnet = Telnet()
        self.reply = b""
        self.parser = Parser(self._execute, controller.warn)
        if not controller.enabled:
            controller.warn("disabled")

    def send(self, data):
        """Processes the bytes; returns the bytes that come back."""
        sent = b""
        for byte in data:
            answer, bytes_for_robot = self.telnet.feed(byte)
            sent += answer
            for each in bytes_for_robot:
                sent += self.telnet.reply(self._feed(each))
        return sent

    def _feed(self, byte):
        self.reply = b""
        if self.controller.enabled:
            self.parser.feed(byte)
        elif self.parser.is_enabling(byte):
            self.controller.toggle_simulator()
        return self.reply

    def _execute(self, command, *arguments):
        self.reply += getattr(self.controller, command)(*arguments) or b""


class Controller:
    """The methods have the names of the commands in data/commands.json; inquiries return the bytes of the reply."""

    def __init__(self, robot, profile, workcell):
        self.robot = robot
        self.is_mark3 = profile == "mark3"
        self.workcell = workcell
        self.camera = image(workcell)
        self.warnings = []
        self.reset()

    def reset(self):
        """The state at the start, and after the monitor's call `reset`."""
        self.machine = Machine(self.robot, self.workcell["work_surface"], self.workcell["surface_stalls"], self.warn)
        self.inputs = [False] * 8
        self.outputs = [False] * 8
        self.aux = [False] * 2
        self.enabled = True
        self.display = {"on": False, "view": [1, 1, 1], "erase": True, "period_ticks": 3000, "status": 0}

    def warn(self, code):
        self.warnings.append(code)

    def _place(self, label):
        """The motor with this label, or None if this robot has no such joint."""
        place = self.machine.place.get(label)
        if place is None:
            self.warn("no_such_joint")
        return place

    # Motion

    def move(self, label, counts):
        if self.is_mark3:
            counts = (counts + 128) % 256 - 128
        if counts not in MOVES:
            return self.warn("number_out_of_range")
        place = self._place(label)
        if place is not None and self.machine.move(place, counts):
            self.warn("counter_overflow")

    def set_speed(self, label, speed):
        if speed not in SPEEDS:
            return self.warn("speed_out_of_range")
        place = self._place(label)
        if place is not None:
            self.machine.speeds[place] = speed

    def stop(self, label):
        place = self._place(label)
        if place is not None:
            self.machine.stop(place)

    def query_error(self, label):
        place = self._place(label)
        value = SPACE + (abs(self.machine.errors[place]) if place is not None else 0)
        return bytes([value & 0x7F if self.is_mark3 else value])

    def query_signed_error(self, label):
        place = self._place(label)
        return bytes([self.machine.errors[place] % 256 if place is not None else 0])

    def query_switch(self, label):
        place = self._place(label)
        is_closed = place is not None and self.machine.is_closed(place)
        return bytes([is_closed != self.is_mark3])

    # Switches and digital lines

    def masks(self, labels, closed):
        """The sum of the masks of the switches of these joints that are closed, or open."""
        return sum(self.robot.motors[place].switch_mask for label, place in self.machine.place.items()
                   if label in labels and self.machine.is_closed(place) == closed)

    def query_switches_i(self):
        closed = self.masks("CDEFGH", closed=True)
        return bytes([SPACE + (ALL_BITS - closed if self.is_mark3 else closed)])

    def query_switches_j(self):
        taken = sum(motor.switch_mask for motor in self.robot.motors if motor.label in "AB")
        free = [1 << bit for bit in range(6) if not taken & 1 << bit] if taken > 3 else [4, 8, 16, 32]
        lines = sum(bit for bit, is_high in zip(free, self.inputs[4:]) if is_high)
        return bytes([SPACE + lines + self.masks("AB", closed=not self.is_mark3)])

    def query_inputs(self):
        return bytes([SPACE + sum(1 << index for index, is_high in enumerate(self.inputs[:4]) if is_high)])

    def auxiliary_1_on(self):
        self.aux[0] = True

    def auxiliary_1_off(self):
        self.aux[0] = False

    def auxiliary_2_on(self):
        self.aux[1] = True

    def auxiliary_2_off(self):
        self.aux[1] = False

    def output_high(self, number):
        self.outputs[number - 1] = True

    def output_low(self, number):
        self.outputs[number - 1] = False

    def controller_reset(self):
        self.machine.reset_controller()
        self.outputs = [False] * 8
        self.aux = [False] * 2

    # Environment

    def soft_home(self):
        self.machine.home()

    def toggle_simulator(self):
        self.enabled = not self.enabled

    def toggle_display(self):
        self.display["on"] = not self.display["on"]

    def toggle_erasing(self):
        self.display["erase"] = not self.display["erase"]

    def set_view_vector(self, *vector):
        self.display["view"] = list(vector)

    def set_refresh_period(self, half_seconds):
        if half_seconds not in PERIODS:
            return self.warn("number_out_of_range")
        self.display["period_ticks"] = 500 * half_seconds

    def select_status(self, option):
        self.display["status"] = option

    def camera_image(self):
        return b"".join(map(self._row, self.camera))

    def camera_row(self, row):
        if row >= len(self.camera):
            return self.warn("bad_camera_argument")
        return self._row(self.camera[row])

    def camera_pixel(self, column, row):
        if row >= len(self.camera) or column >= len(self.camera[row]):
            return self.warn("bad_camera_argument")
        return bytes([SPACE + int(self.camera[row][column])])

    @staticmethod
    def _row(row):
        parts = [row[start:start + 6] for start in range(0, len(row), 6)]
        return bytes(SPACE + int(part.ljust(6, "0"), 2) for part in parts)
