"""Reads a built site: the links, anchors, assets and text of its pages. Each function returns problems as sentences."""

import base64
import html.parser
import json
import pathlib
import posixpath
import re
import urllib.parse
import zlib

ASSETS = {"script": "src", "img": "src", "iframe": "src", "source": "src", "video": "src", "audio": "src",
          "embed": "src", "object": "data", "image": "href", "use": "href"}
LINKS_THAT_LOAD = {"stylesheet", "icon", "preconnect", "dns-prefetch", "preload", "prefetch", "modulepreload",
                   "manifest", "apple-touch-icon"}
OUTSIDE = re.compile(r"(https?:)?//")
OF_STYLE = re.compile(r"""(?:url\(\s*|@import\s+)["']?([^"')\s]+)""")
BLOCKS = set("p li ul ol pre h1 h2 h3 h4 h5 h6 table thead tbody tr td th blockquote details summary div hr article "
             "section".split())
MOST_BYTES = 16 * 1024 * 1024
PLAY = "play"  # the robot without a server, which is no part of the documentation
VOID = set("area base br col embed hr img input link meta source track wbr".split())


def shared(link):
    """The members in a link to the robot without a server (docs/playground.md)."""
    _, mark, packed = link.partition("#xr3=")
    data = base64.urlsafe_b64decode(packed + "=" * (-len(packed) % 4))
    return json.loads(zlib.decompress(data, wbits=-15)) if mark else {}


class Page(html.parser.HTMLParser):
    """One page: `anchors`, `links` and `assets` as written, `styles`, the attributes `inline` with a style or script, the
    navigation's links, and the text `blocks` of the article as (list depth, kind, text), in which headings, code, cells
    and other text differ in kind."""

    def __init__(self, text, whole=False):
        super().__init__()
        self.anchors, self.links, self.assets, self.styles, self.inline = set(), [], [], [], []
        self.navigation, self.blocks = [], []
        self._open, self._text, self._whole = [], "", whole
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        attributes = {name: value or "" for name, value in attributes}
        if "id" in attributes:
            self.anchors.add(attributes["id"])
        if tag == "a" and "name" in attributes:
            self.anchors.add(attributes["name"])
        self.inline += [name for name in attributes if name == "style" or name.startswith("on")]
        if "style" in attributes:
            self.styles.append(attributes["style"])
        if tag in ("a", "area") and "href" in attributes:
            self.links.append(attributes["href"])
            if self._is_in("md-nav--primary") and "md-logo" not in attributes.get("class", "").split():
                self.navigation.append(attributes["href"])
        if attributes.get(ASSETS.get(tag)):
            self.assets.append(attributes[ASSETS[tag]])
        if tag == "link" and LINKS_THAT_LOAD & set(attributes.get("rel", "").split()):
            self.assets.append(attributes.get("href", ""))
        self.assets += [part.split()[0] for part in attributes.get("srcset", "").split(",") if part.strip()]
        if tag in BLOCKS:
            self._flush()
        if tag == "img" and self._is_shown():
            self._text += f"[picture {attributes.get('alt', '')}]"
        if tag not in VOID:
            self._open.append((tag, attributes.get("class", "").split()))

    def handle_endtag(self, tag):
        if tag in BLOCKS:
            self._flush()
        if any(opened == tag for opened, _ in self._open):
            while self._open.pop()[0] != tag:
                pass

    def handle_data(self, data):
        if self._open and self._open[-1][0] == "style":
            self.styles.append(data)
        if self._is_shown():
            self._text += data

    def close(self):
        super().close()
        self._flush()

    def _is_in(self, name):
        return any(name in classes for _, classes in self._open)

    def _is_shown(self):
        if any(tag in ("script", "style", "button") for tag, _ in self._open) or self._is_in("headerlink"):
            return False
        return (self._whole or self._is_in("md-content__inner")) and not (
            self._is_in("md-source-file") or self._is_in("doc") or self._is_in("robot") or self._is_in("md-content__button"))

    def _flush(self):
        text, self._text = " ".join(self._text.split()), ""
        if text:
            tags = [tag for tag, _ in self._open]
            kind = next((tag for tag in reversed(tags) if re.fullmatch(r"h[1-6]|pre|td|th|summary", tag)), "text")
            self.blocks.append((sum(tag in ("ul", "ol") for tag in tags), kind, text))


class Site:
    """All pages of a folder, and all its `files`. `pages` maps a path to its Page. `base` is the path of the site on its
    server."""

    def __init__(self, folder, base="/"):
        self.base = base
        self.folder = pathlib.Path(folder)
        self.files = [path for path in sorted(self.folder.rglob("*"))
                      if path.is_file() and path.relative_to(self.folder).parts[0] != PLAY]
        self.pages = {path.relative_to(self.folder).as_posix(): Page(path.read_text(encoding="utf-8"))
                      for path in self.files if path.suffix == ".html"}

    def target(self, page, link):
        """(path, anchor) of a link inside the site; None for a link that leaves it."""
        parts = urllib.parse.urlsplit(link)
        if parts.scheme or parts.netloc:
            return None
        path = urllib.parse.unquote(parts.path)
        if path.startswith("/"):
            path = path.removeprefix(self.base).lstrip("/")
        elif path:
            path = posixpath.join(posixpath.dirname(page), path)
        path = posixpath.normpath(path) if path else page
        if (self.folder / path).is_dir():
            path = posixpath.normpath(posixpath.join(path, "index.html"))
        return path, urllib.parse.unquote(parts.fragment)

    def dead_links(self):
        """Links and pictures that lead to no file or to no anchor."""
        problems = []
        for name, page in self.pages.items():
            for link in [*page.links, *page.assets]:
                target = self.target(name, link)
                if target is None:
                    continue
                path, anchor = target
                if path.startswith("..") or not (self.folder / path).is_file():
                    problems.append(f"{name}: the link {link} leads to no file of the site")
                elif anchor and path in self.pages and anchor not in self.pages[path].anchors | {"__top"}:
                    problems.append(f"{name}: the link {link} leads to no heading of {path}")
        return problems

    def outside_links(self):
        """The ordinary links that leave the site, each with its first page. They are not followed here."""
        found = {}
        for name, page in self.pages.items():
            for link in page.links:
                if self.target(name, link) is None:
                    found.setdefault(link, name)
        return found

    def outside_assets(self):
        """Scripts, styles, fonts and pictures that a page would load from another server."""
        problems = [f"{name}: loads {asset}" for name, page in self.pages.items()
                    for asset in [*page.assets, *OF_STYLE.findall(" ".join(page.styles))] if OUTSIDE.match(asset)]
        for path in (path for path in self.files if path.suffix == ".css"):
            text = path.read_text(encoding="utf-8")
            problems += [f"{path.relative_to(self.folder)}: loads {asset}" for asset in OF_STYLE.findall(text)
                         if OUTSIDE.match(asset)]
        return problems

    def not_served(self):
        """Attributes that the Content-Security-Policy of `xr3 serve` blocks, and files that are too large for it."""
        return [*(f"{name}: has an attribute {each}" for name, page in self.pages.items() for each in page.inline),
                *(f"{path.relative_to(self.folder)}: has more than {MOST_BYTES >> 20} MiB" for path in self.files
                  if path.stat().st_size > MOST_BYTES)]

    def not_once(self, expected):
        """Pages that the navigation does not have exactly once, as the page 404.html shows it."""
        links = [self.target("404.html", link) for link in self.pages["404.html"].navigation]
        shown = [target[0] for target in links if target]
        return [f"the navigation has {page} {shown.count(page)} times, not once" for page in expected
                if shown.count(page) != 1]

    def naming(self, text):
        """Files that contain this text, such as a path of the machine that has built the site."""
        return [f"{path.relative_to(self.folder)}: contains {text}" for path in self.files
                if text.encode() in path.read_bytes()]
