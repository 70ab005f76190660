"""Programs of the page: how one runs, what it asks its user, and what it does not have."""

import builtins
import errno
import io
import os
import re
import select
import socket
import subprocess
import sys
import threading
import time
import types
import unittest
import unittest.mock

from page_python import CHECKOUT, Case, connected, forked, in_page, install, run, xr3_page
from page_robots import FakeFfi, JavaScriptRobot, JsError, JsValue, ScriptedRobot, ServerRobot

XR3 = os.environ.get("XR3")
CLIENTS = CHECKOUT / "clients" / "python"
EXPECTED = CHECKOUT / "tests" / "clients" / "expected"
PROGRESS = re.compile(r"^  .*\d+ counts to go\n", re.MULTILINE)  # these lines depend on timing


class Asking(Case):
    @in_page
    def test_input(self, robot):
        robot.typed = ["seven", ""]
        self.assertEqual(("seven", ""), (input("how many? "), input()))
        with self.assertRaises(EOFError):
            input(3)
        self.assertEqual([("ask", "how many? "), ("ask", ""), ("ask", "3")], robot.calls)

    @in_page
    def test_standard_input(self, robot):
        robot.typed = ["first", "second", "third", "fourth"]
        self.assertTrue(sys.stdin.isatty() and sys.stdin.readable())
        self.assertEqual("first\n", sys.stdin.readline())
        self.assertEqual(("se", "cond\n"), (sys.stdin.readline(2), sys.stdin.readline()))
        self.assertEqual("thi", sys.stdin.read(3))
        self.assertEqual("rd\nfourth\n", sys.stdin.read())
        self.assertEqual([], list(sys.stdin))

    @in_page
    def test_the_output_is_shown_before(self, robot):
        shown = []
        sys.stdout = types.SimpleNamespace(flush=lambda: shown.append(len(robot.calls)))
        robot.typed = ["a", "b"]
        input()
        sys.stdin.readline()
        self.assertEqual([0, 1], shown)

    @in_page
    def test_a_program_may_replace_standard_input(self, robot):
        sys.stdin, sys.stdout = io.StringIO("mine\n"), io.StringIO()
        self.assertEqual("mine", input("? "))
        self.assertEqual([], robot.calls)


class Absent(Case):
    @in_page
    def test_threads(self, robot):
        import _thread
        import concurrent.futures
        for call in (threading.Thread(target=print).start, threading.Timer(1, print).start,
                     lambda: _thread.start_new_thread(print, ()),
                     lambda: concurrent.futures.ThreadPoolExecutor().submit(print)):
            with self.assertRaisesRegex(RuntimeError, "a program in the page has no threads"):
                call()

    @in_page
    def test_a_wait_for_other_threads_is_a_sleep(self, robot):
        event = threading.Event()
        self.assertFalse(event.wait(0.5))
        self.assertEqual(0.5, time.monotonic())
        with self.assertRaisesRegex(RuntimeError, "for ever.*no threads"):
            event.wait()
        event.set()
        self.assertTrue(event.wait())
        with self.assertRaisesRegex(RuntimeError, "un-acquired"):
            threading.Condition().wait(1)

    @in_page
    def test_processes(self, robot):
        for call in (lambda: subprocess.run(["true"]), lambda: subprocess.check_output("true", shell=True),
                     lambda: os.system("true"), lambda: os.popen("true")):
            self.assertIn("a program in the page cannot start others", self.assertFails(errno.EOPNOTSUPP, call))


class Installing(Case):
    @in_page
    def test_again_with_another_robot(self, robot):
        first = connected()
        before = [socket.socket, time.sleep, builtins.input, select.select]
        other = ScriptedRobot(typed=["typed"])
        install(other)
        self.assertEqual(before, [socket.socket, time.sleep, builtins.input, select.select])
        time.sleep(1)
        connected()
        self.assertEqual("typed", input())
        self.assertEqual([("open", 1)], robot.calls)
        self.assertEqual(4, len(other.calls))
        del first

    def test_javascript(self):
        """With Pyodide's module, values are converted, promises awaited, and errors translated."""
        def work():
            sys.modules["pyodide"] = types.SimpleNamespace(ffi=FakeFfi)
            for name in [name for name in sys.modules if name.startswith("xr3_page")]:
                del sys.modules[name]
            import xr3_page.run
            robot = ScriptedRobot(typed=["typed"])
            robot.arrives(1, b"abc")
            xr3_page.install(JavaScriptRobot(robot))
            line = connected(timeout=1)
            line.sendall(b"E?")
            self.assertEqual(b"E?", robot.sent[1])
            self.assertEqual(b"abc", line.recv(9))
            self.assertEqual(("typed", 0.0), (input(), time.monotonic()))
            with self.assertRaises(TimeoutError):
                line.recv(9)
            line.settimeout(None)
            with self.assertRaisesRegex(OSError, "^nothing more can arrive$"):
                line.recv(9)
            robot.sleep = lambda ms: (_ for _ in ()).throw(JsError("KeyboardInterrupt", "stopped"))
            with self.assertRaises(KeyboardInterrupt):
                time.sleep(1)
            files = JsValue({"main.py": "import os, sys\nsys.exit(os.environ['CODE'] == sys.argv[1] == '3')"})
            self.assertEqual(1, xr3_page.run.run(files, "main.py", JsValue(["3"]), JsValue({"CODE": "3"})))
        forked(work)


class Running(Case):
    @in_page
    def test_main(self, robot):
        program = ("import sys, os, __main__\n"
                   "print(__name__, sys.argv, os.path.basename(__main__.__file__), os.environ['XR3_POLL_MS'])\n"
                   "del os.environ['PATH']\n"
                   "with open('notes.txt') as file: print(file.read(), end='')\n")
        here, path, main = os.getcwd(), list(sys.path), sys.modules["__main__"]
        self.assertEqual((0, "__main__ ['main.py', 'a', 'b'] main.py 0\nseven\n", ""),
                         run({"main.py": program, "notes.txt": b"seven\n"}, argv=["a", "b"],
                             environ={"XR3_POLL_MS": "0"}))
        self.assertEqual((here, path), (os.getcwd(), sys.path))
        self.assertNotIn("XR3_POLL_MS", os.environ)
        self.assertIn("PATH", os.environ)
        self.assertIs(main, sys.modules["__main__"])

    @in_page
    def test_each_run_is_fresh(self, robot):
        main = ("import sys, socket, time\nimport helper, parts.one\n"
                "print(helper.seven + parts.one.eight, 'x' in globals())\n")
        spoil = "x = 1\nhelper.seven = 0\ntime.sleep = print\nsocket.setdefaulttimeout(3)\nsys.stdout = None\n"
        files = {"main.py": main + spoil, "helper.py": "seven = 7", "parts/one.py": "eight = 8"}
        self.assertEqual("15 False\n", run(files)[1])
        self.assertNotIn("helper", sys.modules)
        self.assertNotIn("parts", sys.modules)
        files["helper.py"] = "seven = 9"
        self.assertEqual("17 False\n", run(files)[1], "a change within a second counts")
        program = "import time, socket\ntime.sleep(1)\nprint(socket.getdefaulttimeout())"
        self.assertEqual((0, "None\n", ""), run(program))
        del files["helper.py"]
        self.assertIn("No module named 'helper'", run(files)[2])
        self.assertEqual("False\n", run("import os\nprint('helper.py' in os.listdir())")[1])

    @in_page
    def test_new_files_can_be_imported(self, robot):
        """A folder that changes twice within the resolution of its time of change looks unchanged to Python."""
        with unittest.mock.patch("importlib.invalidate_caches") as invalidate:
            run("")
        invalidate.assert_called_once_with()

    @in_page
    def test_files_of_the_program_stay(self, robot):
        run("with open('log.txt', 'w') as file: file.write('kept')")
        self.assertEqual((0, "kept\n", ""), run("with open('log.txt') as file: print(file.read())"))

    @in_page
    def test_exit_codes(self, robot):
        for ending, code, error in (("", 0, ""), ("sys.exit()", 0, ""), ("sys.exit(3)", 3, ""),
                                    ("sys.exit('no robot')", 1, "no robot\n"), ("raise SystemExit", 0, ""),
                                    ("raise KeyboardInterrupt", 130, "stopped\n")):
            with self.subTest(ending):
                self.assertEqual((code, "", error), run("import sys\n" + ending))

    @in_page
    def test_stop_while_a_program_waits(self, robot):
        robot.sleep = lambda ms: (_ for _ in ()).throw(KeyboardInterrupt)
        program = ("import time\nwhile True:\n  try:\n    time.sleep(1)\n"
                   "  except Exception: pass\n  finally: print('tidy')\n")
        self.assertEqual((130, "tidy\n", "stopped\n"), run(program))

    @in_page
    def test_lines_left_open_are_closed(self, robot):
        run("import socket, builtins\n"
            "builtins.kept = socket.create_connection(('', 9600))\nbuiltins.file = kept.makefile()")
        self.assertEqual([("open", 1), ("close", 1)], robot.calls)
        run("import socket\nline = socket.create_connection(('', 9600))\nfile = line.makefile()\nline.close()\n1 / 0")
        self.assertEqual(("close", 2), robot.calls[-1])

    @in_page
    def test_traceback_has_the_programs_own_frames(self, robot):
        files = {"main.py": "import helper\n\nhelper.ask()\n",
                 "helper.py": "import socket\n\ndef ask():\n    socket.create_connection(('', 1), 1).recv(1)\n"}
        code, _, error = run(files)
        self.assertEqual((1, ['File "main.py", line 3, in <module>', 'File "helper.py", line 4, in ask']),
                         (code, re.findall(r"File .*", error)))
        self.assertRegex(error, r"\ATraceback \(most recent call last\):\n")
        self.assertRegex(error, r"    helper.ask\(\)\n")
        self.assertRegex(error, r"\nTimeoutError: timed out\n\Z")

    @in_page
    def test_traceback_of_a_chain(self, robot):
        _, _, error = run("import json\ntry:\n    json.loads('')\nexcept ValueError as error:\n"
                          "    raise KeyError(7) from error\n")
        self.assertEqual(["File \"main.py\", line 3, in <module>", "File \"main.py\", line 5, in <module>"],
                         re.findall(r"File .*", error))
        self.assertIn("JSONDecodeError", error)
        self.assertIn("direct cause", error)
        self.assertRegex(error, r"KeyError: 7\n\Z")

    @in_page
    def test_traceback_without_own_frames(self, robot):
        try:
            int("x")
        except ValueError as error:
            self.assertEqual("ValueError: invalid literal for int() with base 10: 'x'\n",
                             xr3_page.report.text_of(error))

    @unittest.skipIf(sys.version_info < (3, 11), "exception groups came with Python 3.11")
    @in_page
    def test_traceback_of_a_group(self, robot):
        _, _, error = run("import json\ntry:\n    json.loads('')\nexcept ValueError as error:\n"
                          "    raise ExceptionGroup('all', [error])\n")
        self.assertNotIn("decoder.py", error)
        self.assertIn("JSONDecodeError", error)

    @in_page
    def test_syntax_errors(self, robot):
        code, _, error = run("print(1\n")
        self.assertEqual(1, code)
        self.assertRegex(error, r"\A  File \"main.py\", line 1\n    print\(1\n +\^\nSyntaxError: ")
        _, _, error = run({"main.py": "import helper\n", "helper.py": "x = = 1\n"})
        self.assertEqual(["main.py", "helper.py"], re.findall(r'File "(.*?)"', error))
        self.assertRegex(error, "SyntaxError: invalid syntax\n")

    @in_page
    def test_a_program_that_reads_a_bad_file_name(self, robot):
        self.assertIn("FileNotFoundError", run("open('none.txt')")[2])


@unittest.skipUnless(XR3, "XR3 names no program")
class Examples(Case):
    """Every example of clients/python, unmodified, with a real server at the other end."""

    def test_examples(self):
        from support import Server
        for path in sorted(CLIENTS.glob("[1-9]*.py")):
            with self.subTest(path.name), Server(clock="bytes") as xr3:
                if path.stem == "6_find_and_pick":
                    with xr3.monitor() as monitor:
                        monitor.call("block_move", name="red", xyz_mm=[285, 25, 20], yaw_deg=35)
                forked(lambda path=path, xr3=xr3: self.check(path, ServerRobot(xr3.robot_port, xr3.monitor_port)))

    def check(self, path, robot):
        install(robot)
        sys.path.append(str(CLIENTS))
        code, output, error = run(path.read_text(encoding="utf-8"), path.name, environ={"XR3_POLL_MS": "0"})
        expected = (EXPECTED / f"{path.stem}.txt").read_text(encoding="utf-8")
        self.assertEqual((0, PROGRESS.sub("", expected), ""), (code, PROGRESS.sub("", output), error))


if __name__ == "__main__":
    unittest.main()
