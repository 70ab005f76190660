"""A short form of `./test --abuse`: one round of some attacks. Bounds of counts hold. Bounds of times are ten times as
long, because other programs disturb them, and half a second is measured. Also the verdicts of that command."""
# labels: release serial

import contextlib
import io
import os
import sys
import unittest

from support import ROOT

sys.path.insert(0, os.path.join(ROOT, "tests", "abuse"))

import abuse  # noqa: E402 (needs the folder above)
import attack as attacks  # noqa: E402
import catalogue  # noqa: E402
from attack import Attack, Measured, measure_once  # noqa: E402

TIMED = ("lines.images/shipped", "lines.trickle-inquiries/neighbour", "lines.storm/shipped", "lines.stepped/shipped",
         "lines.steps-crowd/shipped", "lines.many-steps-pings/shipped", "pty.moves", "device.moves",
         "http.state/shipped", "http.slowloris/shipped", "json.churn/shipped", "json.wrong-tokens/shipped",
         "websocket.fragments/shipped")
COUNTED = ("memory.lines/camera", "memory.json-images/camera", "memory.websocket-unfinished/shipped",
           "memory.followers/shipped", "memory.pty-images", "memory.device-moves", "pty.unread-images", "full.cpu",
           "full.health-checks", "crowd.silent", "log.warnings-fast", "log.strangers", "log.pty-cooked",
           "log.device-unasked")
WIDER = 10
MEASURED_S = 0.5


class Short(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        abuse.prepare()
        attacks.MEASURED_S = dict.fromkeys(attacks.MEASURED_S, MEASURED_S)

    def test_timed_attacks(self):
        for name in TIMED:
            with self.subTest(name):
                attack = catalogue.find(name)
                measured = measure_once(attack)
                self.assertLessEqual(measured.least, WIDER * attack.bound, measured.note)

    def test_counted_attacks(self):
        for name in COUNTED:
            with self.subTest(name):
                attack = catalogue.find(name)
                measured = measure_once(attack)
                self.assertLessEqual(measured.value, attack.bound, measured.note)


class Verdicts(unittest.TestCase):
    def verdict(self, *values, bound=10, rounds=None):
        """Whether the report of an attack with these values, one a round, says that the bound is kept. A pair is a
        value beside that of a bystander."""
        measurements = iter(values)

        def measure():
            value = next(measurements)
            if value is None:
                raise AssertionError("the server is gone\nand its log")
            value, bystander = value if isinstance(value, tuple) else (value, 0)
            return Measured(value, "note", bystander=bystander)

        with contextlib.redirect_stdout(io.StringIO()) as printed:
            is_kept = abuse.report(Attack("name", bound, "ms", measure), rounds or len(values))
        self.assertIn(" ok " if is_kept else " FAILED ", printed.getvalue())
        return is_kept

    def test_the_worst_round_counts(self):
        self.assertTrue(self.verdict(1, 10, 2))
        self.assertFalse(self.verdict(1, 10.5, 2))

    def test_a_round_that_fails_breaks_the_bound(self):
        self.assertFalse(self.verdict(1, None))

    def test_a_round_on_a_busy_machine_is_repeated(self):
        self.assertTrue(self.verdict((11, 6), 10, 2, rounds=2))
        self.assertFalse(self.verdict((11, 6), 10, 11, rounds=2))
        self.assertFalse(self.verdict((11, 5), 10, rounds=2))
        self.assertTrue(self.verdict((10, 50), 2, rounds=2))

    def test_a_machine_that_stays_busy_breaks_the_bound(self):
        self.assertFalse(self.verdict(*[(11, 6)] * 20, rounds=2))

    def test_names_are_unique(self):
        names = [attack.name for attack in catalogue.ATTACKS]
        self.assertEqual(sorted(set(names)), sorted(names))


if __name__ == "__main__":
    unittest.main()
