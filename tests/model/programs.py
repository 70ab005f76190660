"""Random programs of a robot client, derived from a seed.

A program is a list of steps: ("send", line, bytes, ticks) sends bytes on a line and then lets time pass,
("close", line) closes it, and ("input", number, value), ("home",) and ("reset",) are calls of the monitor. The weights
favour moves during moves, wraps of error counters, limits, coupled joints, switches, stalls, stops, and bytes that are
almost commands.
"""

import json
import random

from .parser import DATA

ALPHABET = b"AAABCDEFGHIJKLMNOPQRSTVX00112345678999+-+-??!!..,%**|#$ \r\n\0@abcdefz_~\x80"
ENDS = ["\r", "\r", "\n", " ", "\r\n", "\0", "", "", ";"]
WAITS = [0, 0, 0, 0, 1, 1, 2, 5, 9, 10, 11, 23, 50, 100, 100, 200, 455, 700, 1000]
ODD_NUMBERS = ["", "0", "00", "007", "127", "128", "129", "200", "255", "256", "257", "300", "1000", "65536", "99999",
               "4294967296", "18446744073709551617", "9" * 30]
COMMANDS = ["I", "J", "K", "AI", "AJ", "L", "M", "N", "O", "Q", "A#", "A|", "A$", "A!!", "A!1,-2,+3!", "A!0,0,0!",
            "A!9,9,10!", "A!1,2!", "A!1\r", "A!1 ,2,3!", "A.6\r", "A.0 ", "A.255E", "A.256\r", "A.\r", "A%3", "A%0",
            "A%7", "A%\r", "A**", "A*0*", "A*4*", "A*5*", "A*3,2*", "A*10,0*", "A*9,4*", "A*,*", "A*1\r", "P1", "P8",
            "P9", "P0", "P\r", "P 3", "R\x004", "R1", "R8", "R5", "R", "P", "A ", "A", "A5$", "A$A$",
            "A@A@", "AA@a@", "A $", "A! 1, 2 ,- 3!", "A. 6 ", "A* 3 , 2 *", "A % 2", "\rhelp\r", "\r Exit\n", "\rquit",
            "\rhomes\r"]
COMMANDS += [command["example"] for part in json.loads(DATA.read_text(encoding="utf-8")).values()
             if isinstance(part, list) for command in part]
AFTER_A_LABEL = ["--5\r", "+ 5 ", "-\r5\r", "+X", "- X3 ", "-+3 ", "5 5 ", "5+5\r", "+5-3\r", "+200 5 ", "300S5 ", "0S",
                 "255S", "256S", "254S", "1S", "+5S", "5 S", "S5 ", "SX", "z5 ", "=+3 ", "zZ3 ", "z?5 ", "P95 ", "5P1",
                 "Px5 ", "5A$", "+0\r", "-0 ", "-128\r", "+127\r", "A#5 ", "$", "5\x00?", "+1\x004 ", "+2.5\r", "2.X",
                 "-.5 "]
TELNET = [b"\xff\xfb\x01", b"\xff\xfd\x06", b"\xff\xfe\x03", b"\xff\xfc\x03", b"\xff\xfd\x01", b"\xff\xf6", b"\xff\xff",
          b"\xffE", b"\xff\xfa\x18\x00vt100\xff\xf0", b"\xff\xf4\xff\xfd\x06", b"\xff\xfaE+5\xff\xff\r\xff\xf0",
          b"\xff\xfa" + b"z" * 511 + b"CD?E?", b"\xff\xf1", b"\xff\xfbE", b"\xff"]
# RFC 2217: the option at either side, requests, and commands for replies that wait. SUSPEND always has its RESUME.
COM_PORT = [b"\xff\xfb\x2c", b"\xff\xfb\x2c", b"\xff\xfd\x2c", b"\xff\xfc\x2c", b"\xff\xfe\x2c", b"\xff\xfb\x00",
            b"\xff\xfa\x2c\x01\x00\x00\x25\x80\xff\xf0", b"\xff\xfa\x2c\x01\xff\xff\x00\x00\xff\xff\xff\xf0",
            b"\xff\xfa\x2c\x01\x00\x00\x00\x00\xff\xf0", b"\xff\xfa\x2c\x02\x07\xff\xf0\xff\xfa\x2c\x02\x00\xff\xf0",
            b"\xff\xfa\x2c\x03\x09\xff\xf0\xff\xfa\x2c\x03\x00\xff\xf0", b"\xff\xfa\x2c\x04\x00\xff\xf0",
            b"\xff\xfa\x2c\x00\xff\xf0", b"\xff\xfa\x2c\x07\xff\xf0", b"\xff\xfa\x2c\x0b\xff\xff\xff\xf0",
            b"\xff\xfa\x2c\x02\x07\x07\xff\xf0", b"\xff\xfa\x2c\x40\xff\xf0", b"\xff\xfa\x2c\xff\xf0",
            b"\xff\xfa\x2c\x08\xff\xf0E?FTD-1\rDT\xff\xfa\x2c\x09\xff\xf0",
            b"\xff\xfa\x2c\x08\xff\xf0E?\xff\xfa\x2c\x0c\x01\xff\xf0C?\xff\xfa\x2c\x0c\x02\xff\xf0"
            b"\xff\xfa\x2c\x09\xff\xf0",
            b"\xff\xfa\x2c\x08\xff\xf0E?\xff\xfb\x2c\xff\xfc\x2c\xff\xfe\x2cC?"]


class Author:
    """Writes one program. `labels` are those of the robot's motors."""

    def __init__(self, seed, labels):
        self.chance = random.Random(seed)
        self.labels = labels
        self.steps = []
        self.lines = 2 if self.chance.random() < 0.25 else 1
        self.has_telnet = self.chance.random() < 0.1

    def label(self):
        label = self.chance.choice(self.labels if self.chance.random() < 0.95 else "ABCDEFGH")
        return label if self.chance.random() < 0.9 else label.lower()

    def number(self):
        what = self.chance.random()
        if what < 0.1:
            return self.chance.choice(ODD_NUMBERS)
        return str(self.chance.randint(0, 10) if what < 0.4 else self.chance.randint(1, 127))

    def sign(self):
        return self.chance.choice(["+", "-", "-", ""])

    def send(self, data, ticks=None):
        data = data.encode("latin-1") if isinstance(data, str) else data
        ticks = self.chance.choice(WAITS) if ticks is None else ticks
        line = self.chance.randrange(self.lines)
        if self.chance.random() < 0.1 and len(data) > 1:
            cut = self.chance.randrange(1, len(data))
            self.steps.append(("send", line, data[:cut], self.chance.choice(WAITS)))
            data = data[cut:]
        self.steps.append(("send", line, data, ticks))

    def inquiry(self, label):
        return self.chance.choice([label + "?", label + "?", label + "T", label + "V", label + "?TV", "I", "J"])

    # Kinds of sequences

    def move(self):
        self.send(self.label() + self.sign() + self.number() + self.chance.choice(ENDS))

    def drive(self):
        """Runs one motor far into one direction, to a switch, a limit or a stall, and asks on the way."""
        label, sign = self.label(), self.chance.choice("+-")
        for _ in range(self.chance.randint(1, 8)):
            self.send(f"{label}{sign}{self.chance.randint(60, 110)}\r{self.inquiry(label)}",
                      self.chance.choice([300, 500, 800, 1200]))
        self.send(self.inquiry(label) + self.chance.choice(["", label + "X", label + "X" + label + "?"]))

    def several(self):
        """Starts several motors at once; they may be coupled."""
        moves = [f"{self.label()}{self.sign()}{self.chance.randint(1, 120)}" for _ in range(self.chance.randint(2, 6))]
        self.send("".join(moves) + "\r")
        self.ask()

    def reach(self):
        """Runs several motors far into the same directions, so that the tip may come to where the robot stalls."""
        moves = [self.label() + self.chance.choice("+-") for _ in range(self.chance.randint(1, 3))]
        for _ in range(self.chance.randint(3, 8)):
            self.send("".join(f"{move}{self.chance.randint(80, 127)}\r" for move in moves),
                      self.chance.choice([700, 1000]))
        self.ask()
        if self.chance.random() < 0.3:
            self.home()
            self.move()

    def race(self):
        """Runs motors of equal speed against each other's limits, so that they are due in the same tick."""
        labels = [self.label() for _ in range(self.chance.randint(2, 3))]
        speed = self.chance.randint(40, 255)
        self.send("".join(f"{label}{speed}S" for label in labels), 0)
        for _ in range(self.chance.randint(1, 5)):
            self.send("".join(f"{label}{self.chance.choice('+-')}{self.chance.randint(60, 127)}\r" for label in labels),
                      self.chance.choice([300, 700]))
        self.ask()

    def wrap(self):
        label, sign = self.label(), self.chance.choice("+-")
        for _ in range(self.chance.randint(2, 4)):
            self.send(f"{label}{sign}{self.chance.randint(50, 128)}\r", self.chance.choice([0, 0, 10, 100]))
        self.send(label + "?T")

    def stop(self):
        label = self.label()
        self.send(label + self.chance.choice(["X", "X", "+50X", "X?", "SX", "5 SX", "+5S", "X+3\r"]))
        self.send(label + "?T")

    def set_speed(self):
        label = self.label()
        self.send(label + self.chance.choice([str(self.chance.randint(1, 255)), self.number()]) + "S")
        self.send(f"{label}{self.sign()}{self.chance.randint(1, 60)}\r")

    def ask(self):
        for _ in range(self.chance.randint(1, 4)):
            self.send(self.inquiry(self.label()))

    def number_form(self):
        label = self.label()
        self.send(label + self.chance.choice(AFTER_A_LABEL), self.chance.choice([0, 9, 30]))
        self.send(self.chance.choice(["?T", "?", label + "?T"]))

    def command(self):
        self.send("".join(self.chance.choices(COMMANDS, k=self.chance.randint(1, 3))))

    def junk(self):
        if self.chance.random() < 0.7:
            data = bytes(self.chance.choices(ALPHABET, k=self.chance.randint(1, 20)))
        else:
            data = bytes(self.chance.choices(range(255), k=self.chance.randint(1, 12)))
        self.send(data)

    def almost(self):
        """A valid sequence with a byte missing, doubled, changed or added."""
        data = bytearray(f"{self.label()}{self.sign()}{self.number()}{self.chance.choice(ENDS)}"
                         f"{self.inquiry(self.label())}{self.chance.choice(COMMANDS)}".encode())
        place = self.chance.randrange(len(data))
        others = self.chance.choices(ALPHABET, k=self.chance.randint(0, 2))
        data[place:place + self.chance.randint(0, 1)] = bytes(others)
        self.send(bytes(data))

    def disable(self):
        if self.chance.random() < 0.5:
            self.send(self.chance.choice([self.label(), f"{self.label()}-3", "A*1", "P", f"{self.label()}+"]), 0)
        self.send("A@")
        self.chance.choice([self.move, self.ask, self.command, self.almost, self.wait])()
        self.send(self.chance.choice(["A@", "a@", "AA@", "\rA@", "A @", "@A@ "]))

    def home(self):
        if self.chance.random() < 0.3:
            self.steps.append(("home",))
        else:
            self.send("A$")

    def reset(self):
        self.steps.append(("reset",))

    def hang_up(self):
        """A line closes, perhaps with an unfinished command, and opens again."""
        if self.chance.random() < 0.5:
            self.send(f"{self.label()}{self.chance.choice(['+', '5', '-30'])}")
        self.steps.append(("close", self.chance.randrange(self.lines)))

    def input(self):
        self.steps.append(("input", self.chance.randint(1, 8), self.chance.random() < 0.6))
        self.send(self.chance.choice("JK"))

    def telnet(self):
        data = self.chance.choice(TELNET)
        if self.chance.random() < 0.5:
            controls = [b"\xff\xfa\x2c\x05%c\xff\xf0" % self.chance.randint(0, 20)]
            data = b"".join(self.chance.choices(COM_PORT + controls, k=3))
        self.send(data if self.chance.random() < 0.5 else data + f"{self.label()}-1\rT?".encode())
        self.send(self.label() + self.chance.choice(["X-1 T", "T"]))

    def wait(self):
        self.send("", self.chance.choice([0, 1, 500, 1500, 3000]))

    def write(self, sequences):
        """A program of that many sequences, with an inquiry about everything at its end."""
        kinds = {self.move: 5, self.drive: 3, self.reach: 2, self.several: 4, self.race: 1.5, self.wrap: 2,
                 self.stop: 2, self.set_speed: 2, self.number_form: 2.5, self.ask: 3, self.command: 3, self.junk: 2,
                 self.almost: 2, self.disable: 0.5, self.home: 0.4, self.input: 0.5, self.reset: 0.15,
                 self.hang_up: 0.3, self.wait: 1, self.telnet: 3 if self.has_telnet else 0}
        for kind in self.chance.choices(list(kinds), list(kinds.values()), k=sequences):
            kind()
        self.send("A?B?C?D?E?F?G?IJK", self.chance.choice([0, 0, 3000]))
        return self.steps


def write_program(seed, labels):
    """The program of this seed, the same on every machine."""
    author = Author(seed, labels)
    return author.write(author.chance.randint(4, 24))
