"""Runs tests of the page (tests/web) in real Chromium with Playwright against this xr3."""

import os
import shutil
import subprocess
import unittest

from browser import MISSING
from support import ROOT

WEB = os.path.join(ROOT, "tests", "web")
PLAYWRIGHT = os.path.join(ROOT, "clients", "web", "node_modules", "playwright-core")

# The path is the one that tests/web uses.
needs_chromium = unittest.skipUnless(os.path.exists("/usr/bin/chromium"), MISSING)


def run_page_tests(case, script, pattern=None, passed=None):
    """Runs the tests of a script in tests/web whose names match the pattern. `case` fails unless all of them pass, and
    unless they are `passed` many."""
    case.assertTrue(shutil.which("node"), "node is not installed (scripts/setup test)")
    case.assertTrue(os.path.isdir(PLAYWRIGHT), "run scripts/viewer first: it fetches Playwright")
    options = [f"--test-name-pattern={pattern}"] if pattern else []
    run = subprocess.run(["node", "--test", "--test-concurrency=1", "--test-reporter=spec", *options,
                          os.path.join(WEB, script)],
                         capture_output=True, text=True, timeout=280, check=False, cwd=ROOT)
    print(run.stdout[-6000:] if run.returncode else run.stdout[-1500:])
    case.assertEqual(0, run.returncode, run.stderr[-3000:])
    if passed is not None:
        case.assertIn(f"pass {passed}", run.stdout)
