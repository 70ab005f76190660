"""Robot and Monitor with a real server at a high clock rate: bytes, waiting, home, pick and
place."""

import contextlib
import dataclasses
import io
import math
import os
import random
import re
import socket
import sys
import threading
import time
import unittest
import warnings
from unittest import mock

import xr3
from context import Server
from xr3 import ARMS, RHINO_XR3, Monitor, MonitorError, Pose, Robot, RobotError, Switch, Unreachable

FAST = ("--clock", "real:500")
MARK_III = r"[A-F]([-+]\d+\r|\?|X)|I|J"  # moves, questions, stops, and both inquiries of switches
PICKS = {"rhino-xr3": ("red", Pose(262, 0, 20, 90), Pose(400, 0, 20, 0)),
         "adept-one": ("red", Pose(560, 0, 520, 90), Pose(700, 0, 520, 0)),
         "intelledex-660": ("red", Pose(400, 0, 20, 0), Pose(540, 0, 20, 90))}
# The range of the random starts of Home.
POSTURES = {"F": (-700, 700), "E": (-440, 881), "D": (-900, 1200), "C": (-300, 300),
            "B": (-300, 300), "A": (-16, 64)}
TURN = 1152  # counts of B of the Rhino in a turn


def stands(counts):
    """Whether the Rhino can be there."""
    return RHINO_XR3.allows(counts) and not RHINO_XR3.is_protected(counts)


def pause():
    """The pause between two questions: 1 ms is half a second of simulated time."""
    time.sleep(0.001)


class WithServer(unittest.TestCase):
    options = FAST

    def setUp(self):
        self.server = self.enterContext(Server(*self.options))
        self.robot = self.enterContext(Robot(port=self.server.robot_port, pause=pause))
        self.monitor = self.enterContext(Monitor(port=self.server.monitor_port))


class OneJoint(WithServer):
    def test_moves_and_waits(self):
        self.robot.move("E", 50)
        self.assertEqual(0, self.robot.wait("E"))
        self.assertEqual(50, self.monitor.counts()["E"])

    def test_a_joint_at_its_limit_is_stopped(self):
        self.robot.move("A", -40)  # the jaws are fully open at -16
        self.assertEqual(24, self.robot.wait("A"))
        self.assertEqual(0, self.robot.to_go("A"))

    def test_the_slowest_speed_is_no_standing(self):
        self.robot.set_speed("E", 1)
        self.robot.move("E", 3)
        self.assertEqual(0, self.robot.wait("E"))

    def test_refuses_what_the_robot_would_not_obey(self):
        with self.assertRaisesRegex(ValueError, "127"):
            self.robot.move("E", 128)
        with self.assertRaisesRegex(ValueError, "255"):
            self.robot.set_speed("E", 0)
        self.assertEqual(0, self.robot.to_go("E"))

    def test_speed(self):
        self.robot.set_speed("E", 77)
        self.robot.to_go("E")
        speeds = {joint["label"]: joint["speed"] for joint in self.monitor.state()["joints"]}
        self.assertEqual(77, speeds["E"])

    def test_switch(self):
        for label, closes in RHINO_XR3.switches.items():
            self.assertFalse(self.robot.switch(label), label)
            self.robot.go({label: closes})
            self.assertTrue(self.robot.switch(label), label)

    def test_more_than_95_to_go(self):
        self.monitor.call("pause")
        self.robot.move("E", 127)
        self.assertEqual(127, self.robot.to_go("E"))


class OneJointOfAMark3(OneJoint):
    options = (*FAST, "--compat", "mark3")

    def test_switch(self):
        self.assertTrue(self.robot.switch("E"))
        self.robot.go({"E": -40})
        self.assertFalse(self.robot.switch("E"))


class StandingTime(WithServer):
    options = ("--clock", "manual")

    def test_error_with_its_sign(self):
        self.robot.move("E", -50)
        self.assertEqual((50, -50), (self.robot.to_go("E"), self.robot.error("E")))
        self.monitor.step(100)  # 110 counts per second
        self.assertEqual(-39, self.robot.error("E"))
        self.assertFalse(self.monitor.settle()["moving"])
        self.assertEqual(-50, self.monitor.counts()["E"])


class Inquiries(WithServer):
    def test_a_text_without_an_inquiry_is_not_sent(self):
        for text in ("E", "E+50\r", "EX", "A$", "", "e"):
            with self.subTest(text), self.assertRaisesRegex(
                    ValueError, re.escape(f"{text!r} is no inquiry, so that the robot does not answer: ask 'E?'")):
                self.robot.ask(text)
        self.assertEqual(0, self.monitor.counts()["E"])

    def test_every_inquiry(self):
        for text in ("E?", "e?", "ET", "EV", "I", "AI", "J", "K", "A*0,0*", "E+5\rE?", "E?\r"):
            with self.subTest(text):
                self.robot.ask(text)

    def test_a_robot_that_has_answered_is_no_monitor_port(self):
        robot = self.enterContext(Robot(port=self.server.robot_port, timeout_s=0.2))
        robot.ask("I")
        robot.send("A@")
        with self.assertRaisesRegex(TimeoutError, "within 0.2 s: is it disabled .A@., or does it "
                                                  "not know the inquiry"):
            robot.ask("E?")


class AllJoints(WithServer):
    def test_goes_far_in_parts_and_comes_back(self):
        target = {"F": 71, "E": 543, "D": -479, "C": 0, "B": 260}
        self.robot.go(target)
        self.assertEqual({**target, "A": 0}, self.monitor.counts())
        self.robot.go(dict.fromkeys(target, 0))
        self.assertEqual({0}, set(self.monitor.counts().values()))

    def test_knows_where_it_stands_after_it_could_not_go_on(self):
        with self.assertRaisesRegex(RobotError, "A stopped .* short"):
            self.robot.go({"A": -50})
        self.assertEqual(self.robot.at, self.monitor.counts())

    def test_says_how_far_it_came_and_what_it_may_be(self):
        self.robot.soft_home()
        self.robot.at["E"] = -400  # wrong on purpose: the joint will reach its limit
        short = "E stopped at 481, 319 counts short of 800.*stalled"
        with self.assertRaisesRegex(RobotError, short):
            self.robot.go({"E": 800})

    def test_refuses_counts_past_a_limit(self):
        with self.assertRaisesRegex(Unreachable, "joint E would be .* 2000 .* from -440 to 881"):
            self.robot.go({"E": 2000})
        self.assertEqual(0, self.monitor.counts()["E"])

    def test_refuses_a_label_that_is_no_joint(self):
        for label in ("Z", "e", "", "FE", 5):
            with self.subTest(label), self.assertRaisesRegex(
                    ValueError, f"no joint {label!r}: rhino-xr3 has the joints F, E, D, C, B, A, "
                                r".*Robot\(arm=xr3"):
                self.robot.go({"E": 50, label: 5})
        self.assertEqual(0, self.monitor.counts()["E"])  # nothing has moved
        for use in (self.robot.to_go, self.robot.error, self.robot.switch, self.robot.stop,
                    lambda label: self.robot.move(label, 1),
                    lambda label: self.robot.set_speed(label, 50)):
            with self.assertRaisesRegex(ValueError, "no joint 'Z'"):
                use("Z")

    def test_refuses_counts_that_are_not_whole(self):
        for counts in (5.5, "5", None):
            with self.subTest(counts), self.assertRaisesRegex(
                    ValueError, f"joint E: counts are whole numbers, not {counts!r}"):
                self.robot.go({"E": counts})

    def test_refuses_arguments_of_another_type(self):
        for use, why in (
                (lambda: self.robot.go_to((262, 0, 20)), r"pose, such as xr3.Pose\(.*not \(262, 0, 20\)"),
                (lambda: self.robot.pick((262, 0, 20)), "pose, such as"),
                (lambda: self.robot.place({"E": 5}), "pose, such as"),
                (lambda: RHINO_XR3.solve([262, 0, 20]), "pose, such as"),
                (lambda: Pose("262", 0, 20), "x, y, z and yaw of a pose are numbers, not '262'"),
                (lambda: Pose(262, 0, math.nan), "numbers, not nan"),
                (lambda: self.robot.go([50]), r"counts, such as {'E': 50}, .*not \[50\]"),
                (lambda: RHINO_XR3.tip([50]), "counts, such as"),
                (lambda: self.robot.wait(["E", "D"]), r"no joint \['E', 'D'\]"),
                (lambda: self.robot.send(b"E+50\r"), "text, such as .*not b'E"),
                (lambda: self.robot.ask(5), "text, such as"),
                (lambda: Robot(port=self.server.robot_port, arm="adept-one"),
                 "arm, such as xr3.ADEPT_ONE, .*not 'adept-one'"),
                (lambda: Robot(port=self.server.robot_port, camera=5), "camera, such as")):
            with self.subTest(why), self.assertRaisesRegex(ValueError, why):
                use()
        self.assertEqual({0}, set(self.monitor.counts().values()))

    def test_nowhere_to_go(self):
        self.robot.go({})
        self.assertEqual({0}, set(self.monitor.counts().values()))

    def test_refuses_the_protected_region(self):
        with self.assertRaisesRegex(Unreachable, "protected region"):
            self.robot.go_to(Pose(95, 0, 300))

    def test_a_line_is_straight_and_is_checked_before_anything_moves(self):
        self.robot.go_to(Pose(262, 0, 120, 90))
        tips = []
        go = self.robot.go

        def note(counts):
            go(counts)
            tips.append(RHINO_XR3.tip(self.robot.at))
        with mock.patch.object(self.robot, "go", note):
            self.robot.line_to(Pose(262, 90, 120, 60), step_mm=10.5)
        self.assertEqual(9, len(tips))
        for number, (x, y, z) in enumerate(tips, 1):
            self.assertLess(math.dist((x, y, z), (262, 10 * number, 120)), 1.0, tips)
        self.assertAlmostEqual(60, RHINO_XR3.yaw(self.robot.at), delta=0.5)
        before = self.monitor.counts()
        with self.assertRaisesRegex(Unreachable, "protected region"):
            self.robot.line_to(Pose(60, 0, 120))
        for step in (0, -1, math.nan):
            with self.assertRaisesRegex(ValueError, "above 0"):
                self.robot.line_to(Pose(262, 0, 120), step)
        self.assertEqual(before, self.monitor.counts())

    def test_a_line_begins_with_the_hand_down(self):
        self.robot.go({"C": 100})
        with self.assertRaisesRegex(Unreachable, "straight down"):
            self.robot.line_to(Pose(262, 0, 120))

    def test_warns_of_a_pose_below_the_table(self):
        with self.assertWarnsRegex(UserWarning, "20 mm below the table"):
            self.robot.go_to(Pose(262, 0, -20, 90))
        self.robot.table_mm = -30
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.robot.go_to(Pose(262, 0, -25, 90))

    def test_refuses_a_place_out_of_reach(self):
        with self.assertRaises(Unreachable):
            self.robot.pick(Pose(900, 0, 20))
        self.assertEqual({0}, set(self.monitor.counts().values()))


class Home(WithServer):
    starts = (
        {},
        {"F": 50, "E": 30, "D": -40, "C": -30, "B": 20, "A": 20},
        {"F": 30, "E": -40, "D": 40, "C": 40, "B": -25, "A": -16},  # each at its edge
        {"F": 60, "E": -70, "D": 70, "C": 70, "B": -60, "A": 64},  # each on its switch
        {"F": 200, "E": -200, "D": 200, "C": -200, "B": -200, "A": -15},  # beyond it
        {"E": -200, "D": 200},  # folded back, above the base
        {"E": -430, "D": 400, "C": 30},  # far back
        {"E": -400, "D": 1000},  # the raised elbow blocks the shoulder
        {"E": -312, "D": 95},  # almost at the base
        {"F": -138, "E": 445, "D": -649, "B": 156},  # at a block
        {"F": 91, "E": -101, "D": 101, "C": 101, "B": -86},  # one count beyond it, in mark3
    )

    def test_from_wherever_it_is(self):
        for start in self.starts:
            self.home_from(start)

    def test_from_random_postures(self):
        numbers = random.Random(4)
        for _ in range(8):
            self.home_from(self.random_posture(numbers))

    def home_from(self, start):
        with self.subTest(start):
            self.robot.soft_home()
            self.robot.go(start)
            self.robot.at = {}
            self.robot.home()
            self.assertEqual(RHINO_XR3.switches, self.robot.at)
            self.assertEqual(self.robot.at, self.counts())
            self.assertIsNone(self.monitor.state()["stalled"])

    def counts(self):
        return self.monitor.counts()

    def random_posture(self, numbers):
        """A posture with the tool roughly down and above the table, to which go() leads."""
        while True:
            start = {label: numbers.randint(low, high) for label, (low, high) in POSTURES.items()}
            way = [{label: count * part // 50 for label, count in start.items()}
                   for part in range(51)]
            if RHINO_XR3.tip(start)[2] > 10 and all(map(stands, way)):
                return start

    def test_pending_moves_are_cancelled(self):
        self.robot.send("A+127\rE+100\r")
        self.robot.home()
        self.assertEqual(RHINO_XR3.switches, self.monitor.counts())

    def test_sends_only_what_a_mark_iii_understands(self):
        sent = []
        send = self.robot.send
        with mock.patch.object(self.robot, "send", lambda text: (sent.append(text), send(text))):
            self.robot.home()
        self.assertEqual([], [text for text in sent if not re.fullmatch(MARK_III, text)])

    def test_a_switch_without_a_bit(self):
        joints = [dataclasses.replace(joint, switch=Switch(joint.switch.edge, 0))
                  for joint in RHINO_XR3.joints]
        self.robot.arm = dataclasses.replace(RHINO_XR3, joints=tuple(joints))
        with self.assertRaisesRegex(RobotError, "switch of joint E is in the reply neither to I nor"):
            self.robot.home()

    def test_soft_home(self):
        self.robot.go({"F": 50, "A": 20})
        self.robot.soft_home()
        self.robot.to_go("F")
        self.assertEqual(self.robot.at, self.monitor.counts())

    def test_a_stall_is_among_what_it_may_be(self):
        with self.assertRaisesRegex(RobotError, "short of .* stalled"):
            self.robot.go({"E": -420})  # bends back into the protected region
        self.assertEqual("protected_region", self.monitor.state()["stalled"])
        with self.assertRaisesRegex(RobotError, "no switch found by A.* stalled"):
            self.robot.home()


class HomeOfAMark3(Home):
    options = (*FAST, "--compat", "mark3")

    def counts(self):
        """B meets its switch once a turn, so it may be whole turns away."""
        counts = super().counts()
        return {**counts, "B": math.remainder(counts["B"], TURN)}


class HomeOfOtherArms(unittest.TestCase):
    def test_in_both_profiles(self):
        for name in "adept-one", "intelledex-660":
            for profile in "paper", "mark3":
                with self.subTest(name, profile=profile), \
                        Server("--robot", name, "--compat", profile, *FAST) as server, \
                        Robot(port=server.robot_port, arm=ARMS[name], pause=pause) as robot, \
                        Monitor(port=server.monitor_port) as monitor:
                    robot.go({label: 50 if label < "C" else -30 for label in robot.arm.homing})
                    robot.at = {}
                    robot.home()
                    self.assertEqual(robot.arm.switches, monitor.counts())


class PickAndPlace(unittest.TestCase):
    options = ()

    def test_with_each_arm(self):
        for name, (block, there, place) in PICKS.items():
            with self.subTest(name), Server("--robot", name, *FAST, *self.options) as server, \
                    Robot(port=server.robot_port, arm=ARMS[name], pause=pause) as robot, \
                    Monitor(port=server.monitor_port) as monitor:
                width = robot.pick(there)
                self.assertTrue(monitor.block(block)["held"])
                robot.place(place)
                self.assertGreater(width, 30)
                self.assertLess(width, 41)
                lies = monitor.block(block)["xyz_mm"]
                self.assertLess(math.dist((place.x, place.y, place.z), lies), 2)

    def test_nothing_to_pick(self):
        with Server(*FAST, *self.options) as server, \
                Robot(port=server.robot_port, pause=pause) as robot:
            self.assertIsNone(robot.pick(Pose(300, 0, 20)))


class PickAndPlaceOfAMark3(PickAndPlace):
    options = ("--compat", "mark3")


class AtTheMonitor(WithServer):
    def test_hello(self):
        self.assertEqual(("hello", 1), (self.monitor.hello["op"], self.monitor.hello["proto"]))

    def test_errors_say_what_is_wrong(self):
        with self.assertRaisesRegex(MonitorError, "clock_running") as caught:
            self.monitor.step(1)
        self.assertEqual("clock_running", caught.exception.code)

    def test_time_can_be_held(self):
        self.monitor.call("pause")
        self.robot.move("E", 20)
        self.robot.to_go("E")
        self.assertEqual(0, self.monitor.counts()["E"])
        self.monitor.settle()
        self.assertEqual(20, self.monitor.counts()["E"])

    def test_recalls_what_happened(self):
        self.assertEqual([], [event for event in self.monitor.recall("event")
                              if event["event"] == "warning"])
        self.robot.send("E+200\r")
        self.robot.to_go("E")
        codes = [event["code"] for event in self.monitor.recall("event")]
        self.assertIn("number_out_of_range", codes)

    def test_silence_does_not_end_the_connection(self):
        self.monitor = self.enterContext(Monitor(port=self.server.monitor_port, timeout_s=0.2))
        self.monitor.sub("event")
        for _ in range(2):
            with self.assertRaisesRegex(TimeoutError, "nothing for 0.2 s"):
                next(self.monitor.messages())
        self.assertEqual(0, self.monitor.counts()["E"])
        self.robot.move("E", 1)
        self.assertEqual("move", next(self.monitor.messages())["event"])

    def test_unknown_block(self):
        with self.assertRaises(KeyError):
            self.monitor.block("purple")


class Token(unittest.TestCase):
    def test_comes_from_the_environment(self):
        with mock.patch.dict(os.environ, XR3_TOKEN="sixteen or more characters"), \
                Server(*FAST) as server:
            with Monitor(port=server.monitor_port) as monitor:
                monitor.call("pause")
            with mock.patch.dict(os.environ, XR3_TOKEN=""), \
                    Monitor(port=server.monitor_port) as monitor, \
                    self.assertRaisesRegex(MonitorError, "token"):
                monitor.call("pause")
        with mock.patch.dict(os.environ, XR3_TOKEN="of another server"), Server(*FAST) as server, \
                Monitor(port=server.monitor_port, token=None):
            pass


class NobodyThere(unittest.TestCase):
    def test_the_server_ends(self):
        with Server(*FAST) as server:
            robot = self.enterContext(Robot(port=server.robot_port))
            monitor = self.enterContext(Monitor(port=server.monitor_port))
        for ask in (lambda: robot.to_go("E"), monitor.counts):
            with self.assertRaises(ConnectionError):
                ask()

    def test_no_server(self):
        with Server(*FAST) as server:
            pass
        for kind, port in ((Robot, server.robot_port), (Monitor, server.monitor_port)):
            with self.assertRaisesRegex(ConnectionError, f"port {port}: is the server running"):
                kind(port=port)

    def test_no_port(self):
        for port in ("abc", "-1", 70000):
            with self.assertRaisesRegex(ValueError, "1 to 65535, not "):
                Robot(port=port)

    def test_the_port_of_connect(self):
        """An argument takes precedence over the command line."""
        with Server(*FAST) as server, mock.patch.object(sys, "argv", ["program", "localhost", "1"]), \
                xr3.connect(port=server.robot_port) as robot:
            self.assertEqual(0, robot.to_go("E"))
        with mock.patch.object(sys, "argv", ["program"]), \
                self.assertRaisesRegex(SystemExit, f"localhost port {server.robot_port}: is the server"):
            xr3.connect(host="localhost", port=server.robot_port)

    def test_empty_variables_count_as_not_set(self):
        with Server(*FAST) as server, \
                mock.patch.dict(os.environ, XR3_HOST="", XR3_PORT=str(server.robot_port)), \
                Robot("", "") as robot:
            self.assertEqual(0, robot.to_go("E"))

    def test_another_server(self):
        with Server(*FAST) as server, Robot(port=server.monitor_port, timeout_s=0.2) as robot, \
                self.assertRaisesRegex(TimeoutError, "is this the monitor port"):
            robot.to_go("E")


class Versions(unittest.TestCase):
    """connect() compares the package with the server where a monitor port answers."""

    def connect(self, server, monitor_port):
        """The text that connect() writes to standard error."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said), mock.patch.object(sys, "argv", ["program"]), \
                mock.patch.dict(os.environ, XR3_MONITOR_PORT=str(monitor_port)), \
                xr3.connect(port=server.robot_port) as robot:
            self.assertEqual(0, robot.to_go("E"))
        return said.getvalue()

    def test_of_the_server(self):
        for options, token in (((), ""), (("--private",), "sixteen or more characters")):
            with mock.patch.dict(os.environ, XR3_TOKEN=token), Server(*options) as server:
                with mock.patch.dict(os.environ, XR3_TOKEN=""):
                    self.assertEqual("", self.connect(server, server.monitor_port))
                    with mock.patch.object(xr3, "__version__", "0.1.0"):
                        self.assertRegex(self.connect(server, server.monitor_port),
                                         r"^xr3: the package has the version 0\.1\.0, and the server at the monitor "
                                         r"port is xr3 \d+\.\d+\.\d+: use the package of its version\n$")

    def test_where_no_monitor_answers(self):
        with Server() as server, mock.patch.object(xr3, "__version__", "0.1.0"):
            for answer in None, b"", b"SSH-2.0\r\n", b"[]\n", b'{"op": "bye"}\n', b'{"server": 5}\n', b"\xff\n":
                with self.subTest(answer), socket.create_server(("127.0.0.1", 0)) as other:
                    other.settimeout(10)
                    port = other.getsockname()[1]
                    answering = threading.Thread(target=self.answer, args=(other, answer))
                    answering.start()
                    self.assertEqual("", self.connect(server, port))
                    answering.join()
            self.assertEqual("", self.connect(server, "none"))
            self.assertEqual("", self.connect(server, 1))

    def answer(self, other, answer):
        """Answers one client; None is silence until the client ends. All that it may send is {."""
        line, _ = other.accept()
        with line:
            if answer is not None:
                line.sendall(answer)
                line.shutdown(socket.SHUT_WR)
            received = b"".join(iter(lambda: line.recv(100), b""))
        self.assertIn(received, (b"", b"{"))


if __name__ == "__main__":
    unittest.main()
