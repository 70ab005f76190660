#!/usr/bin/python3
"""The house rules that a compiler does not check: which folder may include what, how long a file may
be, and that no file names a path of one developer's machine. Prints every breach as file:line."""

import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MAX_LINES = 400

# For each folder: the start of every path in quotes that it may include, the start of every <path/>
# with a folder in it, and standard headers it may not have. core <- protocol <- server.
NO_IO = {"thread", "mutex", "shared_mutex", "condition_variable", "future", "iostream", "fstream",
         "chrono", "ctime", "filesystem"}
RULES = {
    "core": (("core/",), ("Eigen/",), NO_IO),
    "protocol": (("core/", "protocol/"), ("Eigen/", "nlohmann/"), NO_IO),
    "server": (("core/", "protocol/", "server/"), None, set()),
}
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
PRIVATE_PATH = re.compile(
    r"(?:^|[^\w.])/(?:work|farm)/|\.\./shared"
    r"|\bregistry\.[a-z]+\.(?:org|com)|\b(?:deb|security)\.[a-z]+\.org")


def project_files():
    """Every file that is tracked or would be, relative to the root; without git, every file."""
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
    """Why the folder may not have this include, or None."""
    own, libraries, banned = RULES[folder]
    if quoted is not None:
        return None if quoted.startswith(own) else f'{folder} may not include "{quoted}"'
    if angled in banned:
        return f"{folder} knows no I/O, clock or thread: <{angled}>"
    if libraries is not None and "/" in angled and not angled.startswith(libraries):
        return f"{folder} may not include <{angled}>"
    return None


def breaches(path, text):
    folder = path.split("/")[0]
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        if PRIVATE_PATH.search(line):
            yield f"{path}:{number}: names a path or host outside the project: {line.strip()[:80]}"
        include = INCLUDE.match(line) if folder in RULES and path.endswith((".cpp", ".hpp")) else None
        reason = forbidden(folder, *include.groups()) if include else None
        if reason:
            yield f"{path}:{number}: {reason}"
    if folder in RULES and len(lines) > MAX_LINES:
        yield f"{path}:{len(lines)}: longer than {MAX_LINES} lines"


def main():
    files = project_files()
    found = []
    for path in files:
        with open(os.path.join(ROOT, path), encoding="utf-8", errors="replace") as file:
            found.extend(breaches(path, file.read()))
    for breach in found:
        print(breach)
    print(f"{len(files)} files read, {len(found)} breaches")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
