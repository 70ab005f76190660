"""The bytes of a serial line as commands. From docs/protocol.md and data/commands.json.

A parser calls `execute(command, *arguments)` at the byte with which the command acts, and `warn(code)` for what was
ignored. It knows nothing of the robot or of the profile.
"""

import json
import pathlib
import re

JOINTS = "ABCDEFGH"
BLANKS = " \0"
DIGITS = "0123456789"
ARGUMENT_BYTES = DIGITS + "+-," + BLANKS
DATA = pathlib.Path(__file__).parents[2] / "data/commands.json"
FORMS = {command["form"]: command["name"] for part in json.loads(DATA.read_text(encoding="utf-8")).values()
         if isinstance(part, list) for command in part}
ONE_BYTE = {form: name for form, name in FORMS.items() if len(form) == 1}
OF_A_JOINT = {form[1]: name for form, name in FORMS.items() if re.fullmatch("a[^a-z]", form)}
OF_A_LINE = {form[0]: name for form, name in FORMS.items() if re.fullmatch("[A-Z]n", form)}
ENVIRONMENT = {form[1]: name for form, name in FORMS.items() if re.fullmatch("A[^a-z]", form)}
WITH_ARGUMENTS = "!.%*"
WORDS = {"HELP", "HELLO", "QUIT", "EXIT", "BYE", "LOGOUT", "STOP", "HALT", "HOME", "RESET", "OPEN", "CLOSE"}


class Parser:
    def __init__(self, execute, warn):
        self.execute = execute
        self.warn = warn
        self.reset()

    def reset(self):
        self.joint = None  # the selected one
        self.partial = ""  # the bytes of an unfinished command, without the label
        self.is_skipping = False  # numbers are ignored up to the next letter or the end of the line
        self.line = ""  # the bytes since the last line end

    def feed(self, byte):
        char = chr(byte).upper() if byte < 128 else "\x80"
        is_number = self.partial[:1] in ("+", "-", *DIGITS)
        if is_number and char == ".":
            self._continue(char)
            self._decimal_point()
        elif not self.partial or not self._continue(char):
            self._begin(char)
        self._end_word(char)

    def _decimal_point(self):
        self.warn("decimal_point")
        if self.joint == "A":
            self._begin(".")
        else:
            self.is_skipping = True

    def _end_word(self, char):
        if char not in "\r\n":
            self.line += char
            return
        if self.line.lstrip(BLANKS) in WORDS:
            self.warn("word")
        self.line = ""

    def is_enabling(self, byte):
        """Handles a byte that arrives while the simulator is disabled; returns whether it ends an `A@`. A partial
        command and the selected joint are lost, but not an A without a partial command."""
        char = chr(byte).upper()
        has_a = self.joint == "A" and not self.partial
        if has_a and char in BLANKS:
            return False
        is_end = has_a and char == "@"
        self.reset()
        self.joint = "A" if char == "A" else None
        if not is_end and char not in "A\r\n" + BLANKS:
            self.warn("disabled")
        return is_end

    def ignore(self, code):
        """Skips a byte, and with it the numbers up to the next letter."""
        self.warn(code)
        self.is_skipping = True

    def _begin(self, char):
        """A byte that does not continue a command."""
        if char.isalpha():
            self.is_skipping = False
        if char in "\r\n":
            self.joint = None
            self.is_skipping = False
        elif char in BLANKS:
            pass
        elif char in JOINTS:
            self.joint = char
        elif char in ONE_BYTE:
            self.execute(ONE_BYTE[char])
        elif char in OF_A_LINE:
            self.partial = char
        elif char in DIGITS or char in "+-":
            self._begin_number(char)
        elif char in OF_A_JOINT or char == "S":
            self._act_on_joint(char)
        elif self.joint == "A" and char in ENVIRONMENT:
            self.joint = None
            self.execute(ENVIRONMENT[char])
        elif self.joint == "A" and char in WITH_ARGUMENTS:
            self.joint = None
            self.partial = char
        else:
            self.ignore("unknown_byte")

    def _begin_number(self, char):
        if self.is_skipping:
            self.warn("unknown_byte")
        elif self.joint is None:
            self.ignore("no_joint_selected")
        else:
            self.partial = char

    def _act_on_joint(self, char):
        if char == "S":  # a speed's S directly follows its digits
            self.ignore("unknown_byte" if self.joint else "no_joint_selected")
        elif self.joint is None:
            self.warn("no_joint_selected")
        else:
            self.execute(OF_A_JOINT[char], self.joint)

    def _continue(self, char):
        """Handles a byte after the beginning of a command; returns whether the byte belongs to it."""
        first = self.partial[0]
        if first in OF_A_LINE:
            return self._digit_command(char, OF_A_LINE[first], "12345678")
        if first == "%":
            return self._digit_command(char, "select_status", "0123456")
        if first == "!":
            return self._until(char, "!", self._view, "bad_view_vector")
        if first == "*":
            return self._until(char, "*", self._camera, "bad_camera_argument")
        return self._number(char)

    def _digit_command(self, char, command, allowed):
        if char in BLANKS:
            return True
        self.partial = ""
        if char in allowed:
            self.execute(command, int(char))
        elif char in DIGITS:
            self.warn("number_out_of_range")
        else:
            self.ignore("incomplete_command")
        return char in DIGITS

    def _until(self, char, end, finish, error):
        """Collects the arguments of `A!` or `A*`."""
        if char == end:
            text, self.partial = self.partial[1:], ""
            finish([number.strip(BLANKS) for number in text.split(",")] if text.strip(BLANKS) else [])
            return True
        if char in ARGUMENT_BYTES:
            self.partial += char
            return True
        self.partial = ""
        self.ignore("incomplete_command" if char in "\r\n" else error)
        return False

    def _view(self, numbers):
        vector = [int(re.sub(f"[{BLANKS}]", "", number)) for number in numbers or "111"
                  if re.fullmatch(f"[+-]?[{BLANKS}]*[0-9]+", number)]
        if len(numbers) in (0, 3) and len(vector) == 3 and any(vector) and all(-9 <= number <= 9 for number in vector):
            self.execute("set_view_vector", *vector)
        else:
            self.warn("bad_view_vector")

    def _camera(self, numbers):
        if len(numbers) > 2 or not all(re.fullmatch("[0-9]+", number) for number in numbers):
            self.warn("bad_camera_argument")
        else:
            self.execute(["camera_image", "camera_row", "camera_pixel"][len(numbers)], *map(int, numbers))

    def _number(self, char):
        """A move, a speed, or the period of `A.`."""
        if char in DIGITS:
            self.partial += char
            return True
        if self.partial == "." and char in BLANKS:
            return True
        text, self.partial = self.partial, ""
        if text[-1] not in DIGITS:
            self.ignore("incomplete_command")
            return False
        if text[0] == ".":
            self.execute("set_refresh_period", int(text[1:]))
            return False
        if char == "S" and text[0] in DIGITS:
            self.execute("set_speed", self.joint, int(text))
            return True
        self.execute("move", self.joint, int(text))
        return False
