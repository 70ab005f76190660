"""A hook of mkdocs (mkdocs.yml): the robot without a server (build/playground, by scripts/playground) becomes the folder
`play` of the site, and a comment in a page becomes a link to it, which robot.js shows in the page. Members of the link are
those of docs/playground.md:

    <!-- robot: program=pick.py goals=find-and-pick -->    a name, a file beside the page, or code that begins with `# pick.py`,
                                                           in the page or another one of its folder
    <!-- robot: exercise -->                               those of exercise.json beside the page, with its first starter
    <!-- robot: -->                                        the usual robot
    <!-- address: Try it in the browser -->                a link that is shown if the site has an address

Without build/playground such comments remain comments."""

import base64
import html
import json
import logging
import pathlib
import re
import shutil
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
PLAYGROUND = ROOT / "build" / "playground"
FOLDER = "play"
FILES = ("robot", "workcell", "faults", "goals")  # members whose texts are names or contents of files
MEMBERS = (*FILES, "program", "clock", "compat", "recording")
COMMENT = re.compile(r"^<!-- robot:(.*?)-->$", re.MULTILINE)
ADDRESS = re.compile(r"^<!-- address: *(.*?) *-->$", re.MULTILINE)
NAME = re.compile(r"[\w-]+")

log = logging.getLogger("mkdocs.hooks.play")


def is_built():
    """Whether the site has robots."""
    return (PLAYGROUND / "index.html").is_file()


def fragment(members):
    """The fragment of an address that holds these members, as docs/playground.md describes it."""
    if not members:
        return ""
    deflate = zlib.compressobj(9, wbits=-15)
    packed = deflate.compress(json.dumps(members, ensure_ascii=False).encode()) + deflate.flush()
    return "#xr3=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


# --- Members.

def of_exercise(folder):
    """The members for the exercise in this folder. Time follows the clock on the wall, so that the arm is seen to move."""
    exercise = json.loads((folder / "exercise.json").read_text(encoding="utf-8"))
    program = next(iter(sorted(folder.glob("starter/*.py"))))
    return {"program": program.relative_to(folder).as_posix(), **{name: exercise[name] for name in FILES if name in exercise}}


def code(name, folder, markdown):
    """The block of code that begins with `# NAME`, in this page or in another one of its folder; None if there is none."""
    block = re.compile(rf"^```\w*\n(# {re.escape(name)}\n.*?)^```$", re.MULTILINE | re.DOTALL)
    pages = (path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.md")))
    return next((found[1] for found in map(block.search, (markdown, *pages)) if found), None)


def contents(name, value, folder, markdown):
    """The text of a member: the page's code, the file, or the name itself."""
    if (folder / value).is_file():
        return (folder / value).read_text(encoding="utf-8")
    if name == "program" and code(value, folder, markdown):
        return code(value, folder, markdown)
    is_there = (PLAYGROUND / value).is_file() if name == "recording" else NAME.fullmatch(value) and name != "program"
    if not is_there:
        raise ValueError(f"{name}={value} is neither a name, nor a file beside the page, nor code of the page")
    return value


def members_of(words, folder, markdown):
    """The members that a comment with these words asks for."""
    values = of_exercise(folder) if words == ["exercise"] else dict(word.split("=", 1) for word in words)
    unknown = set(values) - set(MEMBERS)
    if unknown:
        raise ValueError(f"there is no {unknown.pop()}, but {', '.join(MEMBERS)}")
    return {name: contents(name, value, folder, markdown) for name, value in values.items()}


# --- Pages.

def title_of(members):
    """What the link offers."""
    if "recording" in members:
        return "Open the recording here"
    return "Run it here, in a robot without a server" if "program" in members else "Try it here, with a robot without a server"


def link(address, title, kind=""):
    """A link in a place of its own (style.css), which robot.js watches if its class is md-button."""
    return f'<div class="robot"><a class="{kind}" href="{html.escape(address)}">{title}</a></div>'


def shown(members, page):
    """The link to the robot with these members."""
    up = "../" * page.file.url.count("/")
    return link(f"{up}{FOLDER}/{fragment(members)}", title_of(members), "md-button")


def on_page_markdown(markdown, page, config, files):  # pylint: disable=unused-argument
    """Replaces the comments."""
    def robot(found):
        try:
            members = members_of(found[1].split(), pathlib.Path(page.file.abs_src_path).parent, markdown)
        except (ValueError, OSError) as error:
            log.warning("%s: %s: %s", page.file.src_path, found[0], error)
            return found[0]
        return shown(members, page)

    if not is_built():
        return markdown
    if config["site_url"]:
        markdown = ADDRESS.sub(lambda found: link(f"{config['site_url']}{FOLDER}/", html.escape(found[1])), markdown)
    return COMMENT.sub(robot, markdown)


def on_post_build(config):
    """Copies the folder into the site."""
    if is_built():
        shutil.copytree(PLAYGROUND, pathlib.Path(config["site_dir"]) / FOLDER)
    else:
        log.info("The pages have no robots in them: build/playground is missing (scripts/playground).")
