"""The programs in clients/octave contain nothing that only Octave knows. MATLAB is not available here, so this reads
the sources: syntax, names of files, and the functions called outside of `if exist('OCTAVE_VERSION', 'builtin')`."""
# labels: full

import os
import re
import unittest
from pathlib import Path

ROOT = Path(os.environ["XR3_ROOT"])
FOLDER = ROOT / "clients" / "octave"
GUARD = "if exist('OCTAVE_VERSION', 'builtin')"

KEYWORDS = set("break case catch continue else elseif end for function global if otherwise persistent return switch "
               "try while".split())
OPENING = {"for", "function", "if", "switch", "try", "while"}

# Functions that MATLAB and Octave have with the same meaning. Before you add one, look it up in MATLAB's documentation.
FUNCTIONS = set("abs acos any atan2 bitand bitget ceil clear double error exist false fileparts find fix fprintf "
                "getenv hypot isempty isnan max mean mod numel pause pi read reshape round sign size sprintf "
                "str2double strncmp tcpclient true uint8 varargin write zeros".split())

SYNTAX = [
    (r"#", "a comment begins with % in MATLAB"),
    (r'"', "MATLAB's strings in double quotes are another type; use single quotes"),
    (r"!", "not is ~ in MATLAB, and != is ~="),
    (r"\+\+|--|[-+*/^|&]=", "MATLAB has no ++, -- or +="),
    (r"\*\*", "a power is ^ in MATLAB"),
    (r"\)\s?\(", "MATLAB cannot index the result of an expression"),
    (r"\\\s*$", "a line is continued with ... in MATLAB"),
    (r"^\s*(if|while|elseif)\b[^,;=~<>]*=[^=]", "MATLAB has no assignment in a condition"),
    (r"^\s*[A-Za-z]\w*\s+[A-Za-z][-\w]*\s*$", "command syntax: use parentheses"),
]
COMMANDS = re.compile(r"^\s*(clear \w+|function \w+|end|break|return|else)\s*$")


def code_of(line):
    """The line without its comment and with empty strings. A quote after a value transposes it."""
    code, at = "", 0
    while at < len(line):
        char = line[at]
        if char == "%":
            break
        if char == "'" and not re.search(r"[\w)\]}'.]$", code):
            end = re.compile(r"'(?:[^']|'')*'").match(line, at)
            code, at = code + "''", end.end() if end else len(line)
            continue
        code, at = code + char, at + 1
    return code.rstrip()


def words_of(code):
    """The identifiers of the code that are not members of a structure, with the depth of brackets around them."""
    depth = 0
    for match in re.finditer(r"(?<![\w.])[A-Za-z]\w*|[(\[{]|[)\]}]", code):
        text = match.group()
        if text in "([{":
            depth += 1
        elif text in ")]}":
            depth -= 1
        else:
            yield text, depth


def variables_of(code):
    """The names that are assigned, are loop variables or parameters anywhere in the code."""
    names = set()
    for line in code.splitlines():
        for match in re.finditer(r"(?:^|[,;])\s*(?:for\s+)?([A-Za-z]\w*)(?:\.\w+|\([^=]*\))*\s*=(?!=)", line):
            names.add(match.group(1))
        header = re.match(r"\s*function\s+(.*)", line)
        several = re.match(r"\s*\[([^]]*)\]\s*=(?!=)", line)
        for group in (header and header.group(1), several and several.group(1)):
            names.update(re.findall(r"\w+", group or ""))
    return names


def faults_of(name, source, own):
    """Code that MATLAB would not run, as `file:line: why`. `own` are the functions of the folder."""
    faults = []
    lines = source.splitlines()
    codes = [code_of(line) for line in lines]
    stem = name.rsplit(".", 1)[0]
    known = KEYWORDS | FUNCTIONS | own | variables_of("\n".join(codes))

    def fault(number, why):
        faults.append(f"{name}:{number}: {why}")

    if not re.fullmatch(r"[A-Za-z]\w{0,62}", stem):
        fault(1, "a name of a program begins with a letter and has only letters, digits and _ in MATLAB")
    first = next((code for code in codes if code), "")
    header = re.match(r"function\s+(?:[^=]*=\s*)?(\w+)", first)
    if header and header.group(1) != stem:
        fault(1, f"the first function of this file must be {stem}")
    blocks = []  # whether each open block, from the outside, is a guard
    for number, (line, code) in enumerate(zip(lines, codes), start=1):
        guarded = any(blocks)
        if not header and re.match(r"\s*function\b", code):
            fault(number, "a function in a program: put it in a file of its own")
        for pattern, why in SYNTAX:
            if re.search(pattern, code) and not COMMANDS.match(code):
                fault(number, why)
        for word, depth in words_of(code):
            if depth == 0 and word in OPENING:
                blocks.append(line.strip() == GUARD)
            elif depth == 0 and word == "end":
                blocks = blocks[:-1]
            elif word == "arguments":
                fault(number, "arguments is a keyword of MATLAB")
            elif word not in known and not guarded:
                fault(number, f"{word} is not known to be a function of MATLAB; see {Path(__file__).name}")
    return faults


class Sources(unittest.TestCase):
    def test_contain_nothing_that_only_octave_knows(self):
        files = sorted(FOLDER.glob("*.m"))
        self.assertGreater(len(files), 12)
        own = {file.stem for file in files} | {"take_patch"}
        faults = [fault for file in files for fault in faults_of(file.name, file.read_text(encoding="utf-8"), own)]
        self.assertEqual([], faults, "\n" + "\n".join(faults))

    def test_git_ignores_the_dump_that_octave_writes_when_it_is_killed(self):
        self.assertIn("octave-workspace", (ROOT / ".gitignore").read_text(encoding="utf-8").splitlines())


class TheScan(unittest.TestCase):
    """The check finds each kind of error that it is for."""

    def faults(self, source, name="ex9_new.m"):
        return faults_of(name, source, {"robot_send"})

    def test_finds_what_only_octave_knows(self):
        for line, why in (("x = 1; # note", "comment"), ('fprintf("hi");', "double quotes"), ("if a != b", "~="),
                          ("x = !true;", "not is ~"), ("x = 1; x += 2;", "no ++"), ("x = 1; x++;", "no ++"),
                          ("x = 2 ** 3;", "power"), ("x = size(1)(1);", "index"),
                          ("pkg load instrument-control", "pkg"),
                          ("words = argv();", "argv"), ("printf('x');", "printf"), ("endif", "endif"),
                          ("unwind_protect", "unwind_protect"), ("do", "do is"), ("until true", "until"),
                          ("arguments = {};", "keyword"), ("x = [1, \\", "continued"),
                          ("if (y = 3), end", "assignment"), ("while y = 3, end", "assignment"),
                          ("function f()", "of its own"), ("hold on", "command syntax"), ("puts('%');", "puts")):
            with self.subTest(line):
                faults = self.faults("y = 1;\n" + line)
                self.assertTrue(any(why in fault for fault in faults), faults)
                self.assertTrue(all(fault.startswith("ex9_new.m:2: ") for fault in faults), faults)

    def test_finds_names_that_matlab_cannot_run(self):
        self.assertIn("1_hello.m:1: a name", self.faults("x = 1;", "1_hello.m")[0])
        self.assertIn("must be robot_go", self.faults("function go()\nend", "robot_go.m")[0])

    def test_accepts_what_both_know(self):
        self.assertEqual([], self.faults("x = [1 2]';  % # \" != it's\nfprintf('say \"hi\" # %d''s!\\n', x(end));\n"
                                         "robot.at(6) = 3;\nif x(1) == 1, robot_send(robot, 'E?'); end\nclear robot"))
        self.assertEqual([], self.faults("function [a, b] = robot_go(c)\n  a = c(1:end);\n  b = a;\nend", "robot_go.m"))

    def test_accepts_octave_only_where_it_is_guarded(self):
        inside = f"{GUARD}\n  if true, x = 1; end\n  words = argv();\nend\n"
        self.assertEqual([], self.faults(inside))
        self.assertEqual(1, len(self.faults(inside + "words = argv();\n")))


if __name__ == "__main__":
    unittest.main()
