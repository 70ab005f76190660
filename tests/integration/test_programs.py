"""Programs written for the hardware end at the same counts as there: over TCP and on a pseudo-terminal, with the real
binary, with the manual clock, and some with a fast clock."""

import os
import select
import tempfile
import unittest

from programs import LabDriver, LabDriverForPaper, LabProgram, Trs80, write_only
from support import DEADLINE_S, Line, Server, counts, motors


class PtyLine(Line):
    """A line over a pseudo-terminal of the server."""

    def __init__(self, path):
        super().__init__(None, number=1)
        self.file = os.open(path, os.O_RDWR | os.O_NOCTTY)

    def send(self, data):
        self.sent += os.write(self.file, data.encode("ascii"))

    def read(self, count):
        data = b""
        while len(data) < count:
            if not select.select([self.file], [], [], DEADLINE_S)[0]:
                raise TimeoutError(f"no reply after {data!r}")
            data += os.read(self.file, count - len(data))
        return data

    def unread(self):
        return os.read(self.file, 65536) if select.select([self.file], [], [], 0)[0] else b""

    def close(self):
        os.close(self.file)


class Bench:
    """A server with one line and a wait() in simulated milliseconds. `pty`: the path of a pseudo-terminal that is the
    line, in place of a connection."""

    def __init__(self, *options, clock="manual", pty=None):
        if pty:
            options = (*options, "--pty", pty)
        self.pty = pty
        self.server = Server(*options, clock=clock)
        self.is_manual = clock == "manual"

    def __enter__(self):
        self.server.__enter__()
        self.monitor = self.server.monitor()
        self.line = PtyLine(self.pty) if self.pty else self.server.line()
        if self.pty:
            self.server.wait_log("line 1 opened")
        return self

    def __exit__(self, *problem):
        self.line.close()
        self.monitor.close()
        self.server.__exit__(*problem)

    def wait(self, milliseconds):
        if self.is_manual:
            self.monitor.step(milliseconds, after=self.line, fields=["moving"])
            return
        until = self.monitor.get("moving")["tick"] + milliseconds
        while self.monitor.get("moving")["tick"] < until:
            pass

    def settle(self):
        if not self.is_manual:
            self.monitor.call("pause")
        return self.monitor.settle(after=self.line)


MIDDLES = "F60 E-70 D70"  # middles of the ranges in which the switches are closed, 60 counts each


class DriverOf1983(unittest.TestCase):
    def run_it(self, work, **options):
        with Bench("--compat", "mark3", **options) as bench:
            driver = Trs80(bench.line, bench.wait)
            work(driver)
            state = bench.settle()
            self.assertEqual(b"", bench.line.unread())
        return driver, state

    def home_e_d_and_f(self, driver):
        self.assertTrue(driver.home("E", follower="D"))
        self.assertTrue(driver.home("D"))
        self.assertTrue(driver.home("F"))

    def test_moves_every_motor(self):
        moves = {"A": 60, "B": 230, "C": -90, "D": 175, "E": -200, "F": 300}

        def work(driver):
            for label, count in moves.items():
                self.assertTrue(driver.move(label, count), label)

        driver, state = self.run_it(work)
        self.assertEqual("F300 E-200 D175 C-90 B230 A60", counts(state))
        self.assertEqual([], driver.stuck)

    def test_homes_from_the_soft_home(self):
        """F's switch closes above the soft home. The driver moves F down to its limit first, is stuck there, and then moves up."""
        driver, state = self.run_it(self.home_e_d_and_f)
        self.assertEqual(MIDDLES, counts(state))
        self.assertEqual(["F"], driver.stuck)

    def test_homes_from_the_far_side_of_the_switch(self):
        """E and F move down to their limits, are stuck there, and then move up."""
        def work(driver):
            driver.move("E", -150)
            driver.move("D", 150)
            self.home_e_d_and_f(driver)

        driver, state = self.run_it(work)
        self.assertEqual(MIDDLES, counts(state))
        self.assertEqual(["E", "F"], driver.stuck)

    def test_stops_blocked_jaws(self):
        """The jaws are blocked at their limit, 16 counts below the soft home, so the error counter stays."""
        driver, state = self.run_it(lambda driver: self.assertFalse(driver.move("A", -85)))
        self.assertEqual(["A"], driver.stuck)
        jaws = motors(state)["A"]
        self.assertEqual((-16, 0, False), (jaws["count"], jaws["error"], jaws["moving"]))

    def test_homes_while_the_clock_runs(self):
        with Bench("--compat", "mark3", clock="real:10") as bench:
            self.home_e_d_and_f(Trs80(bench.line, bench.wait))
            self.assertEqual(MIDDLES, counts(bench.settle()))


class LabProgramOfEveryWeek(unittest.TestCase):
    def test_steps_and_polls(self):
        for profile in "paper", "mark3":
            with self.subTest(profile), Bench("--compat", profile) as bench:
                program = LabProgram(bench.line, bench.wait)
                program.move("E", 40)
                program.move("F", -26)
                self.assertEqual("F-26 E40", counts(bench.monitor.get()))
                self.assertEqual(33 * 2, program.polls, "two counts take 19 ticks at 110 a second")
                self.assertEqual("F-26 E40", counts(bench.settle()))
                self.assertEqual(b"", bench.line.unread())

    def test_homes_by_the_switches(self):
        """Each joint moves up to the lower edge of the 60 counts in which its switch is closed."""
        with Bench("--compat", "mark3") as bench:
            program = LabProgram(bench.line, bench.wait)
            for label in "DC":
                program.home(label)
            program.move("E", -130)
            program.home("E")
            program.move("F", -20)
            program.home("F")
            self.assertEqual("F30 E-100 D40 C40", counts(bench.settle()))

    def test_with_a_real_clock(self):
        with Bench("--compat", "mark3", clock="real:50") as bench:
            program = LabProgram(bench.line, bench.wait)
            program.move("E", 40)
            program.home("D")
            self.assertEqual("E40 D40", counts(bench.settle()))


class LaboratoryDriver(unittest.TestCase):
    def check(self, bench, driver, roll):
        driver.home()
        state = bench.monitor.get()
        self.assertEqual(f"F40 E-40 D40 C40 B{roll} A14", counts(state), "A was closed, at 64, and opened by 50")
        for label in "FEDCB":
            self.assertTrue(motors(state)[label]["switch"], label)
        for label, count in {"F": -40, "B": -roll, "E": 489, "D": -665, "C": -40}.items():
            self.assertTrue(driver.move(label, count), label)
        self.assertFalse(driver.grip(), "the gripper stalls at the block")
        self.assertTrue(driver.move("E", -207))
        self.assertEqual("red", bench.settle()["tool"]["holding"])
        self.assertFalse(driver.ungrip(), "it stalls fully open, at -16, and backs off by 20")
        state = bench.settle()
        self.assertEqual((None, 4), (state["tool"]["holding"], motors(state)["A"]["count"]))
        self.assertEqual(b"", bench.line.unread())

    def test_over_tcp(self):
        """B meets its switch after most of a turn: from -85 to -25 counts, and once more 1152 counts on."""
        with Bench("--compat", "mark3") as bench:
            self.check(bench, LabDriver(bench.line, bench.wait), roll=1080)

    def test_on_a_pseudo_terminal(self):
        with tempfile.TemporaryDirectory() as folder, \
                Bench("--compat", "mark3", pty=os.path.join(folder, "rhino")) as bench:
            self.check(bench, LabDriver(bench.line, bench.wait), roll=1080)

    def test_in_the_profile_paper(self):
        with Bench("--compat", "paper") as bench:
            self.check(bench, LabDriverForPaper(bench.line, bench.wait), roll=-40)


class WriteOnlyProgram(unittest.TestCase):
    def test_ends_at_the_computed_counts(self):
        for profile in "paper", "mark3":
            with self.subTest(profile), Bench("--compat", profile) as bench:
                write_only(bench.line, bench.wait)
                state = bench.settle()
                self.assertEqual("E-224 D219", counts(state))
                self.assertFalse(state["moving"] or state["stalled"])
                self.assertEqual(b"", bench.line.unread())
            self.assertNotIn("counter_overflow", bench.server.log())

    def test_without_the_pauses_the_counter_wraps(self):
        """Without the pauses, four moves by 50 counts overflow the 8-bit error counter."""
        with Bench() as bench:
            write_only(bench.line, lambda _: None)
            state = bench.settle()
            self.assertEqual("E32 D-37", counts(state))
            bench.server.wait_log("counter_overflow")


if __name__ == "__main__":
    unittest.main()
