"""`xr3 exec` and `xr3 grade` with real programs: good ones, and each way to be wrong."""

import csv
import json
import os
import pathlib
import re
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import unittest

import junit
from support import DEADLINE_S, GRADE, HAS_SANDBOX, XR3

# A robot program without a package: send() and ask() for bytes, wait() until a motor is done.
HEAD = """
import os, socket, sys
line = socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"])))
def send(text):
    line.sendall(text.encode())
def ask(text):
    send(text)
    return line.recv(1)[0] - 32
def wait(*labels):
    for label in labels:
        while ask(label + "?"):
            pass
def go(**counts):
    while any(counts.values()):
        for label, left in counts.items():
            part = max(-120, min(120, left))
            if part:
                send(f"{label}{part:+d}\\r")
            counts[label] -= part
        wait(*counts)
"""
# To the red block at x 262, y 0 mm, and with it to x 262, y 100 mm.
GRASP = HEAD + """
go(A=-16)
go(E=242, D=-440)
go(E=207, D=-185)
send("A+90\\r")
before = None
while (now := ask("A?")) != before:
    before = now
send("AX")
"""
CARRY = GRASP + "go(E=-207, D=185)\ngo(F=92)\n"
PLACE = CARRY + "go(E=207, D=-185)\ngo(A=-39)\ngo(E=-207, D=185)\nline.close()\n"
GOALS = {"goals": [
    {"kind": "block", "name": "red", "xyz_mm": [244, 94, 20], "mm": 8, "points": 3, "hint": "turn the base by 92 counts"},
    {"kind": "holding", "name": None},
    {"kind": "no_stall"},
    {"kind": "no_warnings"},
    {"kind": "untouched", "names": ["green", "blue"]},
    {"kind": "order", "events": ["grasped red", "released red"]}]}
TASK_S = 60


SECRET = "sixteen letters!"


class Exec(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.goals = self.write("goals.json", json.dumps(GOALS))

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def run_exec(self, *arguments, code=0, **options):
        done = subprocess.run([XR3, "exec", *map(str, arguments)], capture_output=True, text=True, timeout=TASK_S,
                              check=False, cwd=self.folder, **options)
        self.assertEqual(code, done.returncode, done.stdout + done.stderr)
        return done

    def judge(self, program, *options, code=0, **more):
        """Runs a program with the goals; returns what was printed."""
        path = self.write("program.py", program)
        return self.run_exec("--goals", self.goals, *options, "--", sys.executable, path, code=code, **more)

    def grade(self, folder, *options, command=(sys.executable, "{}"), code=0):
        report = [] if "--report" in options else ["--report", "report"]
        done = subprocess.run([XR3, *GRADE, folder, "--goals", self.goals, *report, *options, "--", *command],
                              capture_output=True, text=True, timeout=TASK_S, check=False, cwd=self.folder)
        self.assertEqual(code, done.returncode, done.stdout + done.stderr)
        return done

    # --- Good programs.

    def test_a_good_program_meets_all_goals(self):
        done = self.judge(PLACE + "print('done')\n")
        self.assertEqual("done", done.stdout.splitlines()[0])
        self.assertEqual(6, done.stdout.count("✓"), done.stdout)
        self.assertRegex(done.stdout.splitlines()[-1], r"^score 8 of 8; [\d.]+ simulated s, \d+ bytes$")

    def test_without_goals_a_program_is_only_run(self):
        done = self.run_exec("--", sys.executable, self.write("p.py", HEAD + "go(F=20)"))
        self.assertRegex(done.stdout, r"^score 0 of 0; ")

    def test_the_environment_has_the_lines_and_no_monitor(self):
        text = ("import os\nprint(os.environ['XR3_HOST'], os.path.exists(os.environ['XR3_PTY']), "
                "int(os.environ['XR3_PORT']) > 0, 'XR3_MONITOR_PORT' in os.environ)\n"
                "line = os.open(os.environ['XR3_PTY'], os.O_RDWR | os.O_NOCTTY)\n"
                "os.write(line, b'F+20\\rF?')\nprint(len(os.read(line, 1)))\n")
        done = self.judge(text, code=5)
        self.assertEqual(["127.0.0.1 True True False", "1"], done.stdout.splitlines()[:2])

    def test_the_bytes_of_a_program_that_leaves_its_pseudo_terminal_at_once(self):
        text = ("import os\nline = os.open(os.environ['XR3_PTY'], os.O_RDWR | os.O_NOCTTY)\n"
                "os.write(line, b'F+9\\r' * 200)\n")
        done = self.run_exec("--repeat", 12, "--json", "all.json", "--", sys.executable, self.write("p.py", text))
        self.assertEqual("12 of 12 runs passed\n", done.stdout)
        results = [json.loads(line) for line in (self.folder / "all.json").read_text(encoding="utf-8").splitlines()]
        self.assertEqual([800] * 12, [each["bytes"] for each in results])

    def test_runs_of_one_program_are_the_same(self):
        path = self.write("p.py", PLACE)
        done = self.run_exec("--goals", self.goals, "--repeat", 6, "--", sys.executable, path)
        self.assertEqual("6 of 6 runs passed\n", done.stdout)
        path = self.write("p.py", HEAD + "go(F=int.from_bytes(os.urandom(4), 'big') % 100)")
        done = self.run_exec("--repeat", 4, "--", sys.executable, path, code=8)
        self.assertRegex(done.stdout, r"[234] different transcripts in 4 runs")

    def test_two_runs_that_differ_are_compared(self):
        path = self.write("p.py", HEAD + "go(E=10)\n"
                          "try:\n    open('turn', 'x')\n    go(F=7)\nexcept FileExistsError:\n    go(F=9)\n")
        done = self.run_exec("--repeat", 2, "--out", "runs", "--json", "r.json", "--markdown", "r.md", "--junit", "r.xml",
                             "--github", "r.txt", "--", sys.executable, path, code=8)
        difference = done.stdout.splitlines()[-1]
        found = re.fullmatch(r"run 1 and run 2 differ first on line 1 after (\d+) bytes: run 1 sent F\+([79])\\r \(move F \+\2\) "
                             r"at tick (\d+), run 2 sent F\+([79])\\r \(move F \+\4\) at tick \3", difference)
        self.assertTrue(found, difference)
        self.assertNotEqual(found[2], found[4])
        transcript = (self.folder / "runs/001/transcript.txt").read_text(encoding="utf-8")
        before, after = transcript.split(f"{found[3]} 1 > F+{found[2]}\\r\n")
        sent = [row.split(" ", 3)[3] for row in before.splitlines() if " > " in row]
        self.assertEqual(int(found[1]), len("".join(sent).replace("\\r", "\r")))
        self.assertIn("F?", after)
        results = [json.loads(line) for line in (self.folder / "r.json").read_text(encoding="utf-8").splitlines()]
        self.assertEqual([None, difference], [each.get("difference") for each in results])
        self.assertIn(f"::error title={sys.executable} {path}%2C run 2::{difference}\n", (self.folder / "r.txt").read_text(encoding="utf-8"))
        self.assertEqual(["0", "1"], [suite.get("failures") for suite in self.junit("r.xml")])
        self.assertIn("differ first", (self.folder / "r.md").read_text(encoding="utf-8"))

    def test_annotations_of_github(self):
        self.goals.write_text(json.dumps({"goals": [{"kind": "holding", "name": "red", "hint": "100 %\nof it"}, {"kind": "no_stall"}]}),
                              encoding="utf-8")
        self.judge(HEAD + "go(F=20)\n", "--github", "r.txt", code=5)
        title = f"{sys.executable} {self.folder / 'program.py'}"
        self.assertEqual(f"::error title={title}::the jaws hold block red: they hold nothing%0Ahint: 100 %25%0Aof it\n"
                         f"::error title={title}::not counted: a robot without a program meets them, too, and no other goal is met\n",
                         (self.folder / "r.txt").read_text(encoding="utf-8"))

    def test_variations_have_other_places_each(self):
        path = self.write("p.py", HEAD)
        self.run_exec("--vary", "7:30,45", "--repeat", 3, "--out", "runs", "--json", "all.json", "--", sys.executable, path)
        results = [json.loads(line) for line in (self.folder / "all.json").read_text(encoding="utf-8").splitlines()]
        self.assertEqual([7, 8, 9], [each["seed"] for each in results])
        pictures = {(self.folder / f"runs/00{i}/end.svg").read_text(encoding="utf-8") for i in (1, 2, 3)}
        self.assertEqual(3, len(pictures))

    # --- Wrong programs.

    def test_a_program_that_never_moves(self):
        done = self.judge("print('hello')\n", code=5)
        self.assertIn("✗ block red at x 244, y 94, z 20 mm, within 8 mm: it is at x 262, y 0, z 20 mm", done.stdout)
        self.assertIn("  hint: turn the base by 92 counts", done.stdout)
        self.assertIn("r red, g green", done.stdout, "the legend of a view from above")

    def test_a_program_that_hangs(self):
        done = self.judge("import time\ntime.sleep(1000)\n", "--max-seconds", 0.5, code=7)
        self.assertIn("✗ the program still ran after 0.5 seconds (--max-seconds)", done.stdout)
        done = self.judge(HEAD + "while True:\n    ask('E?')\n", "--max-sim-seconds", 2, code=7)
        self.assertIn("✗ the limit of 2 simulated seconds was reached (--max-sim-seconds)", done.stdout)

    def test_a_program_that_floods(self):
        done = self.judge(HEAD + "while True:\n    send('E?' * 1000)\n", "--max-bytes", 100_000, "--max-sim-seconds", 1_000_000, code=7)
        self.assertIn("✗ the program sent more than 100000 bytes (--max-bytes)", done.stdout)

    def test_a_program_that_crashes(self):
        done = self.judge(PLACE + "sys.exit(3)\n", code=6)
        self.assertIn("✗ the program ended with exit code 3", done.stdout)
        self.assertEqual(6, done.stdout.count("✓"), "the goals are judged all the same")
        done = self.judge("import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)\n", code=6)
        self.assertIn("✗ the program ended with signal 11 (Segmentation fault)", done.stdout)

    # --- Points.

    def score(self, program, goals, *options, code):
        """The score of a program by some goals, and what was printed."""
        self.goals.write_text(json.dumps(goals), encoding="utf-8")
        printed = self.judge(program, *options, "--quiet", code=code).stdout
        return re.search(r"^score (.*?);", printed, re.MULTILINE)[1], printed

    def test_goals_that_a_robot_at_rest_meets_count_only_with_another(self):
        for program, code in ("", 5), (HEAD + "go(F=20)\n", 5), ("this is no Python\n", 6):
            score, printed = self.score(program, GOALS, code=code)
            self.assertEqual("0 of 8", score)
            self.assertIn("✓ the robot never stalls (not counted)\n", printed)
            reason = "the program failed" if code == 6 else "a robot without a program meets them, too, and no other goal is met"
            self.assertIn(f"\nnot counted: {reason}\n", printed)
        self.assertEqual("4 of 8", self.score(GRASP + "go(F=5)\ngo(A=-39)\nsend('Z')\n", GOALS, code=5)[0])

    def test_a_program_that_fails_gets_no_points_unless_the_file_says_so(self):
        fails = PLACE + "sys.exit(3)\n"
        score, printed = self.score(fails, GOALS, code=6)
        self.assertEqual("0 of 8", score)
        self.assertEqual(6, printed.count("(not counted)"), printed)
        self.assertEqual("8 of 8", self.score(fails, {**GOALS, "failed_program": "counts"}, code=6)[0])

    def test_goals_that_a_robot_at_rest_meets_count_alone_if_the_program_moved_and_ended_well(self):
        goals = {"goals": [{"kind": "no_stall"}, {"kind": "untouched", "names": ["red"]}]}
        for program, code, score in (("", 5, "0 of 2"), (HEAD + "ask('E?')\n", 5, "0 of 2"),
                                     (HEAD + "go(F=20)\nsys.exit(1)\n", 6, "0 of 2"), (HEAD + "go(F=20)\n", 0, "2 of 2")):
            self.assertEqual(score, self.score(program, goals, code=code)[0])
        self.assertIn("they count if the program moves the robot", self.score("", goals, code=5)[1])

    def test_a_goal_that_the_varied_blocks_meet_counts_not_alone(self):
        goals = {"goals": [{"kind": "block", "name": "red", "xyz_mm": [400, 0, None], "mm": 0.1}, {"kind": "holding", "name": "red"}]}
        printed = self.score("", goals, "--vary", 7, code=5)[1]
        x, y = map(float, re.search(r"it is at x ([-\d.]+), y ([-\d.]+), z", printed).groups())
        goals["goals"][0]["xyz_mm"] = [x, y, None]
        score, printed = self.score(HEAD + "go(F=20)\n", goals, "--vary", 7, code=5)
        self.assertEqual("0 of 2", score)
        self.assertIn("✓ block red", printed)

    def test_a_program_that_is_not_there(self):
        done = self.run_exec("--", "./no-such-program", code=6)
        self.assertIn("✗ ./no-such-program cannot be started: No such file or directory", done.stdout)

    def test_a_script_without_its_interpreter(self):
        for first, code, says in (
                ("#!/bin/sh\r", "cannot be started", "its first line ends with CR LF, as on Windows"),
                ("#!/usr/bin/env python3\r", "the program ended with exit code 127", "its first line ends with CR LF"),
                ("#! /no/such/python -u", "cannot be started",
                 'its first line names the interpreter "/no/such/python", which is not there')):
            with self.subTest(first):
                script = self.write("script", f"{first}\nexit 0\n")
                script.chmod(0o755)
                done = self.run_exec("--", "./script", code=6)
                self.assertIn(f"{code}: {says}", done.stdout)
                self.assertEqual("cannot" in code, "nothing reached" not in done.stdout)
        script = self.write("script", "#!/bin/sh\nexit 3\n")
        self.assertIn("exit code 3;", self.run_exec("--", "./script", code=6).stdout)

    def test_a_program_that_reaches_another_robot(self):
        note = "nothing reached this run's robot: use XR3_HOST and XR3_PORT"
        with socket.create_server(("127.0.0.1", 0)) as other:
            port = other.getsockname()[1]
            done = self.judge(f"import socket\nsocket.create_connection(('localhost', {port})).sendall(b'E+50')\n",
                              "--json", "r.json", "--markdown", "r.md", code=5)
        self.assertIn(f"✗ {note}\n", done.stdout)
        self.assertIn(f"**{note}**", (self.folder / "r.md").read_text(encoding="utf-8"))
        self.assertEqual(note, json.loads((self.folder / "r.json").read_text(encoding="utf-8"))["why"])
        done = self.judge(f"import socket\nsocket.create_connection(('localhost', {port}))\n", code=6)
        self.assertIn(f"✗ the program ended with exit code 1; {note}\n", done.stdout, "nothing listens any more")
        self.assertIn(f"✗ {note}\n", self.run_exec("--", "true").stdout, "without goals, too")
        self.assertNotIn(note, self.judge(HEAD, code=5).stdout, "a line was opened")
        self.assertNotIn(note, self.judge("", "--monitor", "control", code=5).stdout, "the monitor port may be enough")
        self.write("class/bob.py", "")
        self.assertIn(f"bob.py  0/8  {note}\n", self.grade("class").stdout)
        for name in "index.html", "grades.csv", "junit.xml":
            self.assertIn("nothing reached this run", (self.folder / "report" / name).read_text(encoding="utf-8"), name)

    def test_standard_input_is_empty_unless_it_is_wanted(self):
        text = "import sys\nprint(repr(sys.stdin.read()))\n"
        self.assertEqual("''", self.judge(text, code=5, input="secret").stdout.splitlines()[0])
        self.assertEqual("'secret'", self.judge(text, "--stdin", code=5, input="secret").stdout.splitlines()[0])

    # --- Results.

    def test_the_folder_of_a_run_has_everything(self):
        self.judge("print('x' * 2_000_000)\n", "--out", "run", "--quiet", code=5)
        run = self.folder / "run"
        self.assertEqual({"end.svg", "output.txt", "recording.xr3rec", "result.json", "result.txt", "transcript.txt"},
                         {each.name for each in run.iterdir()})
        output = (run / "output.txt").read_text(encoding="utf-8")
        self.assertEqual("x" * (1 << 20) + "\nxr3: the rest of the output is left out; only its first MiB is kept\n", output)
        self.assertEqual(0, stat.S_IMODE((run / "recording.xr3rec").stat().st_mode) & 0o077)
        result = json.loads((run / "result.json").read_text(encoding="utf-8"))
        self.assertEqual(("finished", False, 0, 8), tuple(result[name] for name in ("outcome", "passed", "points", "max_points")))
        self.assertEqual([True, True, False], [goal["counted"] for goal in result["goals"] if not goal["met"]] + [result["goals"][1]["counted"]])
        replay = subprocess.run([XR3, "replay", run / "recording.xr3rec"], capture_output=True, text=True, timeout=DEADLINE_S, check=False)
        self.assertEqual(0, replay.returncode, replay.stderr)
        done = self.judge("", "--out", "run", code=2)
        self.assertIn("there is something in this folder", done.stderr)

    def test_junit_and_markdown(self):
        self.judge("raise SystemExit(1)\n", "--junit", "r.xml", "--markdown", "r.md", code=6)
        suite, = self.junit("r.xml")
        self.assertEqual(["7", "2", "1", "4"], [suite.get(name) for name in ("tests", "failures", "errors", "skipped")])
        self.assertEqual("program", suite[0].get("name"))
        self.assertIsNotNone(suite[0].find("error"))
        self.assertIn("| ✗ | block red at", (self.folder / "r.md").read_text(encoding="utf-8"))

    def junit(self, name):
        """The suites of a JUnit file, which has no errors."""
        suites, errors = junit.read(self.folder / name)
        self.assertEqual([], errors)
        return suites

    def test_junit_names_the_tests_of_several_runs_apart_and_alike_each_time(self):
        goals = {"goals": [{"kind": "holding", "name": "red"}, {"kind": "holding", "name": "red"}, {"kind": "no_stall"}]}
        self.goals.write_text(json.dumps(goals), encoding="utf-8")
        names, seeds = [], []
        for seed in 7, 20:
            self.judge(HEAD + "go(F=20)\n", "--vary", seed, "--repeat", 3, "--junit", "r.xml", "--markdown", "r.md", "--json", "r.json", code=5)
            suites = self.junit("r.xml")
            self.assertEqual(["2"] * 3, [suite.get("failures") for suite in suites])
            names.append([case.get("name") for suite in suites for case in suite.iter("testcase")])
            seeds.append([suite.find("properties/property[@name='seed']").get("value") for suite in suites])
            for suite in suites:
                self.assertEqual([True, False, False, False], ["time" in case.attrib for case in suite.iter("testcase")])
        self.assertEqual(names[0], names[1], "a reporter compares them by their names")
        self.assertEqual(["the jaws hold block red, run 2", "the jaws hold block red (2), run 2", "the robot never stalls, run 2"],
                         names[0][5:8])
        self.assertEqual([["7", "8", "9"], ["20", "21", "22"]], seeds)
        self.assertIn(", run 2, blocks of seed 21: 0 of 3\n", (self.folder / "r.md").read_text(encoding="utf-8"))
        results = [json.loads(line) for line in (self.folder / "r.json").read_text(encoding="utf-8").splitlines()]
        self.assertEqual([(1, 20), (2, 21), (3, 22)], [(each["run"], each["seed"]) for each in results])

    def test_junit_has_standard_error_at_the_first_problem(self):
        noise = "sys.stderr.buffer.write(b'early ' + b'x' * 70_000 + b'\\x1b[31m\\xff<late>\\n')\n"
        for end, code, place in ("sys.exit(3)\n", 6, 0), ("", 5, 1):
            self.judge(HEAD + "import sys\nprint('printed')\n" + noise + end, "--junit", "r.xml", "--json", "r.json", "--quiet", code=code)
            suite, = self.junit("r.xml")
            cases = suite.findall("testcase")
            self.assertEqual([place], [i for i, case in enumerate(cases) if case.find("system-err") is not None])
            self.assertEqual([["error", "failure"][place], "system-err"], [child.tag for child in cases[place]])
            errors = cases[place].findtext("system-err")
            self.assertTrue(errors.endswith(r"x\x1b[31m\xff<late>" + "\n"), errors[-50:])
            self.assertEqual(65536, len(errors.replace(r"\x1b", "b").replace(r"\xff", "f")))
            self.assertNotRegex(errors, "early|printed")
            self.assertIn("<late>\n", json.loads((self.folder / "r.json").read_text(encoding="utf-8"))["stderr"])
        self.judge(PLACE + "sys.stderr.write('all is well')\n", "--junit", "r.xml", "--quiet")
        self.assertIsNone(self.junit("r.xml")[0].find("testcase/system-err"))

    def test_junit_of_bytes_that_xml_does_not_have(self):
        program = os.fsencode(self.write("x.py", "raise SystemExit(1)\n"))
        done = subprocess.run([XR3, "exec", "--junit", "r.xml", "--", sys.executable, program, b"\xff\x1b\xed\xa0\x80<"],
                              cwd=self.folder, capture_output=True, timeout=TASK_S, check=False)
        self.assertEqual(6, done.returncode, done.stderr)
        self.assertRegex(self.junit("r.xml")[0].get("name"), r"x.py \\xff\\x1b\\xed\\xa0\\x80<$")

    def test_bad_arguments_and_files(self):
        self.assertIn("xr3 exec needs PROGRAM", self.run_exec(code=2).stderr)
        self.goals.write_text('{"goals":[{"kind":"block","name":"rot","xyz_mm":[1,2,3]}]}', encoding="utf-8")
        done = self.judge("", code=2)
        self.assertIn('goals.json:1: /goals/0/name: found "rot"; allowed: a block', done.stderr)
        self.assertIn("a variation is a seed", self.judge("", "--vary", "x", code=2).stderr)

    def test_a_program_gets_no_file_and_no_token_of_the_judge(self):
        done = self.judge("import os\nprint(os.listdir('/proc/self/fd'), os.environ.get('XR3_TOKEN'))\n", code=5,
                          env={**os.environ, "XR3_TOKEN": SECRET})
        self.assertEqual("['0', '1', '2', '3'] None", done.stdout.splitlines()[0])  # 3: the folder itself

    def test_all_that_is_printed_before_the_end_is_kept(self):
        for number in range(5):
            self.judge("print('x' * 200_000)\n", "--out", f"out{number}", code=5)
            self.assertEqual(200_001, (self.folder / f"out{number}/output.txt").stat().st_size)

    def test_the_transcript_shows_every_byte_with_its_time(self):
        self.judge(HEAD + "ask('E?')\nsend('E+20\\r')\nask('E?')\nsend('E')\nsend('?')\nline.recv(1)\n", "--out", "out", code=5)
        lines = (self.folder / "out/transcript.txt").read_text(encoding="ascii").splitlines()
        rows = [re.fullmatch(r"(\d+) 1 ([<>]) (.*)", line).groups() for line in lines]
        self.assertEqual(sorted(rows, key=lambda row: int(row[0])), rows, "in the order of time")
        self.assertEqual("E?E+20\\rE?E?", "".join(text for _, way, text in rows if way == ">"))
        self.assertRegex("".join(text for _, way, text in rows if way == "<"), "^ [1-4][0-4]$")
        self.assertEqual([">", "<"], [way for _, way, _ in rows][:2], "a reply follows its inquiry")

    def test_the_monitor_only_on_request(self):
        ask = ("import json, os, socket\nport = socket.create_connection(('127.0.0.1', int(os.environ['XR3_MONITOR_PORT'])))\n"
               "file = port.makefile('rw')\nfile.write('{\"op\":\"call\",\"id\":1,\"fn\":\"home\"}\\n')\nfile.flush()\n"
               "while (message := json.loads(file.readline())).get('id') != 1:\n    pass\nprint(message['op'], message.get('ok'))\n")
        self.assertIn("KeyError", self.judge(ask, code=6).stderr)
        self.assertNotIn("True", self.judge(ask, "--monitor", "read", code=5).stdout.splitlines()[0])
        done = self.judge(ask, "--monitor", "control", code=5)
        self.assertEqual("result True", done.stdout.splitlines()[0])
        self.assertIn("the program had control of the monitor port", done.stdout)

    # --- The sandbox.

    @unittest.skipUnless(HAS_SANDBOX, "bubblewrap does not work here")
    def test_a_program_in_the_sandbox_reaches_nothing_but_the_robot(self):
        secret = self.write("secret.txt", "the solution")
        with socket.socket() as other:
            other.bind(("127.0.0.1", 0))
            other.listen()
            cheat = f"""
import os, socket
def attempt(what, act):
    try:
        act()
        print(what, "worked")
    except OSError as error:
        print(what, "failed")
attempt("reading", lambda: open({str(secret)!r}))
attempt("writing", lambda: open("mine.txt", "w"))
attempt("scratch", lambda: open("/tmp/mine.txt", "w"))
attempt("network", lambda: socket.create_connection(("127.0.0.1", {other.getsockname()[1]})))
attempt("robot", lambda: socket.create_connection((os.environ["XR3_HOST"], int(os.environ["XR3_PORT"]))))
attempt("pty", lambda: os.close(os.open(os.environ["XR3_PTY"], os.O_RDWR | os.O_NOCTTY)))
attempt("system", lambda: open("/usr/mine.txt", "w"))
attempt("root", lambda: open("/mine.txt", "w"))
"""
            done = self.judge(cheat, "--sandbox", code=5)
        found = dict(line.split() for line in done.stdout.splitlines() if line.endswith(("worked", "failed")))
        self.assertFalse((self.folder / "mine.txt").exists(), "what it writes is gone with the sandbox")
        self.assertEqual({"reading": "failed", "writing": "worked", "scratch": "worked", "network": "failed",
                          "robot": "worked", "pty": "worked", "system": "failed", "root": "failed"}, found)
        done = self.judge(cheat, "--sandbox", "--read", secret, code=5)
        self.assertIn("reading worked", done.stdout)

    @unittest.skipUnless(HAS_SANDBOX, "bubblewrap does not work here")
    def test_a_good_program_passes_in_the_sandbox(self):
        self.assertIn("score 8 of 8", self.judge(PLACE, "--sandbox").stdout)

    @unittest.skipUnless(HAS_SANDBOX, "bubblewrap does not work here")
    def test_the_sandbox_has_no_capabilities_no_secrets_and_little_space(self):
        look = """
import os
print(*[line for line in open("/proc/self/status") if line.startswith(("CapEff", "CapPrm"))], sep="", end="")
print(sorted(os.environ.keys() - {"LC_CTYPE", "LC_ALL", "TZ", "TERM", "LANG", "PWD"}))
for folder in "/tmp", "/dev/shm", ".":
    try:
        with open(folder + "/large", "wb") as file:
            for written in range(100):
                file.write(bytes(1 << 20))
                file.flush()
    except OSError as error:
        print(error.strerror, written)
"""
        done = self.judge(look, "--sandbox", code=5, env={**os.environ, "XR3_TOKEN": SECRET, "CI_PASSWORD": SECRET})
        self.assertEqual(["CapPrm:\t0000000000000000", "CapEff:\t0000000000000000",
                          "['HOME', 'PATH', 'PYTHONPATH', 'PYTHONUNBUFFERED', 'XR3_HOST', 'XR3_POLL_MS', 'XR3_PORT', 'XR3_PTY']", *["No space left on device 64"] * 3],
                         done.stdout.splitlines()[:6])

    @unittest.skipUnless(HAS_SANDBOX, "bubblewrap does not work here")
    def test_a_program_in_the_sandbox_that_crashes(self):
        """bubblewrap ends with an exit code in the place of the signal."""
        done = self.judge("import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)\n", "--sandbox", code=6)
        self.assertIn("✗ the program ended with signal 11 (Segmentation fault)", done.stdout)
        for code in 3, 128, 255:
            done = self.judge(f"raise SystemExit({code})\n", "--sandbox", code=6)
            self.assertIn(f"✗ the program ended with exit code {code}", done.stdout)

    # --- A class.

    @unittest.skipUnless(HAS_SANDBOX, "bubblewrap does not work here")
    def test_a_submission_in_the_sandbox_may_be_a_folder(self):
        (self.folder / "class").mkdir()
        self.write("class/ada/robot.py", PLACE)
        self.write("class/ada/main.py", "import robot\n")
        done = self.grade("class", command=[sys.executable, "{}/main.py"])
        self.assertRegex(done.stdout, "^ada  8/8")

    def test_grade_runs_every_submission(self):
        programs = {"ada.py": PLACE, "bob.py": "print('hello')\n", "carl <b>.py": "raise SystemExit('no')\n",
                    "=dora.py": "import time\ntime.sleep(1000)\n"}
        for name, program in programs.items():
            self.write(f"class/{name}", program)
        self.grade("class", "--max-seconds", "3")
        with open(self.folder / "report/grades.csv", encoding="utf-8-sig") as file:
            rows = {row["submission"]: row for row in csv.DictReader(file)}
        self.assertEqual({"ada.py": "8", "bob.py": "0", "carl <b>.py": "0", "'=dora.py": "0"},
                         {name: row["points"] for name, row in rows.items()})
        self.assertEqual("time_up", rows["'=dora.py"]["outcome"])
        self.assertEqual([*sorted(programs)], sorted(suite.get("name") for suite in self.junit("report/junit.xml")))
        page = (self.folder / "report/index.html").read_text(encoding="utf-8")
        self.assertIn("carl &lt;b&gt;.py", page)
        self.assertNotIn("carl <b>", page)
        self.assertIn('src="carl%20%3Cb%3E.py/end.svg"', page)
        self.assertIn("no\n", (self.folder / "report/carl <b>.py/output.txt").read_text(encoding="utf-8"))

    def interrupted(self):
        """Interrupts `xr3 grade` as Ctrl-C does, while the second of three submissions runs; returns the rows of its table."""
        self.write("class/ada.py", PLACE)
        self.write("class/bob.py", "import signal\nsignal.signal(signal.SIGTERM, signal.SIG_IGN)\nsignal.signal(signal.SIGINT, signal.SIG_IGN)\n"
                                   "while True:\n    signal.pause()\n")
        self.write("class/carl.py", "print('hello')\n")
        with subprocess.Popen([XR3, *GRADE, "class", "--goals", self.goals, "--report", "report", "--jobs", "1", "--",
                               sys.executable, "{}"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              start_new_session=True) as judge:
            self.assertEqual("1 of 3: ada.py\n", judge.stderr.readline())
            os.killpg(judge.pid, signal.SIGINT)
            printed, _ = judge.communicate(timeout=TASK_S)
            self.assertEqual(1, judge.returncode)
        self.assertIn("carl.py  0/0  not run: grading was stopped before", printed)
        return self.rows()

    def rows(self):
        with open(self.folder / "report/grades.csv", encoding="utf-8-sig") as file:
            return {row["submission"]: (row["points"], row["outcome"]) for row in csv.DictReader(file)}

    def test_after_an_interrupt_the_report_has_what_is_finished(self):
        self.assertEqual({"ada.py": ("8", "finished"), "bob.py": ("0", "not_run"), "carl.py": ("0", "not_run")}, self.interrupted())
        self.assertEqual({"ada.py", "grades.csv", "index.html", "junit.xml"}, {each.name for each in (self.folder / "report").iterdir()})
        suites = self.junit("report/junit.xml")
        self.assertEqual(["0", "1", "1"], [suite.get("skipped") for suite in suites])
        page = (self.folder / "report/index.html").read_text(encoding="utf-8")
        self.assertIn("Submissions: 3, 2 of them not run. All goals met by 1. On average 8.0 of 8 points.", page)
        self.assertNotIn("bob.py/", page, "links to files that are not there")

    def test_a_report_is_continued(self):
        self.interrupted()
        result = self.folder / "report/ada.py/result.json"
        before = result.stat().st_mtime_ns
        self.write("class/bob.py", PLACE)
        self.write("report/.carl.py/output.txt", "of a judge that was killed\n")
        self.assertIn("--only-missing", self.grade("class", code=2).stderr)
        done = self.grade("class", "--only-missing")
        self.assertEqual({"1 of 2", "2 of 2"}, {line.split(":")[0] for line in done.stderr.splitlines()})
        self.assertEqual({"ada.py": ("8", "finished"), "bob.py": ("8", "finished"), "carl.py": ("0", "finished")}, self.rows())
        self.assertEqual(before, result.stat().st_mtime_ns)
        self.assertEqual("hello\n", (self.folder / "report/carl.py/output.txt").read_text(encoding="utf-8"))
        done = self.grade("class", "--only-missing")
        self.assertEqual("", done.stderr)
        self.assertEqual(3, len(self.rows()))

    def test_a_submission_that_has_changed_is_run_again(self):
        program = self.write("class/ada/main.py", "import robot\n")
        helper = self.write("class/ada/robot.py", PLACE)
        self.write("class/bob/main.py", PLACE)
        again = lambda: self.grade("class", "--main", "main.py", "--only-missing").stderr.splitlines()
        self.grade("class", "--main", "main.py")
        self.write("class/ada/.git/FETCH_HEAD", "hidden\n")
        self.write("class/ada/__pycache__/robot.pyc", "of Python\n")
        self.assertEqual([], again())
        times = os.stat(helper)
        self.write("class/ada/robot.py", PLACE.replace("A=-39", "A=-38"))
        os.utime(helper, ns=(times.st_atime_ns, times.st_mtime_ns))  # as an archive does that is unpacked
        self.assertEqual(["1 of 1: ada"], again())
        os.remove(helper)
        self.assertEqual(["1 of 1: ada"], again())
        self.assertEqual({"ada": ("0", "failed"), "bob": ("8", "finished")}, self.rows())
        self.assertIn(f" {os.path.getsize(program)} main.py\n", (self.folder / "report/ada/files.txt").read_text(encoding="utf-8"))
        self.assertEqual([], again())

    def test_a_folder_that_is_no_result_is_not_touched(self):
        self.interrupted()
        result = self.folder / "report/ada.py/result.json"
        result.write_text("{}", encoding="utf-8")
        self.assertIn("there is no result of this version of xr3", self.grade("class", "--only-missing", code=2).stderr)

    def test_grade_takes_no_report_and_nothing_of_python_or_an_editor_for_a_submission(self):
        for name in "class/ada.py", "class/ben/main.py", "class/ben/grades.csv", "class/__pycache__/ada.pyc", "class/.idea/workspace.xml", "class/.DS_Store":
            self.write(name, "print('hello')\n")
        for report in "class/report", "class/report 2":
            done = self.grade("class", "--report", report)
            self.assertEqual(["ada.py", "ben"], [line.split()[0] for line in done.stdout.splitlines()])

    def test_of_several_runs_the_worst_counts(self):
        self.write("class/ada.py", PLACE)
        self.write("class/bob.py", PLACE + f"with open({str(self.folder / 'count')!r}, 'a+') as count:\n    count.write('x')\n    if count.tell() == 2:\n        raise SystemExit(1)\n")
        options = ["--repeat", "3", *([] if "--no-sandbox" in GRADE else ["--no-sandbox"])]
        done = self.grade("class", *options, "--jobs", "1")
        self.assertEqual(["1 of 2: ada.py", "2 of 2: bob.py"], done.stderr.splitlines())
        self.assertEqual({"ada.py": ("8", "finished"), "bob.py": ("0", "failed")}, self.rows())
        page = (self.folder / "report/index.html").read_text(encoding="utf-8")
        runs = re.search(r"The worst of 3 runs counts: .*? Below is run 2\.", page)[0]
        self.assertEqual(["8/8", "0/8", "8/8"], re.findall(r"</a> (\d/8)", runs))
        for run in "001", "002", "003":
            self.assertIn(f'<a href="bob.py/{run}/result.txt">', runs)
            self.assertTrue((self.folder / "report/bob.py" / run / "recording.xr3rec").is_file())
        self.assertEqual("", self.grade("class", *options, "--only-missing").stderr)
        self.assertEqual({"ada.py": ("8", "finished"), "bob.py": ("0", "failed")}, self.rows())
        self.assertIn("and this --repeat", self.grade("class", "--only-missing", code=2).stderr)

    def test_with_a_variation_each_run_has_the_next_seed(self):
        self.write("class/ada.py", HEAD + "send('E+50\\r')\nwait('E')\n")
        self.grade("class", "--repeat", "2", "--vary", "7")
        results = [json.loads((self.folder / "report/ada.py" / run / "result.json").read_text(encoding="utf-8")) for run in ("001", "002")]
        self.assertEqual([(1, 7), (2, 8)], [(each["run"], each["seed"]) for each in results])

    def test_equal_submissions_are_flagged_and_moodle_gets_its_worksheet(self):
        self.write("class/Ada King_11_assignsubmission_file/main.py", PLACE)
        self.write("class/Bob_12_assignsubmission_file/main.py", "# my own work\n" + PLACE)
        self.write("class/carl.py", "print('hello')\n")
        self.grade("class", command=["sh", "-c", f'if [ -d "$1" ]; then exec {sys.executable} "$1/main.py"; else exec {sys.executable} "$1"; fi', "sh", "{}"])
        with open(self.folder / "report/grades.csv", encoding="utf-8-sig") as file:
            rows = {row["submission"]: row["same_as"] for row in csv.DictReader(file)}
        self.assertEqual({"Ada King_11_assignsubmission_file": "Bob_12_assignsubmission_file",
                          "Bob_12_assignsubmission_file": "Ada King_11_assignsubmission_file", "carl.py": ""}, rows)
        with open(self.folder / "report/moodle.csv", encoding="utf-8") as file:
            grades = [(row["Identifier"], row["Full name"], row["Grade"], row["Maximum Grade"]) for row in csv.DictReader(file)]
        self.assertEqual([("Participant 11", "Ada King", "8", "8"), ("Participant 12", "Bob", "8", "8")], grades)

    def test_the_main_file_of_a_folder(self):
        self.write("class/ada/main.py", "import robot\n")
        self.write("class/ada/robot.py", PLACE)
        self.write("class/bob/pick.py", PLACE)
        self.write("class/carl.py", PLACE)
        self.write("class/dora/notes.txt", "")
        printed = self.grade("class", "--main", "main.py").stdout
        for name in "ada", "bob", "carl.py":
            self.assertRegex(printed, rf"(?m)^{name} +8/8 ")
        self.assertRegex(printed, r"(?m)^dora +0/8  dora has no file main\.py, and not exactly one other \.py file$")

    def test_a_script_may_compile_a_submission(self):
        self.write("class/ada.c", "int main(void) { return 0; }\n")
        self.write("class/bob.c", "int main(void) { return nothing; }\n")
        script = self.write("compile_and_run.sh", 'cc -o /tmp/program-$$ "$1" -lm && exec /tmp/program-$$\n')
        read = ["--read", script] if HAS_SANDBOX else []
        printed = self.grade("class", *read, command=["sh", script, "{}"]).stdout
        self.assertRegex(printed, r"(?m)^ada\.c  0/8  nothing reached this run's robot")
        self.assertIn("bob.c  0/8  the program ended with exit code 1", printed)
        self.assertIn("nothing", (self.folder / "report/bob.c/output.txt").read_text(encoding="utf-8"))

    def test_grade_says_what_is_missing(self):
        self.assertIn("the command has no {}", self.grade(".", command=["python3"], code=2).stderr)
        self.write("class/grades.csv", "")
        self.assertIn("class/grades.csv: a file of the report has this name", self.grade("class", code=2).stderr)
        self.assertFalse((self.folder / "report").exists())


if __name__ == "__main__":
    unittest.main()
