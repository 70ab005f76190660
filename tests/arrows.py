#!/usr/bin/python3
"""Project rules that a compiler does not check: the includes that each library may have, that the folders of a library
do not include each other in a circle, the maximum length of a file and of its lines, the maximum size of a folder, that
each type has a name of its own, that no coroutine has an argument that g++ 12 destroys twice, that what commands print
is escaped, and that no file names a path outside the project.
Prints every breach as file:line."""

import os
import re
import subprocess
import sys

import comments

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MAX_LINES = 400
MAX_COLUMNS = 100
MAX_ROOMS = 32  # a room is a subfolder, or a header with its source

# For each library: the libraries it may include, the start of every <path/> with a folder in it (None if
# any), and standard headers it may not have. core <- protocol <- cell <- service <- server <- cli,
# protocol <- tools <- server, service and tools <- wasm.
NO_IO = {"thread", "mutex", "shared_mutex", "condition_variable", "future", "iostream", "fstream",
         "chrono", "ctime", "filesystem"}
RULES = {
    "core": (("core/",), ("Eigen/",), NO_IO),
    "protocol": (("core/", "protocol/"), ("Eigen/", "nlohmann/"), NO_IO),
    "cell": (("core/", "protocol/", "cell/"), ("Eigen/", "nlohmann/"), NO_IO),
    "service": (("core/", "protocol/", "cell/", "service/"), ("Eigen/", "nlohmann/"), NO_IO),
    "wasm": (("core/", "protocol/", "cell/", "service/", "tools/", "wasm/"), ("Eigen/", "nlohmann/"), NO_IO),
    "tools": (("core/", "protocol/", "tools/"), ("Eigen/", "nlohmann/"), NO_IO),
    "server": (("core/", "protocol/", "cell/", "service/", "tools/", "server/"), None, set()),
    "cli": (("core/", "protocol/", "cell/", "service/", "tools/", "server/", "cli/"), None, set()),
}
# Folders that know nothing of each other; app.cpp connects them.
SEPARATE = tuple((mine, other) for mine in ("server/robot_port/", "server/lines/")
                 for other in ("server/monitor_port/", "server/session/", "server/service/", "server/http/",
                               "server/resources/"))
HOUSED = tuple(RULES) + ("tests", "clients/web/src")
# One case per file: lists, not rooms.
LISTS = ("tests/transcripts/", "tests/integration/", "tests/data/broken/", "tests/data/recordings/", "tests/fuzz/corpus/")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
PRIVATE_PATH = re.compile(
    r"(?:^|[^\w.])/(?:work|farm)/|\.\./shared"
    r"|\bregistry\.[a-z]+\.(?:org|com)|\b(?:deb|security)\.[a-z]+\.org")

# scripts/playground compiles these libraries with Debian 12's libc++, which has no such algorithms.
PORTABLE = ("core", "protocol", "cell", "service", "wasm")
NOT_IN_LIBCXX = re.compile(r"\b(?:std::ranges::\w+\(|(?:std|ranges)::views::)")

# Names may contain control characters. `xr3 term` moves the cursor, and passes on the bytes of a robot.
PRINTS = re.compile(r"\bstd::c(?:out|err|log) <<")
PRINTERS = {"server/print.cpp", "cli/term/console.cpp", "cli/term/pipe.cpp"}

# A type that is defined anywhere, nested or in a source; and an alias in a namespace.
TYPE = re.compile(r"^\s*(?:template\s*<[^>]*>\s*)?(?:struct|class|enum(?: class)?) ([A-Z]\w*)(?: final)?\s*(?::(?!:)[^;{]*)?\{"
                  r"|^(?:template\s*<[^>]*>\s*)?using ([A-Z]\w*) =", re.MULTILINE)

CONSTANT = re.compile(r"^(?:inline )?(?:constexpr|const)\b[^()=;{]*?\b(k[A-Z]\w*)(?= =|\{|\[)", re.MULTILINE)

NAMED_FILE = re.compile(r"//.*?\b([\w/]+\.[ch]pp)\b")


def project_files():
    """All files that git tracks or does not ignore, relative to the root; without git, all files."""
    git = ["git", "-c", "safe.directory=*", "-C", ROOT, "ls-files", "-z", "--cached", "--others",
           "--exclude-standard"]
    try:
        listed = subprocess.run(git, capture_output=True, check=True).stdout.decode().split("\0")
    except (OSError, subprocess.CalledProcessError):
        listed = [os.path.relpath(os.path.join(folder, name), ROOT)
                  for folder, _, names in os.walk(ROOT) for name in names]
        listed = [path for path in listed if not re.search(r"(^|/)(build|\.git|node_modules|dist)/", path)]
    return sorted(path for path in listed if path and os.path.isfile(os.path.join(ROOT, path)))


def forbidden(folder, quoted, angled):
    """The reason why the folder may not have this include, or None."""
    own, libraries, banned = RULES[folder]
    if quoted is not None:
        return None if quoted.startswith(own) else f'{folder} may not include "{quoted}"'
    if angled in banned:
        return f"{folder} may not use I/O, clocks or threads: <{angled}>"
    if libraries is not None and "/" in angled and not angled.startswith(libraries):
        return f"{folder} may not include <{angled}>"
    return None


def joins_separate(path, quoted):
    """The reason why a file in one of two separate folders may not include this, or None."""
    for pair in SEPARATE:
        for mine, other in (pair, pair[::-1]):
            if path.startswith(mine) and (quoted or "").startswith(other):
                return f'{mine[:-1]} may not include "{quoted}"'
    return None


def breaches(path, text):
    folder = path.split("/")[0]
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        if PRIVATE_PATH.search(line):
            yield f"{path}:{number}: contains a path or host outside the project: {line.strip()[:80]}"
        include = INCLUDE.match(line) if folder in RULES and path.endswith((".cpp", ".hpp")) else None
        reason = include and (forbidden(folder, *include.groups()) or joins_separate(path, include[1]))
        if reason:
            yield f"{path}:{number}: {reason}"
        if path.endswith((".cpp", ".hpp")) and len(line) > MAX_COLUMNS:
            yield f"{path}:{number}: longer than {MAX_COLUMNS} columns"
        if folder in RULES and PRINTS.search(line) and path not in PRINTERS:
            yield f"{path}:{number}: prints unescaped; use server/print.hpp"
        if folder in PORTABLE and NOT_IN_LIBCXX.search(line):
            yield f"{path}:{number}: {folder} may not use algorithms of std::ranges; Emscripten's libc++ lacks them"
    if folder in RULES and len(lines) > MAX_LINES:
        yield f"{path}:{len(lines)}: longer than {MAX_LINES} lines"


def crowded_folders(files):
    """Folders of the libraries, the tests and the page with more rooms than a reader takes in at a glance."""
    rooms = {}
    for path in files:
        parts = path.split("/")
        for depth in range(1, len(parts)):
            folder, room = "/".join(parts[:depth]), parts[depth].split(".")[0]
            if (folder + "/").startswith(tuple(name + "/" for name in HOUSED)):
                rooms.setdefault(folder, set()).add(room)
    for folder, names in sorted(rooms.items()):
        if len(names) > MAX_ROOMS and not (folder + "/").startswith(LISTS):
            yield f"{folder}: {len(names)} rooms, at most {MAX_ROOMS}"


def hidden_constants(texts):
    """Constants of a library's headers that one of its sources names again in an anonymous namespace. Sources are compiled
    together, so that the one of a file would silently stand for that of the header in the next file."""
    for library in RULES:
        own = {path: text for path, text in texts.items() if path.startswith(library + "/")}
        shared = {name: path for path, text in own.items() if path.endswith(".hpp") for name in CONSTANT.findall(text)}
        for path, text in own.items():
            for name in CONSTANT.findall(text) if path.endswith(".cpp") else ():
                if name in shared:
                    yield f"{path}: {name} has the name of a constant in {shared[name]}"


def is_source(path):
    return path.endswith((".cpp", ".hpp")) and path.split("/")[0] in RULES


def shared_type_names(texts):
    """Names that several types of the libraries have, nested types and those of sources included."""
    places = {}
    for path, text in texts.items():
        for match in TYPE.finditer(text) if is_source(path) else ():
            line = text.count("\n", 0, match.end()) + 1
            places.setdefault(match[1] or match[2], []).append(f"{path}:{line}")
    for name, where in sorted(places.items()):
        if len(where) > 1:
            yield f"{len(where)} types have the name {name}: {', '.join(where)}"


def folder_arrows(texts):
    """The arrows between the folders of each library: folder -> {folder: its first include}. A folder and the files right
    above or below it in the tree are one place."""
    arrows = {}
    for path, text in texts.items():
        mine = os.path.dirname(path)
        for number, line in enumerate(text.splitlines() if is_source(path) else (), 1):
            include = INCLUDE.match(line)
            if not include or not include[1] or include[1].split("/")[0] != path.split("/")[0]:
                continue
            other = os.path.dirname(include[1])
            if mine not in (other, os.path.dirname(other)) and other != os.path.dirname(mine):
                arrows.setdefault(mine, {}).setdefault(other, f'{path}:{number}: includes "{include[1]}"')
    return arrows


def folder_circles(arrows):
    """The largest sets of folders each of which leads to all others of its set, as sorted tuples."""
    reached = {}
    for start in arrows:
        ahead, reached[start] = list(arrows[start]), set()
        while ahead:
            folder = ahead.pop()
            if folder not in reached[start]:
                reached[start].add(folder)
                ahead.extend(arrows.get(folder, ()))
    return sorted({tuple(sorted(other for other in reached[start] if start in reached.get(other, ())))
                   for start in reached if start in reached[start]})


def circular_folders(texts):
    """Circles of folders, each with its arrows."""
    arrows = folder_arrows(texts)
    for circle in folder_circles(arrows):
        yield f"these folders include each other in a circle: {', '.join(circle)}"
        for folder in circle:
            yield from (f"  {first}" for other, first in arrows[folder].items() if other in circle)


def named_files_that_are_missing(texts):
    """Files that a comment names but that do not exist, such as those that were renamed."""
    existing = {"/" + path for path in texts}
    for path, text in texts.items():
        for number, line in enumerate(text.splitlines() if path.startswith(tuple(RULES)) else (), 1):
            for name in NAMED_FILE.findall(line):
                if not any(each.endswith("/" + name) for each in existing) and not name.startswith("nlohmann/"):
                    yield f"{path}:{number}: there is no {name}"


# An argument of co_await that is a lambda which copies what it captures.
UNNAMED_LAMBDA = re.compile(r"co_await\s+[\w.:>()*-]*\(\s*\[(?!\s*(?:&|this)\s*[,\]])(?!\s*\])")


def twice_destroyed(texts):
    """Lambdas that g++ 12 destroys twice; CONTRIBUTING.md tells the rule."""
    for path, text in texts.items():
        for found in UNNAMED_LAMBDA.finditer(text) if path.startswith(tuple(RULES)) else ():
            yield f"{path}:{text.count(chr(10), 0, found.start()) + 1}: give the argument of co_await a name: g++ 12 destroys it twice"


def main():
    files = project_files()
    found = list(crowded_folders(files))
    texts = {}
    for path in files:
        with open(os.path.join(ROOT, path), encoding="utf-8", errors="replace") as file:
            texts[path] = file.read()
        found.extend(breaches(path, texts[path]))
    found.extend(hidden_constants(texts))
    found.extend(shared_type_names(texts))
    found.extend(circular_folders(texts))
    found.extend(named_files_that_are_missing(texts))
    found.extend(twice_destroyed(texts))
    found.extend(comments.breaches(texts))
    for breach in found:
        print(breach)
    print(f"{len(files)} files read, {len(found)} violations")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
