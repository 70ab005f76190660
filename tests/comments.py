"""Rules for the English of comments, in C++, CMake, shell and Python; called by arrows.py. A comment begins with a noun
or an imperative and makes sense without its neighbours. A function whose comment has a `Precondition:` asserts it."""

import re

LIBRARIES = ("core", "protocol", "cell", "tools", "server", "cli")

# Files whose comments have yet to be mended. The list only shrinks: an entry without a finding is one, too.
EXEMPT = ("cell/", "clients/web/")

# The file of each folder that begins with the flow through it, in ten to fifteen lines.
MAIN_FILES = {
    "cell": "cell/cell.hpp",
    "cli/commands": "cli/commands/commands.hpp",
    "cli/exec": "cli/exec/run.hpp",
    "cli/manual": "cli/manual/program.hpp",
    "cli/options": "cli/options/options.hpp",
    "cli/term": "cli/term/session.hpp",
    "core": "core/simulation.hpp",
    "core/camera": "core/camera/cache.hpp",
    "core/drawing": "core/drawing/wireframe.hpp",
    "core/faults": "core/faults/faults.hpp",
    "core/inverse": "core/inverse/inverse.hpp",
    "protocol/explain": "protocol/explain/explain.hpp",
    "protocol/check": "protocol/check/check_report.hpp",
    "protocol/files/paper_form": "protocol/files/paper_form/paper_form.hpp",
    "protocol/goals": "protocol/goals/judge.hpp",
    "protocol/line": "protocol/line/rhino_endpoint.hpp",
    "protocol/monitor": "protocol/monitor/client.hpp",
    "protocol/monitor/calls": "protocol/monitor/calls/form.hpp",
    "protocol/scene": "protocol/scene/links.hpp",
    "protocol/text": "protocol/text/printable.hpp",
    "server": "server/app.hpp",
    "server/cells": "server/cells/hosted_cell.hpp",
    "server/device": "server/device/port.hpp",
    "server/files": "server/files/data_files.hpp",
    "server/http": "server/http/wire.hpp",
    "server/lines": "server/lines/turns.hpp",
    "server/monitor_port": "server/monitor_port/port.hpp",
    "server/net": "server/net/listener.hpp",
    "server/options": "server/options/options.hpp",
    "server/pty": "server/pty/pump.hpp",
    "server/recording": "server/recording/recording.hpp",
    "server/resources": "server/resources/session.hpp",
    "server/service": "server/service/service.hpp",
    "server/session": "server/session/session.hpp",
    "service": "service/calls.hpp",
    "tools/drawing": "tools/drawing/picture.hpp",
    "tools/export": "tools/export/exported.hpp",
    "tools/kin": "tools/kin/report.hpp",
    "tools/report": "tools/report/run_report.hpp",
    "tools/term": "tools/term/line_decoder.hpp",
    "tools/text": "tools/text/screen.hpp",
    "tools/watch": "tools/watch/model.hpp",
    "tools/workcell_editor": "tools/workcell_editor/dialogue.hpp",
}

OPENINGS = (
    (re.compile(r"(?:What|How|Why|Who|Where|Whose)\b", re.IGNORECASE), "begins with a question; name the thing"),
    (re.compile(r"The same\b", re.IGNORECASE), "needs its neighbour; say which thing"),
    (re.compile(r"From (?:now|here) on\b", re.IGNORECASE), "say until when, or after which call"),
    (re.compile(r"So (?:many|much|long|few)\b", re.IGNORECASE), "say the number or its name"),
    (re.compile(r"(?:Of|That of|Those of|As)\b(?! (?:a |an |the )?(?:text|JSON))"), "is a fragment; name the thing"),
    (re.compile(r"of\b"), "is a fragment; name the thing"),
    (re.compile(r"(?:It|Its|They|Their|Them)\b", re.IGNORECASE), "begins with a pronoun; name the thing"),
    (re.compile(r"(?:And|But|Also|Likewise)\b", re.IGNORECASE), "continues another comment"),
)
ANYWHERE = (
    (re.compile(r"\b(?:nobody|no one|whoever|somebody|anybody|strangers?|guests?)\b", re.IGNORECASE),
     "names people; name the client, program or user"),
    (re.compile(r"\b(?:null|nullptr|nullopt|none|empty): ", re.IGNORECASE), "write `nullptr if`, `nullopt if`, `empty if`"),
    (re.compile(r"\bfrom now on\b", re.IGNORECASE), "say until when, or after which call"),
    (re.compile(r"\b(?:hears?|obeys?|obeyed|brings? about|forgets?|forgotten)\b", re.IGNORECASE),
     "use the field's verb: receives, executes, causes, discards"),
    (re.compile(r"\bPreconditions\b|\bPrecondition\b(?!:)|\bpreconditions?:"), "write `Precondition: ...`"),
)

# Functions with a precondition and without an assert, as path:function, with the reason. The list only shrinks.
UNASSERTED = {
    "core/placement.hpp:height_above_support_um": "placement_of() asserts it",
    "core/placement.hpp:warn_of_overlap": "placement_of() asserts it",
    "core/placement.hpp:warn_of_placement": "placement_of() asserts it",
    "protocol/text/printable.hpp:printable_json": "to parse the JSON again would cost more than the function",
    "server/net/socket.hpp:MonitorSocket": "Asio does not know the flag of a descriptor that it has adopted",
    "server/recording/recording.hpp:Recording": "a cell does not count its inputs",
    "tools/report/run_report.hpp:parse_report": "only to_json() could tell; a text that is not JSON throws",
}

CPP = (".cpp", ".hpp", ".js")
HASH = (".py", ".sh", ".cmake", "CMakeLists.txt")
HASH_FOLDERS = ("scripts/", "docker/", "deploy/", ".ci/", "clients/", "tests/", "cmake/")
CPP_COMMENT = re.compile(r"^(?P<code>(?:[^\"'/]|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'|\d'\d|/(?!/))*)//[/]?<? ?(?P<text>.*)$")
HASH_COMMENT = re.compile(r"^(?P<code>(?:[^\"'#$\\]|\"(?:\\.|[^\"\\])*\"|'[^']*'|\$.|\\.)*?(?:^|(?<=\s)))#(?!!) ?(?P<text>.*)$")
DOCSTRING = re.compile(r'^\s*(?:[rb]?""")(?P<text>[^"\n]+(?:\n[^"]*)*?)"""', re.MULTILINE)
DIRECTIVE = re.compile(r"NOLINT|namespace\b|clang-format|-{3}|shellcheck |labels: |noqa|expects: |fmt: ")


def blocks(path, text):
    """The comments of a text as (line number, text, line number after it): consecutive lines are one comment."""
    pattern = CPP_COMMENT if path.endswith(CPP) else HASH_COMMENT
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        match = pattern.match(line) if ("//" in line if path.endswith(CPP) else "#" in line) else None
        if match is None or DIRECTIVE.match(match["text"]):
            continue
        is_whole = not match["code"].strip()
        follows = found and found[-1][2] == number and (found[-1][3] or line.lstrip().startswith("///<"))
        if is_whole and follows:
            first, before, _, was_whole = found[-1]
            found[-1] = (first, before + " " + match["text"].strip(), number + 1, was_whole)
        else:
            found.append((number, match["text"].strip(), number + 1, is_whole))
    if path.endswith(".py"):
        for match in DOCSTRING.finditer(text):
            number = text.count("\n", 0, match.start("text")) + 1
            found.append((number, " ".join(match["text"].split()), number + 1, True))
    return [(first, words, after) for first, words, after, _ in found if words]


def is_read(path, text):
    if path.endswith(CPP):
        return path.startswith(tuple(name + "/" for name in LIBRARIES) + ("clients/web/",))
    if path.endswith(HASH):
        return path.startswith(HASH_FOLDERS) or path.split("/")[0] in LIBRARIES or path == "CMakeLists.txt"
    return text.startswith("#!") and "sh\n" in text.split("\n", 1)[0] + "\n" or path.startswith("scripts/") and "#!" in text[:2]


def findings(path, text):
    for number, words, _ in blocks(path, text):
        plain = re.sub(r"`[^`]*`|\"[^\"]*\"", "``", words)
        for pattern, advice in OPENINGS:
            if pattern.match(plain):
                yield f"{path}:{number}: comment {advice}: {words[:60]}"
        for pattern, advice in ANYWHERE:
            match = pattern.search(plain)
            if match:
                yield f"{path}:{number}: comment, at \"{match[0].strip()}\": {advice}"


def main_file_findings(texts):
    """Main files that do not begin with a comment of ten to fifteen lines."""
    for folder, path in sorted(MAIN_FILES.items()):
        lines = texts.get(path, "").splitlines()
        size = next((index for index, line in enumerate(lines) if not line.startswith("//")), 0)
        if not 10 <= size <= 15:
            yield f"{path}:1: begins with {size} lines of comment; the main file of {folder} has 10 to 15"


# --- Preconditions.

DECLARED = re.compile(r"(?:\boperator\s*\S+|~?\b[A-Za-z_]\w*)\s*(?=\()")


def declared_function(lines, after):
    """The name of the function that is declared from line `after` (from 1) on; empty if it is something else."""
    code = ""
    for line in lines[after - 1:after + 12]:
        if line.strip().startswith("//"):
            break
        code += line + "\n"
        if re.search(r"[;{]\s*(?://.*)?$", line):
            break
    code = re.sub(r"\[\[.*?\]\]|\bexplicit\b|template <[^>]*>|\bdecltype\b|\bnoexcept\b", " ", code)
    match = DECLARED.search(code)
    return match[0].strip() if match else ""


def after_brackets(text, at):
    """The index behind the bracket that closes the one at `at`."""
    depth = 0
    for index in range(at, len(text)):
        depth += (text[index] in "({[") - (text[index] in ")}]")
        if depth == 0:
            return index + 1
    return len(text)


def body_at(text, at):
    """The body of a function whose parameters end at `at`; empty if this is no definition."""
    after = re.compile(r"(?:\s|const\b|noexcept\b|override\b|final\b|->\s*[\w:<>]+|&)*").match(text, at).end()
    if re.compile(r":(?!:)").match(text, after):  # the members of a constructor, each with brackets
        after += 1
        while True:
            member = re.compile(r"[\s\w:<>,]*").match(text, after).end()
            if text[member:member + 1] not in ("(", "{"):
                return ""
            after = re.compile(r"\s*").match(text, after_brackets(text, member)).end()
            if text[after:after + 1] != ",":
                break
            after += 1
    return text[after:after_brackets(text, after)] if text[after:after + 1] == "{" else ""


def bodies(text, name):
    """The bodies of the functions with this name."""
    for match in re.finditer(r"(?<![\w.>])(?:\w+::)*" + re.escape(name) + r"\s*(?=\()", text):
        yield body_at(text, after_brackets(text, match.end()))


def unasserted(texts):
    """Functions with a precondition and without an assert, as path:function, with the line of the comment."""
    sources = {path: text for path, text in texts.items()
               if path.endswith(CPP) and path.startswith(tuple(name + "/" for name in LIBRARIES))}
    for path, text in sources.items():
        if path.startswith(EXEMPT) or "Precondition" not in text:
            continue
        lines = text.splitlines()
        near = [text] + [sources[other] for other in sources if other.endswith(".cpp") and path.endswith(".hpp")
                         and other.startswith(path.rsplit("/", 1)[0] + "/")]
        for number, words, after in blocks(path, text):
            if not re.search(r"\bPreconditions?:", words):
                continue
            name = declared_function(lines, after)
            found = [body for each in near for body in bodies(each, name)] if name else []
            if not any(re.search(r"\bassert\(", body) for body in found):
                yield f"{path}:{name}", number


def precondition_findings(texts):
    missing = dict(unasserted(texts))
    for function, number in missing.items():
        if function not in UNASSERTED:
            path, name = function.rsplit(":", 1)
            yield f"{path}:{number}: {name or 'this'} has a precondition and no assert"
    for function in UNASSERTED:
        if function not in missing:
            yield f"tests/comments.py: UNASSERTED has {function}, which needs no entry"


def breaches(texts):
    """Every breach in the texts, which are by path, as path:line."""
    needed = set()
    for path, text in texts.items():
        if not is_read(path, text):
            continue
        exempt = next((entry for entry in EXEMPT if path.startswith(entry)), None)
        for finding in findings(path, text):
            if exempt is None:
                yield finding
            else:
                needed.add(exempt)
    for entry in EXEMPT:
        if entry not in needed:
            yield f"tests/comments.py: EXEMPT has {entry}, which needs no entry"
    yield from main_file_findings(texts)
    yield from precondition_findings(texts)
