"""Runs what deploy/kubernetes describes, with the image of this checkout, by `podman kube play`. played.py tells what
is replaced, because podman does not know it."""

import contextlib
import json
import os
import pathlib
import re
import socket
import unittest

from containers import IMAGE, USER, docker, inspect
from manifests import DEPARTMENTS, TOKEN, objects_of
from played import Played
from test_reach import get
from xr3 import MonitorError

MOST_SHUTDOWN_S = 2.0
CLASS = "xr3-class-pod-0"
ROBOTS = ("Rhino XR-3", "Adept One", "Intelledex 660")


def play(name):
    return Played(objects_of(name), f"localhost/{IMAGE}:latest")


@unittest.skipUnless("XR3_ENGINE" in os.environ, "docker does not play manifests")
class Play(unittest.TestCase):
    """Plays a folder of deploy/kubernetes once for all tests of a class."""

    folder = None

    @classmethod
    def setUpClass(cls):
        if cls is Play:
            raise unittest.SkipTest("has no folder")
        cls.played = play(cls.folder).__enter__()
        cls.addClassCleanup(cls.played.__exit__)

    def line(self, pod):
        """A new connection to the robot port."""
        return socket.create_connection(("127.0.0.1", self.played.ports[pod]["robot"]), timeout=20)

    @contextlib.contextmanager
    def student(self, pod):
        """The name of the cell of a student who has just connected."""
        before = self.cells(pod)
        with self.line(pod) as line:
            line.sendall(b"E?")
            self.assertEqual(b" ", line.recv(1))
            cell, = self.cells(pod) - before
            yield cell

    def cells(self, pod):
        with self.played.monitor(pod) as monitor:
            return set(monitor.hello["cells"])

    def check_refused(self, pod, token=None, **options):
        with self.played.monitor(pod, **options) as monitor, self.assertRaises(MonitorError) as refused:
            if token:
                monitor.request("auth", token=token)
            monitor.call("pause")
        return refused.exception.code

    def check_steers(self, pod, token, **options):
        with self.played.monitor(pod, token, **options) as monitor:
            monitor.call("pause")
            monitor.call("resume")


class OneClass(Play):
    folder = "class"

    def test_every_probe_succeeds(self):
        for kind in "startupProbe", "readinessProbe", "livenessProbe":
            with self.subTest(kind):
                self.assertTrue(self.played.probe(CLASS, kind))

    def test_liveness_is_asked_for_by_address(self):
        """The kubelet's Host is the IP address of the pod; browsers may use the name of the Service."""
        page = f"http://127.0.0.1:{self.played.ports[CLASS]['monitor']}"
        for host, code in (("10.42.0.17:9601", 200), ("[fd00::17]:9601", 200), ("xr3-class-monitor:9601", 200),
                           ("xr3-class-monitor.lab.svc.cluster.local:9601", 403)):
            with self.subTest(host):
                self.assertEqual(code, get(page + "/healthz", host)[0])

    def test_each_connection_has_a_robot_of_its_own(self):
        with self.line(CLASS) as one, self.line(CLASS) as other:
            one.sendall(b"E+90\rE?")
            other.sendall(b"E?")
            self.assertEqual((b"z", b" "), (one.recv(1), other.recv(1)))

    def test_a_probe_makes_no_robot(self):
        before = self.cells(CLASS)
        self.assertTrue(self.played.probe(CLASS, "readinessProbe"))
        self.assertLessEqual(self.cells(CLASS), before)

    def test_calls_need_the_token(self):
        with self.student(CLASS) as cell:
            self.assertEqual("token_required", self.check_refused(CLASS, cell=cell))
            self.check_steers(CLASS, TOKEN, cell=cell)

    def test_has_no_privileges(self):
        process = pathlib.Path("/proc", str(self.played.process(CLASS)))
        status = dict(re.findall(r"^(\w+):\s*(.*)$", (process / "status").read_text(encoding="ascii"), re.M))
        self.assertEqual("xr3", status["Name"])
        self.assertEqual([USER] * 4, status["Uid"].split())
        self.assertEqual([USER] * 4, status["Gid"].split())
        for capabilities in ("CapInh", "CapPrm", "CapEff", "CapBnd", "CapAmb"):
            self.assertEqual(0, int(status[capabilities], 16), capabilities)
        self.assertEqual("1", status["NoNewPrivs"])
        self.assertRegex((process / "mounts").read_text(encoding="ascii"), r"(?m)^\S+ / \S+ ro,")

    def test_is_limited(self):
        limits = inspect(self.played.container(CLASS), ".HostConfig")
        self.assertEqual(1 << 30, limits["Memory"])
        self.assertEqual(2 * limits["CpuPeriod"], limits["CpuQuota"])


class Recordings(unittest.TestCase):
    @unittest.skipUnless("XR3_ENGINE" in os.environ, "docker does not play manifests")
    def test_stay_when_a_pod_goes_and_bring_the_robot_back(self):
        """The command of README.md, in a pod that has started anew, repeats what the first one recorded."""
        with play("class") as played:
            self.talk(played)
            played.stop(CLASS)
            first, = self.runs(played)
            docker("start", played.container(CLASS))
            played.wait_started(CLASS)
            self.talk(played)
            self.assertEqual(first, self.runs(played)[0])
            self.assertEqual(2, len(set(self.runs(played))))
            done = docker("exec", played.container(CLASS), "/usr/bin/xr3", "replay", f"{first}/c1.xr3rec",
                          "--print", "state")
            self.assertIn("everything is as recorded", done.stderr)
            count, = (joint["count"] for joint in json.loads(done.stdout)["joints"] if joint["label"] == "E")
            self.assertNotEqual(0, count)

    @staticmethod
    def talk(played):
        """One line, which moves its robot until a count has passed."""
        with socket.create_connection(("127.0.0.1", played.ports[CLASS]["robot"]), timeout=20) as line:
            line.sendall(b"E+30\r")
            asked = b""
            while asked in (b"", b">"):  # 30 counts to go
                line.sendall(b"E?")
                asked = line.recv(1)

    @staticmethod
    def runs(played):
        """The folders of the recordings, by the log of all starts."""
        return re.findall(r"the cells are recorded in (\S+)", played.log(CLASS))


class Stop(unittest.TestCase):
    @unittest.skipUnless("XR3_ENGINE" in os.environ, "docker does not play manifests")
    def test_a_pod_ends_in_time(self):
        with play("class") as played, played.monitor(CLASS) as monitor:
            code, took_s = played.stop(CLASS)
            bye = monitor.read()
        print(f"\nthe server stops in {took_s:.2f} s; it has {played.grace_s} s")
        self.assertEqual((0, "bye", "shutdown"), (code, bye["op"], bye["why"]))
        self.assertLess(took_s, MOST_SHUTDOWN_S)


class Departments(Play):
    folder = "departments"
    pods = [f"xr3-{i}" for i in range(len(DEPARTMENTS))]

    def test_each_has_its_robots(self):
        for pod, department, robot in zip(self.pods, DEPARTMENTS, ROBOTS):
            with self.subTest(pod), self.student(pod) as cell, \
                    self.played.monitor(pod, f"{TOKEN}: {department}") as monitor:
                cells = monitor.request("call", fn="cells", args={})["value"]["cells"]
                self.assertEqual({cell: robot}, {one["name"]: one["robot"] for one in cells if one["lines"] > 0})

    def test_each_has_its_token(self):
        for pod, department in zip(self.pods, DEPARTMENTS):
            with self.subTest(pod), self.student(pod) as cell:
                self.check_steers(pod, f"{TOKEN}: {department}", cell=cell)
                self.assertEqual("token_required", self.check_refused(pod, cell=cell))
                for other in set(DEPARTMENTS) - {department}:
                    self.assertEqual("bad_token", self.check_refused(pod, f"{TOKEN}: {other}", cell=cell))

    def test_every_probe_succeeds(self):
        for pod in self.pods:
            for kind in "startupProbe", "readinessProbe", "livenessProbe":
                with self.subTest(f"{kind} of {pod}"):
                    self.assertTrue(self.played.probe(pod, kind))


if __name__ == "__main__":
    unittest.main()
