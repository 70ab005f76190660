"""The sandbox of `xr3 exec --sandbox` and `xr3 grade`, with a judge that is root and one that is an ordinary user: one way for
both, and an error where the system does not allow it."""

import os
import platform
import unittest

from judge_modes import MOVE, PYTHON, ROOT_WITHOUT, SANDBOX, Judge, Root, User, UserWithoutNamespaces

ADD_KEY, KEYCTL = {"x86_64": (248, 250), "aarch64": (217, 219)}[platform.machine()]
SESSION, USER_KEYRING = -3, -4
LOOK = """
import os, stat
for folder, _, names in os.walk("/proc/sys"):
    for name in names:
        path = os.path.join(folder, name)
        try:
            os.close(os.open(path, os.O_WRONLY))
            print("writable", path)
        except OSError:
            pass
for name in os.listdir("/dev"):
    path = "/dev/" + name
    if stat.S_ISCHR(mode := os.lstat(path).st_mode):
        try:
            os.chmod(path, stat.S_IMODE(mode))  # the mode that it has: no harm where that is allowed
            print("changed", path)
        except PermissionError:
            print("kept", path)
print(*[line for line in open("/proc/self/status") if line.startswith(("CapEff", "CapPrm", "NoNewPrivs"))], sep="", end="")
print("namespace", os.system("unshare --user true 2>/dev/null") == 0)
print("variables", sorted(name for name in os.environ if "SECRET" in name), os.environ.get("LC_CTYPE"))
"""
KEYS = f"""
import ctypes, sys
libc = ctypes.CDLL(None, use_errno=True)
for serial in map(int, sys.argv[1:]):
    found = ctypes.create_string_buffer(100)
    print("key", libc.syscall({KEYCTL}, 11, serial, found, 100), ctypes.get_errno(), found.value)
print("new", libc.syscall({ADD_KEY}, b"user", b"mine", b"x", 1, {SESSION}), ctypes.get_errno())
"""


class InTheSandbox:
    def sandboxed(self, program, *options, **more):
        return self.judge(program, "--sandbox", *options, **more).stdout.splitlines()

    def test_nothing_of_the_kernel_can_be_changed(self):
        lines = self.sandboxed(LOOK, env={**os.environ, "LC_SECRET": "x", "MY_SECRET": "y", "LC_CTYPE": "C.UTF-8"})
        self.assertEqual([], [line for line in lines if line.startswith(("writable", "changed"))])
        self.assertIn("kept /dev/null", lines)
        self.assertIn("CapPrm:\t0000000000000000", lines)
        self.assertIn("CapEff:\t0000000000000000", lines)
        self.assertIn("NoNewPrivs:\t1", lines)
        self.assertIn("namespace False", lines)
        self.assertIn("variables [] C.UTF-8", lines)

    def test_keys_of_the_judge_are_out_of_reach(self):
        """Keyrings of a session and of a user, which no namespace hides."""
        self.write("keys.py", f"""
import ctypes, os, sys
libc = ctypes.CDLL(None, use_errno=True)
libc.syscall({KEYCTL}, 1, None)  # a session of its own
serials = [libc.syscall({ADD_KEY}, b"user", b"xr3-test", b"secret", 6, keyring) for keyring in ({SESSION}, {USER_KEYRING})]
assert min(serials) > 0, ctypes.get_errno()
for serial in serials:
    libc.syscall({KEYCTL}, 5, serial, 0x3f3f3f3f)
    libc.syscall({KEYCTL}, 15, serial, 100)  # seconds
os.execvp(sys.argv[1], [*sys.argv[1:], *map(str, serials)])
""")
        self.write("program.py", KEYS)
        done = self.run_xr3("exec", "--sandbox", "--", PYTHON, "program.py", before=[PYTHON, "keys.py"])
        self.assertEqual(["key -1 1 b''", "key -1 1 b''", "new -1 1"], done.stdout.splitlines()[:3])

    def test_what_the_command_names_is_readable_wherever_it_is(self):
        path = self.write("deep/program.py", "import os\nprint(os.getuid() != 0, open('deep/data.txt').read())\n")
        data = self.write("deep/data.txt", "data")
        for each in path.parent, path, data:
            each.chmod(0o700)
        done = self.run_xr3("exec", "--sandbox", "--read", "deep/data.txt", "--", PYTHON, "deep/program.py")
        self.assertEqual("True data", done.stdout.splitlines()[0])

    def test_the_python_package_is_there(self):
        text = "import xr3, os\nrobot = xr3.connect()\nprint(robot.ask('E?'), os.listdir(os.path.dirname(os.path.dirname(xr3.__file__))))\n"
        self.assertEqual("32 ['xr3']", self.sandboxed(text, env={**os.environ, "PYTHONPATH": "/nowhere"})[0])

    def test_a_path_to_read_must_be_there(self):
        done = self.judge("", "--sandbox", "--read", "solutoin.py", code=2)
        self.assertEqual("xr3: --read solutoin.py: No such file or directory\n", done.stderr)

    def test_the_pseudo_terminal_is_the_programs(self):
        text = ("import os\nline = os.open(os.environ['XR3_PTY'], os.O_RDWR | os.O_NOCTTY)\n"
                "os.write(line, b'F+20\\rF?')\nprint(len(os.read(line, 1)))\n")
        self.assertEqual("1", self.sandboxed(text)[0])


@SANDBOX
class RootInTheSandbox(InTheSandbox, Root, unittest.TestCase):
    def test_each_job_has_a_user_of_its_own(self):
        for name in "ada", "bob":
            self.write(f"class/{name}.py", "import os\nprint(os.getuid(), os.getgid(), os.getgroups())\n")
        self.grade()
        printed = [(self.folder / f"report/{name}.py/output.txt").read_text(encoding="utf-8") for name in ("ada", "bob")]
        self.assertEqual(["61184 61184 []\n", "61185 61185 []\n"], printed)

    def test_run_as_names_the_user(self):
        program = "import os\nprint(os.getuid())\n"
        self.assertEqual("61500", self.sandboxed(program, "--run-as", "61500")[0])
        self.folder.chmod(0o755)
        self.assertEqual("61500", self.judge(program, "--run-as", "61500").stdout.splitlines()[0])
        self.assertIn("xr3: --run-as nobody-there: no user but root", self.judge("", "--run-as", "nobody-there", code=2).stderr)
        self.assertIn("xr3: --run-as root: no user but root", self.judge("", "--run-as", "root", code=2).stderr)


@SANDBOX
class UserInTheSandbox(InTheSandbox, User, unittest.TestCase):
    def test_run_as_is_for_root(self):
        self.assertIn("xr3: --run-as: only root can run a program as another user", self.judge("", "--run-as", "61500", code=2).stderr)


class Refused:
    def test_where_it_cannot_be_made_it_says_so(self):
        self.write("class/ada.py", MOVE)
        done, _ = self.grade(code=2)
        self.assertRegex(done.stderr, "^xr3: the sandbox cannot be made: user and network namespaces: .*; allow user namespaces "
                                      ".*, or add --no-sandbox, which runs the submissions with your rights\n$")
        self.assertFalse((self.folder / "report").exists())
        self.assertIn("the sandbox cannot be made", self.judge("", "--sandbox", code=2).stderr)
        _, rows = self.grade("--no-sandbox")
        self.assertIn("10/10", rows["ada.py"])


@SANDBOX
class UserInABareContainer(Refused, UserWithoutNamespaces, unittest.TestCase):
    pass


@SANDBOX
class RootInABareContainer(Refused, Judge, unittest.TestCase):
    before = ROOT_WITHOUT


if __name__ == "__main__":
    unittest.main()
