"""A thousand lockstep runs under full load, and a thousand with delayed bytes, must all have the same hash
(lockstep_runs.py). Many servers run in parallel, because they mostly wait."""

import collections
import concurrent.futures
import sys

from lockstep_runs import delayed_runs, full_load, runs

RUNS = 1000
RUNS_A_SERVER = 25
WORKERS = 40


def soak():
    servers = RUNS // RUNS_A_SERVER
    with full_load(), concurrent.futures.ProcessPoolExecutor(WORKERS) as pool:
        jobs = [pool.submit(kind, RUNS_A_SERVER) for kind in (delayed_runs, runs) for _ in range(servers)]
        hashes = collections.Counter(each for job in jobs for each in job.result())
    print("\n".join(f"{count:6} runs  {digest}" for digest, count in hashes.most_common()))
    return len(hashes) == 1 and hashes.total() == 2 * RUNS


if __name__ == "__main__":
    sys.exit(0 if soak() else 1)
