"""The pages of the documentation, the commands in their text, and the files that their commands name."""

import pathlib
import re
import shutil
import typing

from support import ROOT, run_xr3

FENCE = re.compile(r"^ *```.*?^ *```$", re.DOTALL | re.MULTILINE)
CODE = re.compile(r"(?<!`)`([^`]+)`(?!`)")
PROGRAMS = set("""
apt apt-get awk bash buildah cargo cat cc chmod cmake cp ctest curl docker docker-compose dpkg echo env g++ gcc
gdb git head ip java javac journalctl kill kubectl make mkdir mv nano nc ncat netcat nice node nohup npm npx octave
octave-cli openssl perl pip pip3 pipx pkill podman printf python python3 rm rustc sed seeds sh socat ss ssh
sudo systemctl systemd-analyze systemd-run tail tar taskset tee telnet timeout touch ulimit unzip wget xr3 yes
""".split())


class Command(typing.NamedTuple):
    """A command in the text of a page, where it stands, and the folder in which it is meant to run."""

    place: str
    folder: pathlib.Path
    text: str


def pages():
    root = pathlib.Path(ROOT)
    tops = [root / name for name in ("README.md", "SECURITY.md", "CONTRIBUTING.md")]
    tops += [root / "docker" / "README.md", root / "deploy" / "kubernetes" / "README.md"]
    return [*tops, *sorted((root / "docs").rglob("*.md")),
            *sorted(path for path in (root / "clients").rglob("*.md") if "node_modules" not in path.parts)]


def has_a_reader(path):
    """Whether a reader (reader.py) does what the page shows and compares the output, so that no other test has to."""
    names = "troubleshooting.md", "own-robot.md", "own-workcell.md", "classroom.md", "exercises.md"
    return path.parent.name == "tutorial" or path.name in ("pytest.md", "urdf.md") or path.parent.name == "docs" and path.name in names


def is_command(text):
    """A span of code that begins with a program and has arguments, or that names a script or `xr3 SUBCOMMAND`."""
    words = re.sub(r"^(\$ )?(\w+=\S* )*(sudo )?", "", text).split()
    if not words or words[0] in ("./", "scripts/"):
        return False
    if words[0].startswith(("./", "scripts/")):
        return True
    if len(words) == 1:
        return words[0] == "tests/fuzz/minimise"
    return words[0] in PROGRAMS or bool(re.match(r"(xr3|build|tests|docs|docker|clients)/[\w./-]+$", words[0]))


def folder_of(path, line, code):
    """Commands of a client's page are for its folder; a row of clients/README.md links to the folder."""
    root = pathlib.Path(ROOT)
    if code.startswith(("./run", "./test", "scripts/", "xr3 ")):
        return root
    if path == root / "clients" / "README.md":
        link = re.search(r"\]\((\w+)/README\.md\)", line)
        return path.parent / link[1] if link else root
    return path.parent if root / "clients" in path.parents else root


def spans():
    """(page, line number, line, code) of every span of code in a text outside of fences, without line ends."""
    for path in pages():
        text = path.read_text(encoding="utf-8")
        text = FENCE.sub(lambda fence: "\n" * fence[0].count("\n"), text)
        lines = text.splitlines()
        for span in CODE.finditer(text):
            number = text.count("\n", 0, span.start())
            yield path, number + 1, lines[number], " ".join(span[1].replace("\\|", "|").split())


def fenced_lines():
    """(page, line number, line) of every line in a fence."""
    for path in pages():
        text = path.read_text(encoding="utf-8")
        for fence in FENCE.finditer(text):
            first = text.count("\n", 0, fence.start()) + 2
            yield from ((path, first + i, line) for i, line in enumerate(fence[0].splitlines()[1:-1]))


def place(path, number):
    return f"{path.relative_to(ROOT)}:{number}"


def inline_commands():
    """Every Command in a text outside of fences; the first of those that are equal."""
    found = {}
    for path, number, line, code in spans():
        if is_command(code):
            folder = folder_of(path, line, code)
            found.setdefault((folder, code), Command(place(path, number), folder, code))
    return list(found.values())


def shown_file(name, language):
    """The contents of the first fence of that language on a page of docs."""
    text = pathlib.Path(ROOT, "docs", name).read_text(encoding="utf-8")
    return re.search(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)[1]


def write_files(folder):
    """Makes the files in `folder` that commands of the documentation name."""
    data = pathlib.Path(ROOT, "data")
    for name in "clients", "data", "docs":
        (folder / name).symlink_to(pathlib.Path(ROOT, name))
    shutil.copy(data / "robots" / "rhino-xr3.json", folder / "my-arm.json")
    shutil.copy(data / "workcells" / "rhino-xr3.json", folder / "lab.json")
    run_xr3("convert", "my-arm.json", "my-arm.txt", cwd=folder)
    (folder / "lab.dat").touch()
    (folder / "metrics-token").write_text("of-the-metrics-alone\n", encoding="ascii")
    (folder / "token").write_text("of-the-teacher-alone\n", encoding="ascii")
    (folder / "token").chmod(0o600)
    (folder / "class.csv").write_text("name,robot,workcell\nada,,\nbob,adept-one,\n", encoding="ascii")
    (folder / "lab.toml").write_text(shown_file("options.md", "toml"), encoding="utf-8")
    (folder / "faults.json").write_text(shown_file("faults.md", "json"), encoding="utf-8")
    for solution in pathlib.Path(ROOT, "docs", "course").glob("*/solution.py"):  # as the student's own file
        name = solution.parent.name.split("-")[-1]
        shutil.copy(solution, folder / f"{name}.py")
    (folder / "submissions").mkdir()
    shutil.copy(folder / "pick.py", folder / "submissions" / "ada.py")
    shutil.copy(pathlib.Path(ROOT, "clients", "python", "6_find_and_pick.py"), folder / "submissions" / "bob.py")
