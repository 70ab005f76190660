"""A class in which two submissions are honest and the others cheat or do harm. Each gets the points that it has earned by moving
the robot; the report is complete; no process is left, no other file has changed, and no secret is in the report."""
# labels: full

import csv
import json
import os
import pathlib
import pwd
import re
import resource
import signal
import socket
import subprocess
import unittest
import xml.etree.ElementTree

from judge_modes import PYTHON, SANDBOX, USER, Root, User
from support import XR3

# A user of its own: some programs use up what all processes of a user share.
OWN_USER = USER + 7
MARK = f"xr3-cheat-{os.getpid()}"  # in the environment of all processes of a class, and in names of files
TOKEN, FILE_SECRET, KEY_SECRET, GOAL_SECRET, ADA_SECRET = SECRETS = [
    f"{what}-4be1c07d" for what in ("token", "file", "key", "goal", "ada")]
LIMIT_S, MEMORY_MIB, PROCESSES = 5, 200, 20
GOALS = {"notes": GOAL_SECRET, "goals": [{"kind": "joint", "label": "F", "count": 9, "points": 7}, {"kind": "no_stall", "points": 2},
                                         {"kind": "holding", "name": None}]}
HEAD = f"""#!{PYTHON}
import array, ctypes, errno, fcntl, glob, os, resource, select, signal, socket, subprocess, sys, termios, threading, time
print("I am @NAME@", flush=True)
libc = ctypes.CDLL(None, use_errno=True)
libc.shmat.restype = ctypes.c_void_p
def robot():
    return socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"])))
def move(text=b"F+9\\r"):
    with robot() as line:
        line.sendall(text)
def attempt(action, *arguments):
    try:
        return action(*arguments)
    except (OSError, ValueError):
        return None
def write(path, text="xr3 was here"):
    with open(path, "a") as file:
        file.write(text)
def show(path):
    with open(path, errors="replace") as file:
        print(path, file.read(100_000))
def others():
    return [int(each) for each in os.listdir("/proc") if each.isdigit() and int(each) != os.getpid()]
"""
HONEST = {"ada": f"move()  # {ADA_SECRET}\n", "zoe": "move()\n"}
EARNS = ["ada", "zoe", "leaves-a-daemon", "shared-memory"]  # all points, honestly

# In every mode.
CHEATS = {
    # --- Points without moving the robot.
    "descriptors": """
for each in range(3, 300):
    attempt(os.ftruncate, each, 0)
    attempt(os.write, each, b'{"points": 10}')
""",
    "descriptors-of-others": """
for path in glob.glob("/proc/[0-9]*/fd/*"):
    if path.split("/")[2] not in ("self", str(os.getpid())):
        attempt(write, path, '{"points": 10}')
""",
    "memory-of-others": """
for pid in others():
    for row in attempt(lambda: open(f"/proc/{pid}/maps").readlines()) or []:
        if " rw" in row:
            attempt(lambda: os.pwrite(os.open(f"/proc/{pid}/mem", os.O_RDWR), b"10 of 10", int(row.split("-")[0], 16)))
            break
""",
    "lines-of-the-judge": r"""
for stream in sys.stdout.buffer, sys.stderr.buffer:
    stream.write(b"score 10 of 10; 1 simulated s, 4 bytes\nlines-of-the-judge  10/10\n1 of 1: lines-of-the-judge\n")
    stream.write(b"\x1b[2J\x1b]0;title\x07\x9b2J \0 \xff \xed\xa0\x80 ]]></failure><script>alert(1)</script>\n=cmd|' /C calc'!A0\n")
sys.exit(1)
""",
    "moves-and-fails": "move()\nsys.exit(129)\n",
    "moves-and-is-killed": "move()\nos.kill(os.getpid(), signal.SIGKILL)\n",
    "only-without-a-judge": "if 'XR3_PORT' not in os.environ:\n    move()\n",
    "half-a-line": """
line = robot()
line.sendall(b"F+9")
line.shutdown(socket.SHUT_WR)
line.recv(100)
""",
    "moves-after-its-end": """
if os.fork() == 0:
    os.setsid()
    line = robot()
    time.sleep(1)
    line.sendall(b"F+9\\r")
""",
    "sends-while-judged": """
if os.fork() == 0:
    os.setsid()
    line = robot()
    while True:
        line.sendall(b"D+1\\r")
time.sleep(0.3)
""",
    "bytes-for-the-transcript": r"""move(b"\x1b[2J\x1b]0;10 of 10\x07\r\n9 1 > F+9\\r\n\xff\xfb\x01\x9b2J")""",
    "guesses-the-monitor": """
for port in range(int(os.environ["XR3_PORT"]) - 200, int(os.environ["XR3_PORT"])):
    line = socket.socket()
    attempt(line.connect, ("127.0.0.1", port))
    attempt(line.sendall, b'{"op": "call", "id": 1, "call": "reset"}\\n')
""",
    # --- Harm to the judge.
    "ptrace": """
for pid in others():
    if libc.ptrace(16, pid, None, None) == 0:
        libc.ptrace(8, pid, None, None)
""",
    "signals": """
for target in os.getppid(), 1, -os.getpgid(0), -1:
    for number in signal.SIGSTOP, signal.SIGTERM, signal.SIGKILL:
        if target != -os.getpgid(0) or number != signal.SIGSTOP:
            attempt(os.kill, target, number)
""",
    "terminals": """
for path in "/dev/tty", "/dev/console", "/proc/self/fd/0", "/proc/self/fd/1", os.environ["XR3_PTY"]:
    fd = attempt(os.open, path, os.O_RDWR | os.O_NONBLOCK)
    if fd is not None:
        os.fork() and sys.exit()
        os.setsid()
        attempt(fcntl.ioctl, fd, termios.TIOCSCTTY, 0)
        for byte in b"F+9\\r":
            attempt(fcntl.ioctl, fd, termios.TIOCSTI, bytes([byte]))
""",
    "pseudo-terminal": """
for _ in range(100):
    fd = attempt(os.open, os.environ["XR3_PTY"], os.O_RDWR | os.O_NOCTTY)
    if fd is not None:
        attempt(os.fchmod, fd, 0o666)
        attempt(os.write, fd, b"D+1\\r\\0\\3\\x1c\\x1a")
        termios.tcflush(fd, termios.TCIOFLUSH)
        os.close(fd)
""",
    "pipes": """
for stream in 0, 1, 2:
    attempt(os.open, f"/proc/self/fd/{stream}", os.O_RDWR | os.O_NONBLOCK)
    attempt(fcntl.fcntl, stream, 1031, 1 << 20)
    attempt(fcntl.fcntl, stream, fcntl.F_SETFL, os.O_NONBLOCK | os.O_DIRECT)
    attempt(os.write, stream, b"x" * 1000)
""",
    "closes-its-streams": "for each in 0, 1, 2:\n    os.close(each)\ntime.sleep(60)\n",
    "stops-itself": "os.kill(os.getpid(), signal.SIGSTOP)\n",
    "ignores-signals": """
for number in range(1, 65):
    attempt(signal.signal, number, signal.SIG_IGN)
for _ in range(3):
    if os.fork() == 0:
        os.setsid()
time.sleep(60)
""",
    "leaves-a-daemon": """
move()
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        time.sleep(60)
    os._exit(0)
""",
    "chain": """
signal.signal(signal.SIGTERM, signal.SIG_IGN)
for _ in range(300):
    if os.fork():
        os._exit(0)
    os.setsid()
""",
    "children": "for _ in range(100):\n    if attempt(os.fork) == 0:\n        time.sleep(60)\ntime.sleep(60)\n",
    "memory": "x = b'x' * (300 << 20)\ntime.sleep(60)\n",
    "output": "for _ in range(300):\n    os.write(1, b'\\x1b[31m' * 20_000)\n    os.write(2, b'\\xff<]]>' * 20_000)\n",
    "connections": """
lines = [attempt(robot) for _ in range(300)]
for number, line in enumerate(each for each in lines if each):
    attempt(line.sendall, b"GET / HTTP/1.1\\r\\n\\r\\n" if number % 2 else b"F?")
""",
    "reads-no-reply": """
line = robot()
line.setblocking(False)
end = time.monotonic() + 1
while time.monotonic() < end:
    attempt(line.send, b"F?" * 30_000)
""",
    "io-uring": """
parameters = ctypes.create_string_buffer(120)
ring = libc.syscall(425, 256, parameters)
print("ring", ring)
""",
    # Without the bound it takes all of fs.epoll.max_user_watches, which the processes of a user share: in 15 s, with 1 GiB of the
    # kernel's memory.
    "epoll-watches": """
pipe, held = os.pipe()[0], [select.epoll() for _ in range(50)]
for each in [os.dup(pipe) for _ in range(150)]:
    for epoll in held:
        attempt(epoll.register, each, 0)
""",
    # --- Secrets.
    "environment": """
print(dict(os.environ))
for path in glob.glob("/proc/[0-9]*/environ"):
    attempt(show, path)
""",
    "namespaces": """
program = "umount -l /proc; mount -t proc proc /proc; nsenter -t 1 -a true; cat /proc/[0-9]*/environ; ls -l /proc/[0-9]*/fd; mount"
subprocess.run(["unshare", "--user", "--map-root-user", "--mount", "--pid", "--fork", "sh", "-c", program], stderr=2)
""",
}

# Without a sandbox a program has the rights of the judge's user: it may do these.
IN_THE_SANDBOX = {
    "files-of-others": """
for path in ["goals.json", *glob.glob("*"), *glob.glob("class/*"), *glob.glob("class/.*"), *glob.glob("report/*/*"),
             *glob.glob("report/.*/*"), *glob.glob("/tmp/xr3-run-*/*"), *glob.glob("/tmp/*/*"), "class/ada",
             "secret.txt", "/etc/shadow", "/proc/1/root/etc/shadow"]:
    attempt(show, path)
    attempt(show, "/proc/1/cwd/" + path)
""",
    "overwrites": """
for path in ["goals.json", "canary.txt", "canary.zip", "class/ada", "class/zoe", "class/overwrites", sys.argv[0], "report/ada/result.json",
             "report/grades.csv", "report/.overwrites/result.json", "/proc/1/cwd/canary.txt", "/proc/1/root/canary.txt"]:
    attempt(write, path)
    attempt(os.unlink, path)
    attempt(os.rename, path, path + "-")
    attempt(os.chmod, path, 0o777)
""",
    "links": """
for number, path in enumerate(["secret.txt", "class/ada", "goals.json", "/etc/shadow", "/proc/1/root", sys.argv[0]]):
    for link in os.link, os.symlink:
        attempt(link, path, f"link{number}")
        attempt(show, f"link{number}")
os.symlink("loop", "loop")
""",
    "names": r"""
for name in b"\x1b[2J\n", b"\xff\xfe", b"-rf", b"{}", b"a" * 255:
    for folder in b".", b"/tmp", b"/dev/shm":
        attempt(lambda: open(folder + b"/" + name, "w").close())
        attempt(os.mkfifo, folder + b"/fifo" + name[:9])
        attempt(socket.socket(socket.AF_UNIX).bind, folder + b"/socket" + name[:9])
""",
    "next-submission": """
for folder in [*sys.path, "/tmp", os.path.expanduser("~"), os.getcwd(), "/etc", "/root", "/var/tmp", "/usr/lib/python3/dist-packages"]:
    for name in "sitecustomize.py", "usercustomize.py", "socket.py", ".profile", ".bashrc", "ld.so.preload", "environment":
        attempt(write, folder + "/" + name, "print('10 of 10')\\n# xr3-cheat\\n")
    attempt(write, folder + "/@MARK@")
for path in glob.glob("/proc/*/environ"):
    attempt(write, path, "LD_PRELOAD=/tmp/x")
""",
    "cron": r"""#!/bin/sh
echo I am @NAME@
(echo '* * * * * touch /tmp/@MARK@' | crontab -
echo 'touch /tmp/@MARK@' | at now
systemd-run --user touch /tmp/@MARK@
for file in /etc/crontab /etc/cron.d/@MARK@ /var/spool/cron/crontabs/$(id -un) ~/.profile /etc/rc.local /var/tmp/@MARK@; do
  echo '* * * * * root touch /tmp/@MARK@' >>$file
done) 2>&1
""",
    "rights": r"""#!/bin/sh
echo I am @NAME@
(cp /bin/sh shell; chmod 6755 shell; ./shell -p -c 'id; cat secret.txt /etc/shadow'
sudo -n cat /etc/shadow; su -c 'cat /etc/shadow' </dev/null; pkexec id
mount -t tmpfs none /usr; mount -o remount,rw /; mount -o remount,rw /usr
unshare -Ur id; unshare -m id; chroot / id; nsenter -t 1 -m id; ip link; date -s 2001-01-01; hostname @MARK@; setpriv --reuid=0 id
mknod mem c 1 1; mknod disk b 254 0; head -c 9 mem disk /dev/mem /dev/kmsg /dev/vda /dev/sda) 2>&1
exit 0
""",
    "perl": r"""#!/usr/bin/perl
$| = 1;
print "I am @NAME@\n";
use POSIX;
for (1 .. 3) { unless (fork) { POSIX::setsid(); fork and exit; $0 = "xr3"; sleep 60 } }
for ("/proc/1/mem", "canary.txt", "class/ada", "/etc/passwd", "/tmp/@MARK@") { if (open(my $file, ">>", $_)) { print $file "cheat" } }
""",
    "keys": """
call = {"x86_64": 250, "aarch64": 219}[os.uname().machine]
serials = [int(row.split()[0], 16) for row in open("/proc/keys")]
for serial in [-1, -2, -3, -4, -5, *serials]:
    found = ctypes.create_string_buffer(1000)
    print(serial, libc.syscall(call, 11, serial, found, 1000), found.raw.strip(b"\\0"))
""",
    "kernel": """
for path in ["/proc/sys/kernel/core_pattern", "/proc/sys/kernel/hostname", "/proc/sys/vm/drop_caches", "/proc/sysrq-trigger",
             "/proc/sys/kernel/ns_last_pid", "/sys/kernel/uevent_helper"]:
    attempt(write, path, "|/tmp/x")
attempt(write, "/proc/self/oom_score_adj", "-1000")
attempt(os.nice, -20)
attempt(os.setpriority, os.PRIO_PGRP, 0, -20)
attempt(resource.setrlimit, resource.RLIMIT_CORE, (-1, -1))
os.abort()
""",
    "other-ports": """
for address in "127.0.0.1", "localhost", "10.0.0.1":
    line = socket.socket()
    line.settimeout(1)
    attempt(line.connect, (address, @PORT@))
    attempt(line.sendall, b"reached")
line = socket.socket(socket.AF_UNIX)
attempt(line.connect, "\\0@MARK@")
attempt(line.sendall, b"reached")
""",
    "shared-memory": """
move()
place = libc.shmget(0x58523343, 1 << 20, 0o1666)
libc.semget(0x58523343, 1, 0o1666)
libc.msgget(0x58523343, 0o1666)
attempt(write, "/dev/shm/@MARK@")
""",
    "fills-folders": """
for folder in "/tmp", "/dev/shm", ".":
    with open(folder + "/large", "wb", buffering=0) as file:
        while attempt(file.write, b"x" * (1 << 20)):
            pass
""",
    "files": "for number in range(10_500):\n    open(f'/tmp/{number}', 'w').close()\ntime.sleep(60)\n",
    # AF_VSOCK knows no network namespace: the program would reach the machine's own sockets, and those of its host.
    "virtual-sockets": """
try:
    socket.socket(socket.AF_VSOCK, socket.SOCK_STREAM).bind((socket.VMADDR_CID_ANY, @VSOCK@))
except OSError as error:
    print("the machine's" if error.errno == errno.EADDRINUSE else "none", error)
""",
}

HOLD = "print('holds more than allowed', flush=True)\ntime.sleep(2)\n"
ALONE = """
def alone():
    time.sleep(0.3)
    {}
    os._exit(0)
threading.Thread(target=alone).start()
libc.syscall({{"x86_64": 60, "aarch64": 93}}[os.uname().machine], 0)
"""
# /proc/PID of a process whose first thread has ended tells nothing of its memory and its folders.
CHEATS["memory-without-first-thread"] = ALONE.format("x = b'x' * (300 << 20); time.sleep(60)")
IN_THE_SANDBOX["files-without-first-thread"] = ALONE.format(
    "[open(f'/tmp/{number}', 'w').close() for number in range(10_500)]; time.sleep(60)")
# Programs that pass a limit, which the judge does not see, as docs/exec.md says. Each of them gives up what it has after 2 s.
UNSEEN = {
    # Files without a name and without a mapping are counted nowhere.
    "memory-as-memfd": "file = os.memfd_create('x')\nfor _ in range(300):\n    os.write(file, b'x' * (1 << 20))\n" + HOLD,
    # Buffers of the kernel: sockets, pipes, epoll.
    "memory-in-sockets": """
most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
held, count = [], 0
while count < 300 << 20:
    pair = attempt(socket.socketpair)
    if not pair:
        break
    pair[0].setblocking(False)
    held.append(pair)
    while sent := attempt(pair[0].send, b"x" * 65_536):
        count += sent
""" + HOLD,
}
UNSEEN_IN_THE_SANDBOX = {
    # Segments that no process has attached; without the sandbox they would stay on the machine.
    "memory-in-segments": """
for _ in range(4):
    place = libc.shmget(0, 75 << 20, 0o1600)
    address = libc.shmat(place, None, 0)
    ctypes.memset(address, 1, 75 << 20)
    libc.shmdt(ctypes.c_void_p(address))
""" + HOLD,
}
ENDS = {  # words in the row
    "memory": "MiB of memory", "memory-without-first-thread": "MiB of memory", "files-without-first-thread": "10000 files", "children": "processes", "files": "10000 files", "closes-its-streams": "still ran",
    "stops-itself": "still ran", "ignores-signals": "still ran", "lines-of-the-judge": "exit code 1",
    "moves-and-fails": "the program ended with",
    "moves-and-is-killed": "signal 9", "kernel": "signal 6",
    **dict.fromkeys([*UNSEEN, *UNSEEN_IN_THE_SANDBOX], "the program had more than")}
PASSING = {*UNSEEN, *UNSEEN_IN_THE_SANDBOX}  # do not end so

# 15 x 250 descriptors under way on sockets, more than the usual soft limit of open files (1024). The system counts them
# for each user, and refuses those that the judge sends: no run can be made until the program ends.
IN_FLIGHT = """
most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
held = [socket.socketpair() for _ in range(15)]
for pair in held:
    pair[0].sendmsg([b"x"], [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", [0] * 250))])
print("in flight", flush=True)
time.sleep(4)
"""
KEYS = f"""
import ctypes, os, platform, sys
add, call = {{"x86_64": (248, 250), "aarch64": (217, 219)}}[platform.machine()]
libc = ctypes.CDLL(None)
libc.syscall(call, 1, None)
for keyring in -3, -4:
    serial = libc.syscall(add, b"user", b"xr3-cheat", {KEY_SECRET.encode()!r}, {len(KEY_SECRET)}, keyring)
    libc.syscall(call, 5, serial, 0x3f3f3f3f)
    libc.syscall(call, 15, serial, 200)  # seconds
os.execvp(sys.argv[1], sys.argv[1:])
"""
RUN_FILES = {"files.txt", "output.txt", "transcript.txt", "recording.xr3rec", "end.svg", "result.json", "result.txt"}


def left():
    """Processes of a class, by a word in their environment."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            if int(pid) != os.getpid() and MARK.encode() in pathlib.Path("/proc", pid, "environ").read_bytes():
                found.append(int(pid))
        except OSError:
            pass
    return found


def end_those_left():
    for pid in left():
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass


def files_in(folder, without):
    """{path: all that must not change} of all files below a folder."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if without not in path.relative_to(folder).parts[:1]:
            its = path.lstat()
            found[str(path.relative_to(folder))] = (
                its.st_mode, its.st_uid, its.st_nlink, path.is_dir() or its.st_mtime_ns, path.is_file() and path.read_bytes())
    return found


def marks():
    """Files of the machine that a program has left."""
    homes = {pathlib.Path.home(), *(pathlib.Path(each.pw_dir) for each in pwd.getpwall() if each.pw_uid == OWN_USER)}
    places = ["/tmp", "/var/tmp", "/dev/shm", "/etc", "/etc/cron.d", "/usr/lib/python3/dist-packages", *homes]
    segments = pathlib.Path("/proc/sysvipc/shm").read_text(encoding="ascii").splitlines()
    return ([place for place in places if os.path.exists(os.path.join(place, MARK))]
            + [row for row in segments if str(0x58523343) in row.split()])


class Cheats:
    options = []
    secrets = SECRETS
    cheats = {**CHEATS, **IN_THE_SANDBOX, **UNSEEN, **UNSEEN_IN_THE_SANDBOX}

    def give(self, path):
        if self.before and os.getuid() == 0:
            os.chown(path, OWN_USER, OWN_USER)

    def setUp(self):
        super().setUp()
        self.addCleanup(end_those_left)
        self.tcp, self.unix = socket.create_server(("127.0.0.1", 0)), socket.socket(socket.AF_UNIX)
        self.unix.bind("\0" + MARK)
        self.unix.listen()
        for each in self.tcp, self.unix:
            each.setblocking(False)
            self.addCleanup(each.close)
        self.vsock = self.take_vsock()
        self.write("goals.json", json.dumps(GOALS))
        self.write("keys.py", KEYS)
        self.write("canary.txt", "canary")
        self.write("canary.zip", "PK")
        self.write("secret.txt", FILE_SECRET).chmod(0o600)

    def take_vsock(self):
        """A port of the machine's virtual sockets; nothing is sent to it."""
        try:
            taken = socket.socket(socket.AF_VSOCK, socket.SOCK_STREAM)
            taken.bind((socket.VMADDR_CID_ANY, socket.VMADDR_PORT_ANY))
        except OSError:
            return 0
        self.addCleanup(taken.close)
        return taken.getsockname()[1]

    def submit(self, name, text):
        text = text if text.startswith("#!") else HEAD + text
        for word, value in ("@NAME@", name), ("@MARK@", MARK), ("@VSOCK@", str(self.vsock)), ("@PORT@", str(self.tcp.getsockname()[1])):
            text = text.replace(word, value)
        self.write(f"class/{name}", text).chmod(0o755)

    def run_class(self, *options, **more):
        environment = {**os.environ, "XR3_TOKEN": TOKEN, "PATH": f"{os.environ['PATH']}:/nowhere/{MARK}"}
        return self.grade(*self.options, *options, command=["{}"], env=environment, before=[PYTHON, "keys.py"],
                          errors="surrogateescape", **more)

    def test_a_class_of_cheats(self):
        names = sorted([*HONEST, *self.cheats])
        for name, text in {**HONEST, **self.cheats}.items():
            self.submit(name, text)
        before = files_in(self.folder, "report")
        done, rows = self.run_class("--jobs", "4", "--max-seconds", LIMIT_S, "--memory", MEMORY_MIB, "--processes", PROCESSES)
        self.assertEqual([], left())
        self.assertEqual(before, files_in(self.folder, "report"))
        self.assertEqual([], marks())
        for each in self.tcp, self.unix:
            self.assertRaises(BlockingIOError, each.accept)
        self.check_points(names, done, rows)
        self.check_report(names)
        self.check_secrets(done)
        unexpected = {name for name, words in ENDS.items() if name in names and words not in rows[name]}
        self.assertEqual(PASSING & set(names), unexpected, done.stdout)

    def check_points(self, names, done, rows):
        self.assertEqual(names, [line.split()[0] for line in done.stdout.splitlines()])
        self.assertEqual([], re.findall(r"[^\n -~]", done.stdout + done.stderr))
        for name in names:
            points = 10 if name in EARNS else 0
            self.assertRegex(rows[name], rf"^{name} +{points}/10 ", rows[name])
            self.assertEqual(points, json.loads(self.file(name, "result.json"))["points"], name)

    def file(self, name, which):
        return (self.folder / "report" / name / which).read_text(encoding="utf-8", errors="surrogateescape")

    def check_report(self, names):
        report = self.folder / "report"
        self.assertEqual({*names, "index.html", "grades.csv", "junit.xml"}, {each.name for each in report.iterdir()})
        for name in names:
            self.assertEqual(RUN_FILES, {each.name for each in (report / name).iterdir()}, name)
            self.assertEqual(f"I am {name}", self.file(name, "output.txt").split("\n", 1)[0])
            self.assertNotIn("Traceback", self.file(name, "output.txt"), "an attack was not tried to its end")
            self.assertEqual(name, json.loads(self.file(name, "result.json"))["program"])
            for which in "transcript.txt", "result.txt", "result.json":
                self.assertEqual([], re.findall(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]", self.file(name, which)), (name, which))
        with open(report / "grades.csv", encoding="utf-8-sig") as file:
            table = list(csv.DictReader(file))
        self.assertEqual(names, [row["submission"] for row in table])
        self.assertEqual([each for each in names if each in EARNS], [row["submission"] for row in table if row["points"] == "10"])
        suites = xml.etree.ElementTree.parse(report / "junit.xml").getroot()
        self.assertEqual(names, [suite.get("name") for suite in suites])
        page = (report / "index.html").read_text(encoding="utf-8")
        self.assertNotIn("<script", page)
        self.assertEqual(names, re.findall(r'<section id="([^"]*)"', page))

    def check_secrets(self, done):
        texts = {"what was printed": (done.stdout + done.stderr).encode("utf-8", "surrogateescape")}
        texts |= {str(path): path.read_bytes() for path in (self.folder / "report").rglob("*") if path.is_file()}
        found = [(secret, where) for secret in self.secrets for where, text in texts.items() if secret.encode() in text]
        self.assertEqual([], found)


@SANDBOX
class RootInTheSandbox(Cheats, Root, unittest.TestCase):
    pass


class OrdinaryUser(Cheats, User):
    before = [each.replace(str(USER), str(OWN_USER)) for each in User.before]


@SANDBOX
class UserInTheSandbox(OrdinaryUser, unittest.TestCase):
    def test_descriptors_in_flight(self):
        if resource.getrlimit(resource.RLIMIT_NOFILE)[1] < 4096:
            self.skipTest("a program may not open so many files")
        for name, text in {"a-eve": IN_FLIGHT, "b-waits": "time.sleep(2)\n", **HONEST}.items():
            self.submit(name, text)
        self.before = ["sh", "-c", 'ulimit -Sn 1024 && exec "$@"', "sh", *self.before]
        _, rows = self.run_class("--jobs", "2", code=None)
        for name in HONEST:
            self.assertIn("10/10", rows[name])

    def test_a_fifo_as_a_submission(self):
        self.submit("ada", HONEST["ada"])
        os.mkfifo(self.folder / "class/fifo")
        (self.folder / "class/fifo").chmod(0o755)
        self.give(self.folder / "class/fifo")
        with subprocess.Popen([*self.before, XR3, "grade", "class", "--goals", "goals.json", "--report", "report", "--max-seconds", "2",
                               "--", "{}"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as judge:
            try:
                output, _ = judge.communicate(timeout=15)
            except subprocess.TimeoutExpired:
                os.close(os.open(self.folder / "class/fifo", os.O_WRONLY | os.O_NONBLOCK))  # lets it go on
                output, _ = judge.communicate(timeout=60)
                self.fail(f"it waits for a FIFO\n{output}")

    def test_virtual_sockets(self):
        if not self.vsock:
            self.skipTest("this kernel has no virtual sockets")
        self.submit("eve", IN_THE_SANDBOX["virtual-sockets"])
        self.run_class()
        self.assertNotIn("the machine's", self.file("eve", "output.txt"))


class UserWithoutSandbox(OrdinaryUser, unittest.TestCase):
    options = ["--no-sandbox"]
    cheats = {**CHEATS, **UNSEEN}
    secrets = [TOKEN]


if __name__ == "__main__":
    unittest.main()
