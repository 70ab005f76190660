"""The pytest plugin of the Python package: its fixtures, mark and options, and what a failed test shows. Each test
is a run of pytest by pytester."""
# labels: full serial

import os
import pathlib
import re
import statistics
import sys

import pytest

from support import ROOT, XR3, run_xr3

CLIENT = str(pathlib.Path(ROOT, "clients", "python"))
MOST_MS = 250  # the cost of a test with a robot beside its own commands
MOVES = "robot.move('E', 20); robot.wait('E')"


@pytest.fixture
def run(pytester, monkeypatch):
    """Runs pytest on this file of tests, with these arguments; returns the result."""
    monkeypatch.setenv("PYTHONPATH", CLIENT, prepend=os.pathsep)
    monkeypatch.setenv("XR3", XR3)

    def run_tests(text, *arguments):
        pytester.makepyfile(text)
        return pytester.runpytest_subprocess("-p", "xr3.pytest_plugin", "-p", "no:cacheprovider", "--strict-markers", *arguments,
                                             timeout=120)

    return run_tests


def recordings(folder):
    return sorted(folder.rglob("*.xr3rec"))


def test_each_test_has_a_fresh_robot(run):
    done = run(f"""
        def test_moves(robot, monitor):
            {MOVES}
            assert monitor.counts()["E"] == 20
            monitor.call("block_remove", name="red")
            monitor.call("pause")
        def test_is_fresh(robot, monitor):
            assert monitor.counts()["E"] == 0
            monitor.block("red")
            {MOVES}
    """)
    done.assert_outcomes(passed=2)


def test_programs_find_the_robot_by_variables(run, pytester):
    pytester.makepyfile(program=f"import xr3\nwith xr3.Robot() as robot:\n    {MOVES}\nprint(xr3.Monitor().counts()['E'])")
    done = run("""
        import os, subprocess, sys
        import pytest
        def test_program(xr3_server):
            assert subprocess.check_output([sys.executable, "program.py"]) == b"20\\n"
            assert os.environ["XR3_POLL_MS"] == "0" and "XR3_PTY" not in os.environ
        @pytest.mark.xr3(clock="real:9", pty=True)
        def test_options(xr3_server):
            assert os.environ["XR3_PTY"] == xr3_server.pty and os.path.exists(xr3_server.pty)
            assert "XR3_POLL_MS" not in os.environ
        def test_afterwards():
            assert not {"XR3_HOST", "XR3_PORT", "XR3_MONITOR_PORT", "XR3_PTY", "XR3_POLL_MS"} & set(os.environ)
    """)
    done.assert_outcomes(passed=3)


def test_marks_choose_the_robot(run):
    scara = pathlib.Path(ROOT, "data", "robots", "adept-one.json")
    done = run(f"""
        import pytest, xr3
        pytestmark = pytest.mark.xr3(robot="intelledex-660", clock="manual")
        def test_of_the_module(robot, monitor):
            assert robot.arm.labels == xr3.INTELLEDEX_660.labels
            assert monitor.hello["clock"]["mode"] == "manual"
        @pytest.mark.xr3(robot={str(scara)!r}, workcell="none", compat="mark3", clock="bytes")
        def test_a_file(robot, monitor):
            assert robot.arm == xr3.Arm.load({str(scara)!r})
            assert monitor.hello["compat"] == "mark3" and not monitor.state("blocks")["blocks"]
    """)
    done.assert_outcomes(passed=2)


def test_a_wrong_mark_names_what_is_allowed(run):
    done = run("""
        import pytest
        @pytest.mark.xr3(robt="adept-one")
        def test_keyword(robot): pass
        @pytest.mark.xr3("adept-one")
        def test_position(robot): pass
        @pytest.mark.xr3(robot="r2d2")
        def test_value(robot): pass
    """)
    done.assert_outcomes(errors=3)
    done.stdout.fnmatch_lines_random(["*UsageError: *::test_keyword: the mark xr3 takes robot=, workcell=, *; not robt=",
                                      "*UsageError: *::test_position: *; not 'adept-one'",
                                      "*xr3 does not start: *there is no robot named r2d2; use one of: adept-one,*"])


def test_a_failed_test_shows_the_last_exchanges_and_keeps_its_recording(run, pytester):
    done = run(f"""
        def test_fails(robot):
            {MOVES}
            assert False
        def test_succeeds(robot):
            {MOVES}
    """, f"--basetemp={pytester.path / 'temp'}")
    done.assert_outcomes(failed=1, passed=1)
    done.stdout.fnmatch_lines(["*xr3: the last exchanges*", "*line 1  E+20?r  * move E +20, counter 20",
                               "*line 1  E[?] 8 times * asks how far E has still to go: E: 18 counts to go … E: 0 counts to go",
                               "*xr3: the recording*", "xr3 replay *test_fails-*.xr3rec"])
    kept = re.search(r"^xr3 replay (.+)$", done.stdout.str(), re.MULTILINE)[1]
    assert [pathlib.Path(kept)] == recordings(pytester.path)
    assert run_xr3("replay", kept).returncode == 0


def test_a_server_that_has_ended_is_no_trouble(run):
    done = run("""
        def test_fails(xr3_server):
            xr3_server.close()
            assert False
    """)
    done.assert_outcomes(failed=1)
    done.stdout.fnmatch_lines(["the server has ended: *"])


def test_keep_keeps_all_recordings_with_xdist(run, pytester):
    tests = f"""
        import pytest
        @pytest.mark.parametrize("n", ["a b", "a/b", "ä", *range(5)])
        def test_moves(robot, n): {MOVES}
    """
    for _ in range(2):  # the second run replaces the recordings of the first
        run(tests, "-n", "2", "--xr3-keep", "kept").assert_outcomes(passed=8)
        assert len(recordings(pytester.path / "kept")) == 8


def test_the_program(run):
    done = run("def test_it(robot): pass", "--xr3-program", "/absent/xr3")
    done.assert_outcomes(errors=1)
    done.stdout.fnmatch_lines(["*/absent/xr3 cannot be started: No such file or directory"])


def test_a_test_without_a_robot_starts_none(run):
    run("def test_it(): pass", "--xr3-program", "/absent/xr3").assert_outcomes(passed=1)


def test_the_cost_of_a_robot(run, capfd):
    done = run("""
        import pytest
        @pytest.mark.parametrize("n", range(50))
        def test_it(robot, n): pass
    """, "--durations=0", "-vv")
    done.assert_outcomes(passed=50)
    times = re.findall(r"^([\d.]+)s (?:setup|call|teardown) +\S+(\[\d+\])$", done.stdout.str(), re.MULTILINE)
    by_test = {}
    for seconds, test in times:
        by_test[test] = by_test.get(test, 0) + 1000 * float(seconds)
    assert len(by_test) == 50
    median = statistics.median(by_test.values())
    with capfd.disabled():
        print(f"\na test with a robot costs {median:.0f} ms, the median of {len(by_test)}")
    assert median < MOST_MS


if __name__ == "__main__":
    os.environ.pop("PYTEST_ADDOPTS", None)
    sys.dont_write_bytecode = True
    sys.exit(pytest.main([__file__, "-p", "pytester", "-p", "no:cacheprovider", *sys.argv[1:]]))
