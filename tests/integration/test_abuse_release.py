"""A short form of `./test --abuse`: some attacks, and three rounds of each at most. Also the verdicts of that command."""
# labels: release serial

import contextlib
import io
import os
import sys
import unittest

from support import ROOT

sys.path.insert(0, os.path.join(ROOT, "tests", "abuse"))

import abuse  # noqa: E402 (needs the folder above)
import catalogue  # noqa: E402
from attack import Attack, Measured  # noqa: E402

NAMES = ("lines.images", "lines.images-unread", "lines.rows", "lines.moves", "lines.inquiries", "lines.garbage",
         "lines.trickle-inquiries", "lines.storm", "lines.stepped", "lines.steps-crowd", "lines.many-steps-pings",
         "pty.moves", "device.moves", "http.state", "http.slowloris", "json.pings", "json.churn", "json.wrong-tokens",
         "websocket.fragments", "memory.lines", "memory.json-images", "memory.websocket-unfinished",
         "memory.followers", "memory.pty-images", "memory.device-moves", "pty.unread-images", "full.cpu",
         "full.health-checks", "crowd.silent", "log.warnings-fast", "log.strangers", "log.pty-cooked",
         "log.device-unasked")
ROUNDS = 3


class Short(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        abuse.prepare()

    def test_attacks(self):
        for name in NAMES:
            with self.subTest(name):
                attack = catalogue.find(name)
                found = abuse.measured(attack, min(attack.rounds, ROUNDS))
                self.assertLessEqual(found.value, attack.bound, found.note)


class Verdicts(unittest.TestCase):
    def verdict(self, *values, bound=10):
        """Whether the report of an attack with these values, one a round, says that the bound is kept."""
        measurements = iter(values)

        def measure():
            value = next(measurements)
            if value is None:
                raise AssertionError("the server is gone\nand its log")
            return Measured(value, "note")

        class Rounds(Attack):
            rounds = len(values)

        with contextlib.redirect_stdout(io.StringIO()) as printed:
            is_kept = abuse.report(Rounds("name", bound, "ms", measure))
        self.assertIn(" ok " if is_kept else " FAILED ", printed.getvalue())
        return is_kept

    def test_the_median_round_counts(self):
        self.assertTrue(self.verdict(1, 11, 10))
        self.assertFalse(self.verdict(1, 11, 10.5))
        self.assertFalse(self.verdict(11))

    def test_a_round_that_fails_breaks_the_bound(self):
        self.assertFalse(self.verdict(1, 1, None))

    def test_names_are_unique(self):
        names = [attack.name for attack in catalogue.ATTACKS]
        self.assertEqual(sorted(set(names)), sorted(names))


if __name__ == "__main__":
    unittest.main()
