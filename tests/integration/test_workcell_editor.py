"""`xr3 workcell` in a pseudo-terminal and with input from a pipe: it creates a workcell, which `xr3 check`
accepts, opens it again and changes it; leaving early writes nothing."""

import json
import os
import pathlib
import pty
import select
import signal
import subprocess
import tempfile
import time
import unittest

from support import DEADLINE_S, ROOT, XR3, run_xr3

CTRL_C = "\x03"
CTRL_D = "\x04"


class Terminal:
    """`xr3 workcell` in a pseudo-terminal."""

    def __init__(self, folder, *arguments):
        self.seen = ""
        self.pid, self.screen = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.execv(XR3, [XR3, "workcell", *map(str, arguments)])

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if self.pid is not None:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
        os.close(self.screen)
        if kind is not None:
            print(f"--- screen\n{self.seen}\n---")

    def _read(self, deadline):
        """Reads the next output; b"" at its end."""
        ready, _, _ = select.select([self.screen], [], [], max(0.0, deadline - time.monotonic()))
        if not ready:
            raise AssertionError("the editor printed nothing")
        try:
            data = os.read(self.screen, 65536)
        except OSError:  # the editor has exited
            data = b""
        self.seen += data.decode().replace("\r\n", "\n")
        return data

    def wait(self, prompt):
        """Waits until the output ends with this prompt; returns the output since the last prompt."""
        deadline = time.monotonic() + DEADLINE_S
        while not self.seen.endswith(prompt):
            if not self._read(deadline):
                raise AssertionError(f"the editor exited instead of printing {prompt!r}:\n{self.seen}")
        shown, self.seen = self.seen, ""
        return shown

    def type(self, keys):
        os.write(self.screen, keys.encode())

    def answer(self, text, prompt):
        self.type(text + "\n")
        return self.wait(prompt)

    def wait_end(self):
        """Reads to the end; returns the remaining output and the exit code."""
        deadline = time.monotonic() + DEADLINE_S
        while self._read(deadline):
            pass
        _, status = os.waitpid(self.pid, 0)
        self.pid = None
        return self.seen, os.waitstatus_to_exitcode(status)


class Editor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "lab.json"

    def data(self):
        return json.loads(self.file.read_text())

    def make(self, name="Lab 7"):
        """Creates lab.json with two blocks and a camera, mostly with the default answers."""
        with Terminal(self.folder, "lab.json") as terminal:
            self.assertIn("checked against Rhino XR-3", terminal.wait("Name [my workcell]: "))
            terminal.answer(name, "Notes: ")
            terminal.answer("", "Workspace X, to the front (0.001 to 100000 mm) [600]: ")
            terminal.answer("far", "[600]: ")
            terminal.answer("", "[500]: ")
            terminal.answer("", "[700]: ")
            terminal.answer("", "[0]: ")
            terminal.answer("", "Stall under the surface? (yes or no) [no]: ")
            terminal.answer("", "A block? (yes or no) [yes]: ")
            for block in "red", "green":
                terminal.answer("", "Block's name [block 1]: " if block == "red" else "[block 2]: ")
                terminal.answer(block, "[60]: ")
                for prompt in "[30]: ", "[30]: ":
                    terminal.answer("", prompt)
                terminal.answer("", "x of its middle (0 to 600 mm) [280]: " if block == "red" else "]: ")
                terminal.answer("", "]: ")
                terminal.answer("", "Orientation (-360 to 360 degrees) [0]: ")
                terminal.answer("", "z of its middle (0 to 700 mm) [15]: ")
                terminal.answer("", "]: ")
                terminal.answer("", "Another block? (yes or no) [yes]: ")
            terminal.answer("no", "A camera? (yes or no) [yes]: ")
            terminal.answer("", "Camera x (0 to 600 mm) [300]: ")
            for _ in range(6):
                terminal.answer("", "]: ")
            terminal.answer("", "Projection (orthographic or perspective) [orthographic]: ")
            view = terminal.answer("", "workcell (not saved)> ")
            self.assertIn("r red, g green", view)
            self.assertIn("R robot   . within reach   : camera's field", view)
            self.assertFalse(self.file.exists(), "nothing is written unless asked for")
            self.assertIn("Wrote lab.json.", terminal.answer("save", "workcell> "))
            terminal.type("quit\n")
            words, code = terminal.wait_end()
            self.assertIn("are saved", words)
            self.assertEqual(0, code)

    def test_a_new_file_is_valid_and_can_be_changed(self):
        self.make()
        done = run_xr3("check", "--robot", "rhino-xr3", self.file)
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        self.assertIn("Lab 7: 2 blocks, a camera", done.stdout)

        with Terminal(self.folder, "lab.json") as terminal:
            self.assertIn('From lab.json: "Lab 7", 2 blocks.', terminal.wait("workcell> "))
            terminal.answer("move red", "x of its middle (0 to 600 mm) [280]: ")
            terminal.answer("350", "]: ")
            terminal.answer("60", "z of its middle (0 to 700 mm) [15]: ")
            self.assertIn('Changed: r "red" at (350, 60, 15).', terminal.answer("", "(not saved)> "))
            terminal.answer("turn red", "Orientation (-360 to 360 degrees) [0]: ")
            terminal.answer("45", "(not saved)> ")
            terminal.answer("remove g", 'Remove "green"? (yes or no) [yes]: ')
            terminal.answer("", "(not saved)> ")
            terminal.answer("save", "lab.json already exists. Replace it? (yes or no) [no]: ")
            self.assertEqual(2, len(self.data()["blocks"]))
            terminal.answer("yes", "workcell> ")
            terminal.type("quit\n")
            self.assertEqual(0, terminal.wait_end()[1])
        self.assertEqual([("red", [350, 60, 15], 45)],
                         [(b["name"], b["centroid"], b["yaw_deg"]) for b in self.data()["blocks"]])
        self.assertEqual(["lab.json"], os.listdir(self.folder), "no temporary files are left")

    def test_ctrl_d_and_ctrl_c_leave_without_writing(self):
        for key, words in (CTRL_D, "End of input"), (CTRL_C, "Interrupted"):
            with self.subTest(words), Terminal(self.folder, "lab.json") as terminal:
                terminal.wait("Name [my workcell]: ")
                terminal.answer("Lab 7", "Notes: ")
                terminal.type(key)
                shown, code = terminal.wait_end()
                self.assertIn(f"\n{words}: left without writing lab.json.\n", shown)
                self.assertEqual(2, code)
        self.assertEqual([], os.listdir(self.folder))

    def test_sigterm_leaves_without_writing(self):
        with Terminal(self.folder, "lab.json") as terminal:
            terminal.wait("Name [my workcell]: ")
            os.kill(terminal.pid, signal.SIGTERM)
            shown, code = terminal.wait_end()
        self.assertIn("Interrupted: left without writing", shown)
        self.assertEqual(2, code)

    def pipe(self, *arguments, lines, end="\n"):
        return subprocess.run([XR3, "workcell", *map(str, arguments)], input="\n".join(lines) + end,
                              cwd=self.folder, capture_output=True, text=True, timeout=DEADLINE_S,
                              check=False)

    def test_reads_a_pipe(self):
        for end in "\n", "":
            self.file.unlink(missing_ok=True)
            done = self.pipe("lab.json", "--from", "adept-one", "--robot", "adept-one",
                             lines=["name", "Second table", "", "move red", "600", "", "", "save", "quit"],
                             end=end)
            self.assertEqual((0, ""), (done.returncode, done.stderr))
            self.assertIn("Name [Adept One table]: Second table\n", done.stdout)
            self.assertIn("No problems", done.stdout)
            self.assertEqual("Second table", self.data()["name"])
            self.assertEqual([600, 0, 520], self.data()["blocks"][0]["centroid"])
        done = run_xr3("check", "--robot", "adept-one", self.file)
        self.assertEqual((0, ""), (done.returncode, done.stderr))

    def test_a_pipe_that_ends_early_writes_nothing(self):
        done = self.pipe("lab.json", lines=["Lab 7", ""])
        self.assertEqual(2, done.returncode)
        self.assertIn("End of input: left without writing lab.json.", done.stdout)
        self.assertEqual([], os.listdir(self.folder))

    def test_a_file_that_appeared_meanwhile_is_not_replaced_silently(self):
        with Terminal(self.folder, "lab.json", "--from", "rhino-xr3") as terminal:
            terminal.wait("workcell (not saved)> ")
            self.file.write_text("mine")
            terminal.answer("save", "lab.json already exists. Replace it? (yes or no) [no]: ")
            terminal.answer("", "workcell (not saved)> ")
            self.assertEqual("mine", self.file.read_text())

    def test_the_default_robot_has_the_name_of_the_file(self):
        done = self.pipe("intelledex-660.json", lines=[])
        self.assertIn("checked against Intelledex 660", done.stdout)
        done = self.pipe("lab.json", "--robot", pathlib.Path(ROOT, "data/robots/adept-one.json"), lines=[])
        self.assertIn("checked against Adept One", done.stdout)
        self.assertIn("Work surface", self.pipe("adept-one.json", lines=[""] * 5).stdout)

    def test_reads_the_papers_plain_form(self):
        (self.folder / "hand.txt").write_text("600 500 700\n1\n64 32 40 262 0 20 90\n")
        done = self.pipe("lab.json", "--from", "./hand.txt", lines=["save", "quit"])
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        self.assertEqual("block 1", self.data()["blocks"][0]["name"])

    def test_invalid_files_are_refused(self):
        (self.folder / "bad.json").write_text('{"name": ')
        robot = pathlib.Path(ROOT, "data/robots/adept-one.json")
        for arguments, words in [(["lab.txt"], ".json"), (["no/lab.json"], "cannot be written"),
                                 (["bad.json"], "bad.json:1"), ([], "needs NEW.json"),
                                 (["lab.json", "--from", robot], "allowed: a workcell"),
                                 (["lab.json", "--from", "nowhere"], "nowhere"),
                                 (["lab.json", "--robot", "nobody"], "nobody")]:
            with self.subTest(arguments=arguments):
                done = self.pipe(*arguments, lines=["save", "quit"])
                self.assertEqual((2, ""), (done.returncode, done.stdout))
                self.assertIn(words, done.stderr)
        self.assertEqual(["bad.json"], os.listdir(self.folder))


if __name__ == "__main__":
    unittest.main()
