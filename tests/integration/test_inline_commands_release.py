"""Every command in the text of README.md, CONTRIBUTING.md, SECURITY.md, docs, docker, deploy and clients. Each is of one
of the kinds below and runs as its kind says: unchanged, or with other ports, files and values for placeholders.
Of a command that would change the machine, or that needs an engine or a long time, its parts are checked:
options, scripts, presets, files, packages and units. (The commands in fences: test_docs_release.py.)"""

import json
import os
import pathlib
import pty
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import unittest

import pages
from stub_checkout import StubCheckout
from support import DEADLINE_S, LOCALHOST, ROOT, XR3, Server, run_xr3
from telnet import Telnet

BUILD = pathlib.Path(XR3).parent
HINT = "correct it, or add a kind that runs it to KINDS in tests/integration/test_inline_commands_release.py"
COMMAND_S = 120.0  # some compile a program of a client
COMPILERS = {"c": ["gcc"], "cpp": ["g++"], "java": ["javac"], "rust": ["rustc"], "bash": ["nc"]}
HELLO = pathlib.Path(ROOT, "tests", "clients", "expected", "1_hello.txt").read_text(encoding="utf-8")
# The placeholders in commands, with their values here.
PLACEHOLDERS = {"NAME": "integration.clients", "regex": "clients", "name": "clients", "HOST": LOCALHOST, "N": "1"}

# Kinds: a method of Commands, and what its commands look like. The first that matches counts.
KINDS = {
    "starts_a_server": r"(build/release/)?xr3 serve(?! --help)( .*)?",
    "shows_a_screen": r"(build/release/)?xr3 watch( .*)?",
    "opens_a_line": r"(build/release/)?xr3 term( .*)?",
    "asks_for_health": r"xr3 healthcheck( .*)?",
    "has_help": r"xr3 (check|convert|draw|exec|exec --sandbox|exercise check|export|grade|kin|replay|workcell)",
    "draws_a_picture": r"xr3 draw .*\.svg",
    "converts_a_recording": r"xr3 convert \S+ \S+\.mcap",
    "checks_a_file": r"xr3 check FILE",
    "opens_the_editor": r"xr3 workcell .*",
    "exits_with_0": r"xr3 --version|build/release/xr3 serve --help|ulimit -n|ss -ltnp",
    "runs_the_checkout": r"\./run( .*)?",
    "runs_a_suite": r"\./test( .*)?",
    "is_a_script": r"(scripts/(build-cost|capacity|notes|package|pictures|playground|release|site|viewer|wheel|llvm-tool|setup)"
                   r"|tests/fuzz/minimise)"
                   r"( (?!-).*)?",
    "uses_a_preset": r"(cmake|cmake --build|ctest) --preset \S+.*",
    "is_an_option_of_cmake": r"cmake --install( build/release)?",
    "runs_unit_tests": r"build/quick/unit_tests .*",
    "is_an_option_of_seeds": r"seeds --\S+ N",
    "talks_to_the_server": r"(curl|printf|yes) .*localhost.*",
    "is_a_session": r"telnet localhost 9600",
    "names_packages": r"(apt-get install|gcc|g\+\+|rustc|octave) [a-z+].*",
    "writes_the_manual": r"xr3 manual .*",
    "is_of_the_tests_of_packages": r"apt (remove|purge)|gunzip|docker load -i|sudo tar xf .* --strip-components=1"
                                   r"|python3 -m venv .*",
    "is_of_a_release": r"sudo apt install .*|tar xf xr3-.*|gunzip xr3-.*|docker load -i xr3-.*|docker run .* xr3:VERSION",
    "is_of_the_image": r"docker (build|exec|run|stop)( .*)?",
    "is_of_the_tests_of_images": r"buildah bud --format docker|rm -rf build/images",
    "is_of_the_cluster": r"kubectl .*|podman kube \w+",
    "names_the_unit": r"(sudo )?(systemctl|systemd-analyze|journalctl) .*",
    "copies_the_repository": r"git clone ADDRESS xr3",
    "runs_an_example": r"(make|\./|build/|python3 |node |octave-cli |java -cp build |javac ).*",
}


def kind_of(text):
    return next((kind for kind, form in KINDS.items() if re.fullmatch(form, text)), None)


def filled(text):
    """The words of a command, with values for placeholders."""
    return [PLACEHOLDERS.get(word, word).replace("…", "*") for word in shlex.split(text)]


class Commands(unittest.TestCase):
    commands = pages.inline_commands()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check(self, kind):
        """Calls the method of a kind with each of its commands."""
        commands = [command for command in self.commands if kind_of(command.text) == kind]
        self.assertTrue(commands, f"no page has such a command: delete the kind {kind}")
        for command in commands:
            with self.subTest(f"{command.place}: {command.text}"):
                getattr(self, kind)(command)

    def run_to_end(self, words, folder=None, **environment):
        """Runs a program, or a line of shell, which must succeed; returns its output."""
        words = ["bash", "-c", words] if isinstance(words, str) else words
        done = subprocess.run(words, cwd=folder or self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              env={**os.environ, **environment}, timeout=COMMAND_S, check=False)
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        return done.stdout.decode(errors="replace")

    def need(self, *programs):
        for program in programs:
            if not shutil.which(program):
                self.skipTest(f"{program} is not installed")

    def serve(self, command, arguments, environment=None):
        """Starts the command in the folder, as it is; the environment selects free ports. SIGTERM must end it."""
        environment = {"XR3_ROBOT_PORT": "0", "XR3_MONITOR_PORT": "0", **(environment or {})}
        server = Server(command=["env", "-C", self.folder, *command], environment=environment)
        server.options = arguments
        with server as xr3, xr3.monitor() as monitor:
            return monitor.hello

    def test_all_are_of_a_kind(self):
        self.assertGreater(len(self.commands), 80)
        unknown = [f"{command.place}: `{command.text}`: {HINT}" for command in self.commands
                   if kind_of(command.text) is None]
        if unknown:
            self.fail("\n" + "\n".join(unknown))

    def test_names_of_tests_exist(self):
        names = {(pages.place(path, number), code) for path, number, _, code in pages.spans()
                 if re.fullmatch(r"integration\.\w+", code)}
        self.assertGreater(len(names), 10)
        for place, name in names:
            with self.subTest(f"{place}: {name}"):
                self.assertTrue(pathlib.Path(ROOT, "tests", "integration", f"test_{name.split('.')[1]}.py").exists())

    # --- xr3

    def starts_a_server(self, command):
        master, slave = pty.openpty()  # in the place of the serial device
        arguments = [os.ttyname(slave) if word == "/dev/ttyUSB0" else word for word in shlex.split(command.text)[2:]]
        try:
            self.serve([XR3, "serve"], arguments)
        finally:
            os.close(master)
            os.close(slave)
        if "--port-file" in command.text:
            self.assertFalse((self.folder / "ports.json").exists())

    def shows_a_screen(self, command):
        _, _, *arguments = shlex.split(command.text)
        is_ipv6 = "[::1]" in command.text
        with Server(*(("--listen", "::1") if is_ipv6 else ())) as xr3:
            address = f"{'[::1]' if is_ipv6 else 'localhost'}:{xr3.monitor_port}"
            options = [word for word in arguments if not re.fullmatch(r"\S+:9601|9701", word)]
            self.assertLessEqual(len(arguments) - len(options), 1)
            address = str(xr3.monitor_port) if "9701" in arguments else address
            self.assertIn("Rhino XR-3", self.run_to_end([XR3, "watch", address, *options]))

    def opens_a_line(self, command):
        _, _, *options = shlex.split(command.text.replace("localhost:9600", ""))
        with Server() as xr3:
            done = run_xr3("term", f"localhost:{xr3.robot_port}", *options, input="E?")
        self.assertEqual((0, "32  E: 0 counts to go\n", ""), (done.returncode, done.stdout, done.stderr))

    def asks_for_health(self, command):
        with Server() as xr3:
            self.assertEqual("", self.run_to_end([XR3, *shlex.split(command.text)[1:]],
                                                 XR3_MONITOR_PORT=str(xr3.monitor_port)))

    def has_help(self, command):
        self.assertIn(command.text.split()[1], self.run_to_end([XR3, *command.text.split()[1:], "--help"]))

    def draws_a_picture(self, command):
        words = shlex.split(command.text)
        self.run_to_end([XR3, *words[1:]])
        self.assertTrue((self.folder / words[-1]).read_text(encoding="utf-8").startswith("<svg"))

    def converts_a_recording(self, command):
        *words, recording, result = shlex.split(command.text)[1:]
        shutil.copy(pathlib.Path(ROOT, "docs", "find-and-pick.xr3rec"), self.folder / recording)
        self.run_to_end([XR3, *words, recording, result])
        self.assertTrue((self.folder / result).read_bytes().endswith(b"MCAP0\r\n"))

    def checks_a_file(self, command):
        for path in sorted(pathlib.Path(ROOT, "data", "goals").glob("*.json")):
            self.assertIn(" goals, ", self.run_to_end([XR3, *command.text.replace("FILE", str(path)).split()[1:]]))

    def opens_the_editor(self, command):
        """Without input it prints its first question and does not write the file."""
        done = run_xr3(*shlex.split(command.text)[1:], cwd=self.folder, stdin=subprocess.DEVNULL)
        self.assertEqual(2, done.returncode, done.stderr)
        self.assertIn("Name [", done.stdout)
        self.assertEqual([], list(self.folder.iterdir()))

    def exits_with_0(self, command):
        words = command.text.replace("build/release/xr3", "xr3").split()
        if words[0] not in ("xr3", "ulimit"):
            self.need(words[0])
        text = shlex.join([XR3 if word == "xr3" else word for word in words])
        self.assertNotEqual("", self.run_to_end(text))

    # --- The checkout

    def copies_the_repository(self, command):
        self.need("git")
        self.run_to_end("git init -q ADDRESS")
        self.run_to_end(command.text)
        self.assertTrue((self.folder / "xr3" / ".git").is_dir())

    def runs_the_checkout(self, command):
        checkout = StubCheckout(self.folder / str(len(list(self.folder.iterdir()))))
        arguments = shlex.split(command.text)[1:]
        if "--page" in arguments:
            page = self.folder / arguments[arguments.index("--page") + 1]
            page.mkdir(exist_ok=True)
            (page / "index.html").touch()
        if arguments[:1] == ["--build"]:
            self.run_to_end([checkout.folder / "run", *arguments], **checkout.environment)
            return
        self.serve([checkout.folder / "run"], arguments, checkout.environment)

    def runs_a_suite(self, command):
        """With stubs for everything that it calls, but for ctest, which lists the tests that would run."""
        checkout = StubCheckout(self.folder / str(len(list(self.folder.iterdir()))))
        first, *arguments = filled(command.text)
        printed = self.run_to_end([first, *arguments], checkout.folder, **checkout.environment)
        self.assertIn("== Summary", printed)
        self.assertNotIn("FAILED", printed)
        is_suite = arguments[:1] and arguments[0].startswith("--") and arguments[0] != "--full"
        self.assertEqual(not is_suite, "Tests of quick" in printed, "the script does not know the option")

    def is_a_script(self, command):
        script, *arguments = filled(command.text)
        path = pathlib.Path(ROOT, script)
        self.assertTrue(os.access(path, os.X_OK))
        usage = path.read_text(encoding="utf-8")
        if script == "scripts/setup":
            for group in arguments:
                self.assertRegex(usage.splitlines()[2], rf"\b{group}\b")
        elif arguments in (["VERSION"], ["NAME"], ["OLD", "NEW"]):
            self.assertIn(" ".join([path.name, *arguments]), usage)
        for word in arguments if script == "scripts/package" else []:
            self.assertRegex(usage.splitlines()[3], rf"\b{word}\b")

    def uses_a_preset(self, command):
        words = filled(command.text)
        at = words.index("--preset")
        preset, others = words[at + 1], words[at + 2:]
        self.assertIn(f'"{preset}"', self.run_to_end([*words[:at], "--list-presets"], ROOT))
        if others:
            checkout = StubCheckout(self.folder / "checkout")
            self.assertNotIn("Total Tests: 0", self.run_to_end(words, **checkout.environment))

    def is_an_option_of_cmake(self, command):
        self.assertIn(f"  {command.text.split()[1]} ", self.run_to_end(["cmake", "--help"]))

    def runs_unit_tests(self, command):
        path, *arguments = filled(command.text)
        self.assertEqual(["--gtest_filter=*"], arguments)
        program = BUILD / pathlib.Path(path).name
        if program.exists():  # not in a release
            self.assertIn(".\n", self.run_to_end([program, *arguments, "--gtest_list_tests"]))
        targets = pathlib.Path(ROOT, "tests", "CMakeLists.txt").read_text(encoding="utf-8")
        self.assertIn(f"add_executable({program.name})", targets)
        presets = json.loads(pathlib.Path(ROOT, "CMakePresets.json").read_text(encoding="utf-8"))
        self.assertIn(path.split("/")[1], [preset["name"] for preset in presets["configurePresets"]])

    def is_an_option_of_seeds(self, command):
        self.assertIn(f'add_option("{command.text.split()[1]}"',
                      pathlib.Path(ROOT, "tests", "seeds", "main.cpp").read_text(encoding="utf-8"))

    # --- Other programs

    def talks_to_the_server(self, command):
        """The first bytes of output must arrive; `yes` has no end."""
        self.need(*re.findall(r"(?:^|\| )(\w+)", command.text))
        with Server(clock="real") as xr3:
            text = command.text.replace("9600", str(xr3.robot_port)).replace("9601", str(xr3.monitor_port))
            self.assertNotEqual(command.text, text)
            with subprocess.Popen(["bash", "-c", text], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, start_new_session=True) as process:
                try:
                    self.assertNotEqual(b"", process.stdout.read(1))
                    if not text.startswith("yes"):
                        process.stdout.read()
                        self.assertEqual(0, process.wait(DEADLINE_S))
                finally:
                    if process.poll() is None:
                        os.killpg(process.pid, signal.SIGKILL)

    def is_a_session(self, command):
        self.need("telnet")
        self.assertEqual("telnet localhost 9600", command.text)
        with Server() as xr3, Telnet(xr3.robot_port) as telnet:
            self.assertEqual(b" ", telnet.inquire(b"E?"))

    def names_packages(self, command):
        """scripts/setup installs the same packages."""
        setup = pathlib.Path(ROOT, "scripts", "setup").read_text(encoding="utf-8")
        packages = set(re.findall(r"[a-z][a-z0-9.+-]+", setup))
        self.assertLessEqual(set(command.text.removeprefix("apt-get install ").split()), packages)

    def is_of_the_image(self, command):
        """`./test --images` runs the fences of docker/README.md. Compares a command in the text with them."""
        page = pathlib.Path(ROOT, "docker", "README.md").read_text(encoding="utf-8")
        shown = [line for fence in re.findall(r"^```sh\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
                 for line in fence.splitlines()]
        shown += [re.sub(r" --build-arg \S+=\$\(.*?\)", "", line) for line in shown]
        text = command.text.replace(" -it ", " ")
        stage = re.search(r" --target (\S+)", text)
        if stage:
            dockerfile = pathlib.Path(ROOT, re.search(r" -f (\S+)", text)[1]).read_text(encoding="utf-8")
            self.assertRegex(dockerfile, rf"(?m)^FROM \S+ AS {stage[1]}$")
            text = text.replace(stage[0], " -t xr3")
        self.assertTrue(text in shown or len(text.split()) == 2 and any(line.startswith(f"{text} ") for line in shown))

    def is_of_a_release(self, command):
        """There is no published release yet, and the page says so. Options of the image are in docker/README.md."""
        page = command.place.partition(":")[0]
        self.assertIn("From the first published release on", pathlib.Path(ROOT, page).read_text(encoding="utf-8"))
        self.assertRegex(command.text, r" (\./xr3_\*\.deb|xr3:VERSION|xr3-VERSION-(linux-x86_64|image)\.tar(\.gz)?)$")
        of_the_image = pathlib.Path(ROOT, "docker", "README.md").read_text(encoding="utf-8")
        for option in re.findall(r" (-[ep] \S+)", command.text):
            self.assertIn(f" {option} ", of_the_image)

    def writes_the_manual(self, command):
        if " man " in command.text:
            self.need("man")
        self.assertNotEqual("", self.run_to_end(command.text.replace("xr3", shlex.quote(XR3), 1)))
        if "--write" in command.text:
            self.assertTrue((self.folder / "FOLDER/man/man1/xr3-serve.1").exists())

    def is_of_the_tests_of_packages(self, command):
        """Those run these commands in bare systems, with apt-get for apt; `docker load` reads what scripts/image saves."""
        tests = "".join(path.read_text(encoding="utf-8") for path in pathlib.Path(ROOT, "tests", "packages").glob("test_*.py"))
        scripts = pathlib.Path(ROOT, "scripts", "image").read_text(encoding="utf-8")
        words = command.text.replace("apt ", "apt-get ").split()
        self.assertTrue(all(word in tests + scripts for word in words if word[0] != "x" and word not in ("xf", "sudo")),
                        command.text)

    def is_of_the_tests_of_images(self, command):
        name = command.text.removeprefix("rm -rf ").removeprefix("build/")
        files = [path.read_text(encoding="utf-8") for path in pathlib.Path(ROOT, "tests", "images").rglob("*")
                 if path.name in ("engine.py", "docker")]
        pattern = rf'"build" / "{name}"' if name == "images" else re.escape(name)
        self.assertTrue(any(re.search(pattern, text) for text in files))

    def names_the_unit(self, command):
        words = command.text.removeprefix("sudo ").split()
        self.assertIn(words[-1], ("xr3", "daemon-reload"))
        self.assertTrue(pathlib.Path(ROOT, "deploy", "systemd", "xr3.service").exists())
        if shutil.which(words[0]):
            self.assertRegex(self.run_to_end([words[0], "--help"]), rf"(?m)^ +{words[1]}\b")

    def is_of_the_cluster(self, command):
        """There is no cluster here: the command exists, where it is installed. `./test --images` tests the fences."""
        words = command.text.split()
        if shutil.which(words[0]):
            self.assertIn("Usage:", self.run_to_end([*words, "--help"]))

    def runs_an_example(self, command):
        """In a copy of the client's folder, after the commands in the fences of its page."""
        copy = self.folder / command.folder.name
        words = filled(command.text)
        self.need(*COMPILERS.get(copy.name, []), *(word for word in words[:1] if "/" not in word))
        with Server(clock="real:50") as xr3:
            port = str(xr3.robot_port)
            variables = {"XR3_HOST": LOCALHOST, "XR3_PORT": port}
            if not copy.exists():
                shutil.copytree(command.folder, copy, ignore=shutil.ignore_patterns("build", "tests", "__pycache__"))
                page = (copy / "README.md").read_text(encoding="utf-8")
                self.run_to_end(re.search(r"^```sh\n(.*)\n```", page, re.MULTILINE)[1], copy, **variables)
            if "PORT" in words:
                variables = {"XR3_PORT": "1"}  # an argument overrides it
            printed = self.run_to_end([word.replace("PORT", port) for word in words], copy, **variables)
        if words[0] != "javac":
            self.assertIn(HELLO, printed)


def add_tests():
    for kind in KINDS:
        setattr(Commands, f"test_{kind}", lambda self, kind=kind: self.check(kind))


add_tests()

if __name__ == "__main__":
    unittest.main()
