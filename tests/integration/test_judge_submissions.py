"""Submissions of a class as files and folders: symbolic links are not followed out of a submission."""

import os
import unittest

from judge_modes import MOVE, PYTHON, SANDBOX, Root, User

FULL = MOVE + "print('mine')\n"
LINKS = {  # path of each link, and its target
    "class/bob": "ada", "class/carl": "/etc", "class/dora/main.py": "../ada/main.py", "class/eve/main.py": "/etc/passwd",
    "class/finn/lib": "..", "class/gus/main.py": "code.py", "class/hal/main.py": "main.py"}
LEAVES = "main.py is a symbolic link that leads out of the submission"


class Submissions:
    options = []

    def test_links_are_followed_within_a_submission_only(self):
        self.write("class/ada/main.py", FULL)
        for name, target in LINKS.items():
            if name.count("/") == 2:
                self.write(name, "").unlink()
            os.symlink(target, self.folder / name)
        self.write("class/gus/code.py", FULL)
        self.write("class/finn/main.py", FULL)
        _, rows = self.grade(*self.options, command=[PYTHON, "{}/main.py"])
        for name in "ada", "gus":
            self.assertRegex(rows[name], r"10/10 *$")
            self.assertEqual("mine\n", (self.folder / "report" / name / "output.txt").read_text(encoding="utf-8"))
        for name in "bob", "carl":
            self.assertIn(f"{name} is a symbolic link; a submission is a file or a folder of its own", rows[name])
        for name in "dora", "eve", "hal":
            self.assertIn(f"{name}/{LEAVES}", rows[name])
        self.assertIn("finn/lib is a symbolic link that leads out", rows["finn"])
        for name in "bob", "carl", "dora", "eve", "finn", "hal":
            self.assertEqual("", (self.folder / "report" / name / "output.txt").read_text(encoding="utf-8"))


@SANDBOX
class RootInTheSandbox(Submissions, Root, unittest.TestCase):
    pass


@SANDBOX
class UserInTheSandbox(Submissions, User, unittest.TestCase):
    pass


class UserWithoutSandbox(Submissions, User, unittest.TestCase):
    options = ["--no-sandbox"]


if __name__ == "__main__":
    unittest.main()
