"""A hook of mkdocs (mkdocs.yml): builds the site from Markdown that also reads well on a git host and in an editor.

* Pages outside of docs/ (`extra: outside` in mkdocs.yml) become pages of the site.
* Links work as in the repository: to pages, to their headings, and to other files. A file outside of docs/ is copied
  into the site as plain text when a page links to it. A link to nothing, or to a folder, is a warning.
* Lists may be indented as CommonMark allows, and `<details>` may contain Markdown.
"""

import logging
import os
import pathlib
import posixpath
import re
from xml.etree import ElementTree

from markdown.extensions import Extension
from markdown.inlinepatterns import InlineProcessor
from markdown.serializers import HTML_EMPTY
from markdown.treeprocessors import Treeprocessor
from markdown.util import AtomicString, code_escape
from mkdocs.structure.files import File

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCS = "docs"
ASSETS = {"assets/site.css": "site/style.css", "assets/robot.js": "site/robot.js", "assets/icon.svg": "clients/web/src/icon.svg"}
COPIES = "files"  # the folder of the site for copies of files outside of docs/
AS_IT_IS = {".png", ".gif", ".svg", ".html"}  # a browser shows these; a copy of any other file ends in .txt
FENCE = re.compile(r"(`{3,}|~{3,})")
ITEM = re.compile(r"([*+-]|\d+[.)]) +")
NUMBER = re.compile(r"^(\d+)\.(?= )")
CODE = r"(?<![\\`])(`+)(?!`)(.+?)(?<!`)\1(?!`)"
BREAKS = re.compile(r"(?<=[/|,])(?=.)")  # where longer code in a table may break
SHORT = 20  # characters of code in a table
TAB = 4  # columns by which Python-Markdown indents the contents of a list item

HTML_EMPTY.add("wbr")  # has no end tag

log = logging.getLogger("mkdocs.hooks.site")  # (below "mkdocs": the option --strict counts its warnings)


# --- Headings and lists as a git host shows them.

def slug(heading, _separator="-"):
    """The anchor of a heading, as git hosts make it."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def is_item(text, indent, after, levels):
    """Whether this text begins a list item. A number other than 1 does not if it continues the paragraph `after`."""
    item = ITEM.match(text)
    continues = bool(after) and not (levels and indent < levels[-1])
    return bool(item) and not (continues and item[1][0].isdigit() and item[1][:-1] != "1")


def reindent(markdown):
    """Indents the contents of list items by four columns for each level, and separates a list from the paragraph
    before it. CommonMark accepts fewer columns and no separation; Python-Markdown does not."""
    lines, levels, fence, after = [], [], None, ""
    for line in markdown.splitlines():
        text = line.lstrip(" ")
        indent = len(line) - len(text)
        mark = FENCE.match(text)
        item = fence is None and is_item(text, indent, after, levels)
        if text and fence is None and (item or mark or not after):
            while levels and indent < levels[-1]:
                levels.pop()
        if item and after and not levels and not ITEM.match(after):
            lines.append("")
        inside = text if item else line[min(indent, levels[-1] if levels else 0):]
        if fence is None and not item:
            inside = NUMBER.sub(r"\1\\.", inside)  # at the beginning of a line, but no list item
        lines.append(" " * TAB * len(levels) + inside if text else "")
        if mark and fence is None:
            fence = mark[1]
        elif fence is not None and text.startswith(fence) and not text.strip(fence[0]).strip():
            fence = None
        if item:
            levels.append(indent + len(ITEM.match(text)[0]))
        after = text
    return "\n".join(lines) + "\n"


class Code(InlineProcessor):
    """A span of code. As in CommonMark, and unlike Python-Markdown's, it keeps a blank at one end only."""

    def handleMatch(self, m, data):  # pylint: disable=invalid-name,arguments-differ
        text = m[2].replace("\n", " ")
        if text[:1] == text[-1:] == " " and text.strip():
            text = text[1:-1]
        element = ElementTree.Element("code")
        element.text = AtomicString(code_escape(text))
        return element, m.start(0), m.end(0)


def mend_tables(root):
    """In a table, `\\|` in code is a bar. Short code is kept on one line (style.css), longer code has places to break."""
    for cell in root.iter():
        for code in cell.iter("code") if cell.tag in ("td", "th") else ():
            code.text = AtomicString((code.text or "").replace("\\|", "|"))
            if len(code.text) <= SHORT:
                code.set("class", "short")
                continue
            code.text, *parts = map(AtomicString, BREAKS.split(code.text))
            for part in parts:
                ElementTree.SubElement(code, "wbr").tail = part


def on_page_markdown(markdown, page, config, files):  # pylint: disable=unused-argument
    """Remembers the page, for its links, and adapts its lists and details."""
    SITE.page, SITE.files, SITE.config = page, files, config
    if page.is_homepage:
        page.meta["hide"] = ["navigation"]  # the tabs and the page itself have it
    return re.sub(r"^( *)<details>", r'\1<details markdown="1">', reindent(markdown), flags=re.MULTILINE)


# --- Links.

class Site:
    """What links of a page depend on. `place` is a file's path in the repository, `src` its path in the site."""

    def __init__(self):
        self.page = self.files = self.config = None
        self.outside = {}  # src: place, of the pages outside of docs/

    def place_of(self, src):
        """The place of a page or file of the site."""
        return self.outside.get(src) or posixpath.join(DOCS, src)

    def src_of(self, place):
        """The path in the site of a file of the repository; None if the site does not have it."""
        for src, outside in self.outside.items():
            if outside == place:
                return src
        src = posixpath.relpath(place, DOCS)
        return src if not src.startswith("..") and self.files.get_file_from_path(src) else None

    def link(self, href):
        """The link from this page in the repository as a link from this page in the site."""
        path, mark, anchor = href.partition("#")
        if not path or re.match(r"[a-z][a-z0-9+.-]*:", path) or path.startswith("/"):
            return href
        here = self.page.file.src_path.replace(os.sep, "/")
        place = posixpath.normpath(posixpath.join(posixpath.dirname(self.place_of(here)), path))
        src = self.src_of(place) or self.copy(place, href)
        return posixpath.relpath(src, posixpath.dirname(here) or ".") + mark + anchor if src else href

    def copy(self, place, href):
        """Copies a file outside of docs/ into the site, once."""
        origin = ROOT / place
        if not origin.is_file() or place.startswith("..") or origin.suffix == ".md":
            log.warning("%s: the link %s leads to %s: link to a file of the repository, or to a page that `nav` or "
                        "`extra: outside` of mkdocs.yml has", self.page.file.src_path, href,
                        "a folder" if origin.is_dir() else "no file" if not origin.is_file() else
                        "a page that the site does not have")
            return None
        src = posixpath.join(COPIES, place) + ("" if origin.suffix in AS_IT_IS else ".txt")
        if not self.files.get_file_from_path(src):
            self.files.append(file_of(src, origin, self.config))
        return src


SITE = Site()


def file_of(src, origin, config):
    """A file of the site with this path, whose contents are those of `origin`."""
    file = File(src, str(ROOT), config["site_dir"], config["use_directory_urls"])
    file.abs_src_path = str(origin)
    return file


class Links(Treeprocessor):
    """Runs after inline patterns (20) and before mkdocs resolves links between pages (0)."""

    def run(self, root):
        for element in root.iter():
            for name in "href", "src":
                if element.tag in ("a", "img") and element.get(name):
                    element.set(name, SITE.link(element.get(name)))
        mend_tables(root)


class LinksExtension(Extension):
    """Registers Links, and Code instead of Python-Markdown's."""

    def extendMarkdown(self, md):  # pylint: disable=invalid-name
        md.treeprocessors.register(Links(md), "xr3_links", 5)
        md.inlinePatterns.register(Code(CODE, md), "xr3_code", 195)


# --- The site.

def on_config(config):
    """Adds links and anchors as in the repository, and a link to the repository if its address is known."""
    SITE.outside = dict(config["extra"]["outside"])
    config["markdown_extensions"].append(LinksExtension())
    config["mdx_configs"].setdefault("toc", {})["slugify"] = slug
    repository = config["extra"].get("repository")
    if repository:
        config["copyright"] = f'<a href="{repository}">Sources</a>'
    return config


def on_files(files, config):
    """Adds the pages outside of docs/, the style sheet, the script and the icon."""
    for src, place in [*SITE.outside.items(), *ASSETS.items()]:
        if files.get_file_from_path(src):
            log.warning("mkdocs.yml: %s is in docs/, too: choose another name for %s", src, place)
        files.append(file_of(src, ROOT / place, config))
    return files
