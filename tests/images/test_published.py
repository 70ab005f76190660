"""Runs every command of docker/README.md, with the names and ports replaced by unique ones, and checks the
Dockerfiles with a linter if npm can fetch it."""

import re
import subprocess
import unittest
import uuid

from containers import LABEL, ROOT, docker, environment_without_xr3
from engine import quiet
from test_compose import free_ports

README = ROOT / "docker" / "README.md"
LINT = ("npm", "exec", "--yes", "dockerfile-utils@0.16.3", "--", "lint")
FENCE = re.compile(r"^```sh\n(.*?)^```", re.DOTALL | re.MULTILINE)
DEADLINE_S = 600


class Readme(unittest.TestCase):
    def test_commands(self):
        ports = dict(zip(("9600", "9601"), map(str, free_ports(2))))
        ours = {name: f"{LABEL}-{uuid.uuid4().hex[:8]}" for name in ("arm", "lab", "try")}
        self.addCleanup(quiet, "docker", "rm", "--force", ours["arm"])
        scripts = FENCE.findall(README.read_text(encoding="utf-8"))
        self.assertEqual(5, len(scripts))
        for script in scripts:
            for port in ports:
                script = script.replace(f"127.0.0.1:{port}:", f"127.0.0.1:{ports[port]}:")
            for name in ours:
                script = re.sub(rf"((?:--name|exec|stop|rm|-f|-p) ){name}\b", rf"\1{ours[name]}",
                                script)
            with self.subTest(script):
                self.run_script(script, ports)

    def run_script(self, script, ports):
        environment = {**environment_without_xr3(), "XR3_ROBOT_PORT": ports["9600"],
                       "XR3_MONITOR_PORT": ports["9601"]}
        done = subprocess.run(["bash", "-euxc", script], cwd=ROOT, env=environment, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=DEADLINE_S,
                              check=False)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)


class Dockerfiles(unittest.TestCase):
    def test_lint(self):
        if not quiet(*LINT[:-1], "version", timeout=120):
            self.skipTest("npm cannot fetch the linter")
        for path in sorted(ROOT.glob("docker/**/Dockerfile")):
            with self.subTest(path):
                done = subprocess.run([*LINT, str(path)], capture_output=True, text=True, timeout=120,
                                      stdin=subprocess.DEVNULL, check=False)
                self.assertEqual(0, done.returncode, done.stdout + done.stderr)

    def test_base_image_is_the_published_one(self):
        for path in ROOT.glob("docker/**/Dockerfile"):
            text = path.read_text(encoding="utf-8")
            defaults = dict(re.findall(r"^ARG (\w+)=(\S+)", text, re.MULTILINE))
            bases = {re.sub(r"\$\{(\w+)\}", lambda found: defaults[found[1]], name)
                     for name in re.findall(r"^FROM (\S+)", text, re.MULTILINE)}
            self.assertLessEqual(bases, {"debian:bookworm-slim", "build", "scratch"})


if __name__ == "__main__":
    unittest.main()
