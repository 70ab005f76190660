"""Some lockstep runs under full load, which must all have the same hash (lockstep_runs.py). `./test --soak`
makes a thousand."""
# labels: serial full

import concurrent.futures
import unittest

from lockstep_runs import delayed_runs, full_load, runs


class LockstepRuns(unittest.TestCase):
    def test_all_runs_have_the_same_hash(self):
        with full_load(), concurrent.futures.ThreadPoolExecutor() as pool:
            late = [pool.submit(delayed_runs, 1) for _ in range(3)]
            hashes = runs(20)
            for each in late:
                hashes += each.result()
        self.assertEqual((23, 1), (len(hashes), len(set(hashes))))


if __name__ == "__main__":
    unittest.main()
