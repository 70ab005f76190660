"""The server and the model of tests/model agree on some random programs. `./test --soak` compares 2,000."""

import unittest

from second_opinion import PROFILES, SETUPS, Pair, difference, report, setup_of

PROGRAMS_A_PAIR = 8


class SecondOpinion(unittest.TestCase):
    def test_random_programs(self):
        for first in range(len(SETUPS)):
            for profile in PROFILES:
                with self.subTest(setup=first, profile=profile), Pair(profile, setup_of(first)) as pair:
                    self.compare(pair, [first + number * len(SETUPS) for number in range(PROGRAMS_A_PAIR)])

    def compare(self, pair, seeds):
        for seed in seeds:
            program = pair.program(seed)
            message = difference(pair, program)
            self.assertEqual("", message, message and report(pair, seed, program, message))

    def test_a_count_that_is_due_at_a_limit(self):
        """A coupled joint is at its limit when the count is due, and has left it at the end of the tick."""
        program = [("send", 0, b"C236SD236Sb236S", 0), ("send", 0, b"C+110\rD+63\rb+115\r", 300)]
        with Pair("paper", SETUPS[1]) as pair:
            self.assertEqual("", difference(pair, program))

    def test_a_model_with_a_wrong_speed_differs(self):
        with Pair("paper", SETUPS[0]) as pair:
            pair.robot.motors[1].speed += 1
            self.assertIn("the reply to b'E?'", difference(pair, [("send", 0, b"E+50\r", 451), ("send", 0, b"E?", 0)]))


if __name__ == "__main__":
    unittest.main()
