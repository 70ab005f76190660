"""A checkout whose scripts ./run and ./test run without a build: stubs replace packages, build tools and the
programs of the suites, build/release/xr3 is the executable under test, and ctest only lists tests."""

import os
import pathlib
import shutil

from support import ROOT, XR3

# The options of ctest that a page may use. It ignores those that it does not know.
CTEST = """
for word; do
  case $word in -*) ctest=${word%%=*} ;; *) continue ;; esac
  "$REAL_CTEST" --help | grep -qE -- "(^|[ ,])$ctest([ ,=]|$)" || { echo "ctest has no $ctest" >&2; exit 64; }
done
[ "$1" != --preset ] || shift 2
exec "$REAL_CTEST" --test-dir "$TESTS" -N "$@"
"""
PROGRAMS = ("bin/cmake", "bin/git", "bin/node", "bin/shellcheck", "build/release/bench", "build/release/bench_fanout",
            "build/release/bench_inquiries", "build/release/bench_cells", "build/seeds/seeds")


class StubCheckout:
    """Makes the files in an empty folder. `environment` is for processes that run in it."""

    def __init__(self, folder):
        self.folder = folder
        tests = pathlib.Path(ROOT, "tests")
        for path in [*tests.rglob("*.py"), *tests.glob("fuzz/*.cpp")]:
            self._stub(folder / path.relative_to(ROOT), "")
        for path in pathlib.Path(ROOT, "scripts").iterdir():
            self._stub(folder / "scripts" / path.name)
        for name in (*PROGRAMS, *(f"build/fuzz/fuzz_{path.stem}" for path in tests.glob("fuzz/*.cpp"))):
            self._stub(folder / name)
        self._stub(folder / "bin/ctest", CTEST)
        for name in "run", "test":
            shutil.copy(pathlib.Path(ROOT, name), folder)
        # Lists the tests with a log of its own: the ctest that runs this test writes the other one.
        (folder / "CTestTestfile.cmake").write_text(f'subdirs("{pathlib.Path(XR3).parent}")\n', encoding="utf-8")
        (folder / "CMakePresets.json").touch()
        (folder / "build/release/build.ninja").touch()
        (folder / "build/release/xr3").symlink_to(XR3)
        self.environment = {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}",
                            "REAL_CTEST": shutil.which("ctest") or "ctest", "TESTS": str(folder),
                            "XR3_ROBOT_PORT": "0", "XR3_MONITOR_PORT": "0"}

    @staticmethod
    def _stub(path, text="true"):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"#!/bin/sh\n{text}\n" if text else "", encoding="ascii")
        path.chmod(0o755)
