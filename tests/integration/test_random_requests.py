"""Some thousand random valid and invalid requests (random_requests.py). `./test --soak` sends more."""

import unittest

from random_requests import ask


class RandomRequests(unittest.TestCase):
    def test_with_a_manual_clock(self):
        for seed in range(6):
            with self.subTest(seed=seed):
                ask(self, seed, 500)

    def test_with_a_real_clock(self):
        for seed in range(100, 103):
            with self.subTest(seed=seed):
                ask(self, seed, 500, clock="real:50")

    def test_with_the_byte_clock(self):
        for seed in range(150, 153):
            with self.subTest(seed=seed):
                ask(self, seed, 500, clock="bytes")

    def test_other_robots(self):
        for seed, options in ((200, ("--robot", "adept-one")),
                              (201, ("--robot", "intelledex-660", "--compat", "mark3")),
                              (202, ("--robot", "rhino-xr3-accessories"))):
            with self.subTest(seed=seed):
                ask(self, seed, 300, *options)


if __name__ == "__main__":
    unittest.main()
