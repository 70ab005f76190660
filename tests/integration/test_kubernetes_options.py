"""deploy/kubernetes: the server of this build accepts the options of the manifests. `./test --images` tests
the rest."""
# labels: full

import pathlib
import re
import tempfile
import time
import unittest

from support import DEADLINE_S, ROOT, XR3, Server, run_xr3

FOLDER = pathlib.Path(ROOT, "deploy", "kubernetes")
WORKLOADS = (FOLDER / "class" / "deployment.yaml", FOLDER / "departments" / "statefulset.yaml")
TOKEN = "a token of the tests"


class Options(unittest.TestCase):
    def test_each_file_starts_a_server(self):
        files = sorted(FOLDER.glob("*/*.toml"))
        self.assertEqual(4, len(files))
        for path in files:
            with self.subTest(path.name), tempfile.TemporaryDirectory() as folder:
                token = pathlib.Path(folder, "token")
                token.write_text(TOKEN, encoding="utf-8")
                token.chmod(0o440)
                with Server("--config", str(path), "--token-file", str(token), clock="real") as xr3:
                    with xr3.monitor() as monitor:
                        self.assertEqual("read", monitor.hello["access"])
                        self.assertEqual("result", monitor.request("auth", token=TOKEN)["op"])
                    self.assertNotIn("warn", xr3.log())

    def test_the_class_may_be_fixed(self):
        """The two lines of xr3.toml that are comments, in the place of the three above them, with `private`."""
        text = (FOLDER / "class" / "xr3.toml").read_text(encoding="utf-8")
        fixed, count = re.subn(r"(?m)^cell-per-connection.*\n(?:.*\n)*?linger.*\nmax-cells.*\n#.*\n# (roster = .*)\n# (continue = true)$", r"\1\n\2", text)
        self.assertEqual(1, count)
        with tempfile.TemporaryDirectory() as folder:
            options, token = pathlib.Path(folder, "xr3.toml"), pathlib.Path(folder, "token")
            roster = pathlib.Path(folder, "class.csv")
            roster.write_text("\n".join(["name", *(f"student-{number:02}" for number in range(1, 31))]), encoding="ascii")
            fixed = fixed.replace("/var/lib/xr3/class.csv", str(roster))
            options.write_text(fixed.replace("private = false", "private = true"), encoding="utf-8")
            token.write_text(TOKEN, encoding="utf-8")
            token.chmod(0o440)
            with Server("--config", str(options), "--record", f"{folder}/recordings", "--token-file", str(token), clock="real") as xr3:
                with xr3.monitor() as monitor:
                    monitor.request("auth", token=TOKEN)
                    self.assertEqual(30, len(monitor.read()["cells"]))
                    self.assertEqual(30, len({cell["token"] for cell in monitor.call("cells")["cells"]}))
                self.assertEqual(30, len(list(pathlib.Path(folder, "recordings").rglob("*.xr3rec"))))

    def test_a_robot_comes_back_by_the_command_of_the_page(self):
        """With another path, other ports and another token file. The recording is that of a server that was killed."""
        page = (FOLDER / "README.md").read_text(encoding="utf-8")
        command, = re.findall(r"^kubectl exec .* -- /usr/bin/xr3 (replay .*--serve.*)$", page, re.MULTILINE)
        with tempfile.TemporaryDirectory() as folder:
            token = pathlib.Path(folder, "token")
            token.write_text(TOKEN, encoding="utf-8")
            token.chmod(0o440)
            recordings = pathlib.Path(folder, "recordings")
            with Server("--config", str(FOLDER / "class" / "xr3.toml"), "--record", str(recordings), "--token-file",
                        str(token), clock="real") as xr3, xr3.line() as line:
                line.send("E+30\r")
                while (reply := chr(line.ask("E?"))) == ">":  # 30 counts to go
                    pass
                self.wait_for(recordings, f'"in":"E?","out":"{reply}"')
                xr3.process.kill()
                xr3.process.wait()
            file, = recordings.glob("c1/*.xr3rec")
            words = command.split()
            for word, value in ((r".*\.xr3rec", file), (r"9700|9701", "0"), (r"/run/secrets/xr3/token", token)):
                words = [str(value) if re.fullmatch(word, each) else each for each in words]
            server = Server(command=[XR3, *words])
            server.options.clear()
            with server as xr3, xr3.monitor() as monitor:
                monitor.request("auth", token=TOKEN)
                joint, = (joint for joint in monitor.get()["joints"] if joint["label"] == "E")
                self.assertNotEqual(0, joint["count"])
                monitor.call("pause")

    def wait_for(self, recordings, text):
        deadline = time.monotonic() + DEADLINE_S
        while not any(text in path.read_text(encoding="ascii") for path in recordings.glob("c1/*.xr3rec")):
            self.assertLess(time.monotonic(), deadline)

    def test_arguments_are_known(self):
        known = set(re.findall(r"--[\w-]+", run_xr3("serve", "--help").stdout))
        for path in WORKLOADS:
            arguments = re.findall(r"^ +- (--[\w-]+)=", path.read_text(encoding="utf-8"), re.MULTILINE)
            with self.subTest(path.name):
                self.assertGreater(len(arguments), 1)
                self.assertLessEqual(set(arguments), known)

    def test_the_ports_are_the_defaults(self):
        """Includes the probes, which have no arguments."""
        for path in WORKLOADS:
            text = path.read_text(encoding="utf-8")
            with self.subTest(path.name):
                self.assertEqual(["9600", "9601"], re.findall(r"containerPort: (\d+)", text))
                self.assertEqual(2, text.count("command: [/usr/bin/xr3, healthcheck]"))


if __name__ == "__main__":
    unittest.main()
