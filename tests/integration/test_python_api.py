"""docs/python-api.md has every class and function of the Python package with its docstring, as the sources have
them. With --write as an argument: rewrites what follows each comment with a name, such as `<!-- xr3.robot.Robot -->`."""
# labels: full

import ast
import pathlib
import re
import sys
import textwrap
import unittest

from support import ROOT

PAGE = pathlib.Path(ROOT, "docs", "python-api.md")
PACKAGE = pathlib.Path(ROOT, "clients", "python", "xr3")
ENTRY = re.compile(r"^(<!-- xr3\.(\w+)\.(\w+) -->\n).*?(?=^<!-- xr3|^## |\Z)", re.MULTILINE | re.DOTALL)
WIDTH = 100


def fence(signature):
    """A block of code; the lines end after commas."""
    glued = re.sub("(?<!,) ", "\N{NO-BREAK SPACE}", signature)
    lines = textwrap.wrap(glued, WIDTH, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    return "```python\n" + "\n".join(lines).replace("\N{NO-BREAK SPACE}", " ") + "\n```\n"


class Module:
    """A module of the package, by its source."""

    def __init__(self, name):
        self.text = (PACKAGE / f"{name}.py").read_text(encoding="utf-8")
        self.parts = {part.name: part for part in ast.parse(self.text).body if hasattr(part, "name")}

    def source(self, node):
        return ast.get_source_segment(self.text, node)

    def arguments(self, function):
        """The arguments of a function in parentheses, without self, and what it returns."""
        lines = self.text.splitlines()[function.lineno - 1:function.body[0].lineno - 1]
        text = " ".join(" ".join(lines).split()).partition("(")[2].removesuffix(":")
        return "(" + re.sub(r"^(self|cls)(, )?", "", text)

    def constructor(self, kind):
        """The first line of a class: its constructor; of an exception, its base."""
        for part in kind.body:
            if getattr(part, "name", "") == "__init__" and not kind.bases:
                return kind.name + self.arguments(part).removesuffix(" -> None")
        if kind.bases:
            return f"class {kind.name}({', '.join(map(self.source, kind.bases))})"
        fields = [self.source(part) for part in kind.body if isinstance(part, ast.AnnAssign)]
        return f"{kind.name}({', '.join(field for field in fields if 'init=False' not in field)})"

    def member(self, kind, function):
        decorators = [self.source(each) for each in function.decorator_list]
        call = self.arguments(function)
        if "property" in decorators:
            call = call.replace("() ->", ":")
        owner = f"{kind.name}." if "classmethod" in decorators else ""
        return f"\n#### {kind.name}.{function.name}\n\n{fence(owner + function.name + call)}\n{document(function)}"

    def entry(self, name):
        part = self.parts[name]
        if isinstance(part, ast.FunctionDef):
            return f"### {name}\n\n{fence(name + self.arguments(part))}\n{document(part)}"
        members = [each for each in part.body if isinstance(each, ast.FunctionDef) and each.name[0] != "_"]
        return (f"### {name}\n\n{fence(self.constructor(part))}\n{document(part)}"
                + "".join(self.member(part, each) for each in members))


def document(part):
    text = ast.get_docstring(part)
    if text is None:
        raise ValueError(f"{part.name} has no docstring")
    return text + "\n"


def page():
    return ENTRY.sub(lambda mark: f"{mark[1]}{Module(mark[2]).entry(mark[3])}\n", PAGE.read_text(encoding="utf-8")).rstrip() + "\n"


class Reference(unittest.TestCase):
    maxDiff = None

    def test_the_page_is_that_of_the_sources(self):
        self.assertEqual(page(), PAGE.read_text(encoding="utf-8"), "rewrite it: test_python_api.py --write")

    def test_every_public_name_is_there(self):
        text = PAGE.read_text(encoding="utf-8")
        public = ast.literal_eval(re.search(r"__all__ = (\[.*?\])", (PACKAGE / "__init__.py").read_text(encoding="utf-8"),
                                            re.DOTALL)[1])
        self.assertGreater(len(public), 15)
        for name in public:
            self.assertRegex(text, f"`{name}`" if name.isupper() or "_" in name else f"(?m)^### {name}$")


if __name__ == "__main__":
    if "--write" in sys.argv:
        PAGE.write_text(page(), encoding="utf-8")
    else:
        unittest.main()
