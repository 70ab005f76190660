"""docs/commands.md lists the options of every command but serve (docs/options.md), as its manual page does, and
docs/exit-codes.md every exit code. With --write as an argument: rewrites docs/commands.md."""
# labels: full

import pathlib
import re
import sys
import unittest

from support import ROOT, run_xr3

PAGE = pathlib.Path(ROOT, "docs", "commands.md")
EXIT_CODES = pathlib.Path(ROOT, "docs", "exit-codes.md")
HEAD = """# Commands

Every command of the program with its arguments and options, as `--help` and the manual pages (`man xr3-kin`) have them. The
[exit codes](exit-codes.md) are the same for all.

This page is made from the manual pages; a test compares them.
"""
# The pages that explain a command.
MORE = {"check": "data-files.md", "draw": "own-workcell.md", "kin": "kinematics.md",
        "convert": "paper-form.md", "export": "interop/urdf.md", "workcell": "workcell-editor.md", "watch": "watch.md", "term": "term.md",
        "healthcheck": "monitor.md#health-check", "replay": "recording.md", "exec": "exec.md", "grade": "exec.md",
        "exercise": "exercises.md",
        "manual": "packages.md", "completion": "packages.md"}


def commands():
    """(name, what it does) of every command, in the order of the help."""
    text = run_xr3("--help").stdout.partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    return re.findall(r"^  (\w+) +(.*)$", text, re.MULTILINE)


def plain(text):
    """A text of a manual page without its marks."""
    return re.sub(r"\\f[BIR]|\\&", "", text).replace(r"\-", "-").replace(r"\e", "\\")


def code(text):
    return "`" + plain(text).replace("|", r"\|") + "`"


def rows(page):
    """(argument, meaning) of the options of a manual page."""
    options = page.partition(".SH OPTIONS\n")[2].partition("\n.SH ")[0]
    for entry in options.split(".TP\n")[1:]:
        argument, *lines = entry.strip().splitlines()
        meaning = [re.sub(r"\\fB(.*?)\\fR", lambda bold: code(bold[1]), line) for line in lines]
        yield code(argument), plain(" ".join(meaning)).replace("<", "\\<")


def section(name, purpose):
    page = run_xr3("manual", name).stdout
    if name == "serve":
        return "\n## xr3 serve\n\nStarts a robot and its controller; [options](options.md) describes its options.\n"
    synopsis = re.search(r"\.SH SYNOPSIS\n(.*)", page)[1]
    table = "".join(f"| {argument} | {meaning} |\n" for argument, meaning in rows(page))
    purpose = f"{purpose[0].upper()}{purpose[1:]}: [more]({MORE[name]})."
    return (f"\n## xr3 {name}\n\n{purpose}\n\n```\nUsage: {plain(synopsis)}\n```\n\n"
            f"| argument | meaning |\n|---|---|\n{table}")


def document():
    return HEAD + "".join(section(*each) for each in commands())


class Commands(unittest.TestCase):
    maxDiff = None

    def test_the_page_is_that_of_the_program(self):
        self.assertEqual(document(), PAGE.read_text(encoding="utf-8"), "rewrite it: test_commands.py --write")

    def test_every_command_is_there(self):
        names = [name for name, _ in commands()]
        self.assertEqual("serve", names[0])
        self.assertLessEqual({"kin", "watch", "exec", "completion"}, set(names))
        self.assertEqual(names, re.findall(r"^## xr3 (\w+)$", PAGE.read_text(encoding="utf-8"), re.MULTILINE))
        for name in names[1:]:
            options = re.findall(r"^  (?:-\w,)?(--[\w-]+)", run_xr3(name, "--help").stdout, re.MULTILINE)
            for option in options:
                self.assertRegex(section(name, "does"), rf"\| `[^|]*{option}[ `]", name)

    def test_every_exit_code_is_there(self):
        text = run_xr3("--help").stdout.partition("Exit codes: ")[2].partition("Try: ")[0]
        codes = re.findall(r"(?:^|; +|;\s+)(\d) ", text)
        self.assertGreater(len(codes), 8)
        self.assertEqual(codes, re.findall(r"^\| (\d) \|", EXIT_CODES.read_text(encoding="utf-8"), re.MULTILINE))


if __name__ == "__main__":
    if "--write" in sys.argv:
        PAGE.write_text(document(), encoding="utf-8")
    else:
        unittest.main()
