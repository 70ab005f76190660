"""The folder in which a program runs: its files, and the modules that were imported from it."""

import importlib
import os
import sys
from types import ModuleType
from typing import Iterable, List, Mapping, Optional, Set, Union

PATH = os.path.abspath("program")
_written: Set[str] = set()  # the source files in it; others were made by programs, and stay


def write(files: Mapping[str, Union[str, bytes]]) -> None:
    """Writes the source files, and removes those of the run before that are not among them."""
    _remove(_written.difference(files))
    for name, content in files.items():
        path = os.path.join(PATH, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
        _written.add(name)
    importlib.invalidate_caches()


def _remove(names: Iterable[str]) -> None:
    for name in names:
        _written.discard(name)
        if os.path.exists(os.path.join(PATH, name)):
            os.remove(os.path.join(PATH, name))


def own_name(path: str) -> Optional[str]:
    """The name of a file in the folder; None for a file outside of it."""
    return os.path.relpath(path, PATH) if path.startswith(PATH + os.sep) else None


def forget_modules() -> None:
    """Removes the modules that were imported from the folder, so that a run imports them afresh."""
    for name, module in list(sys.modules.items()):
        if any(own_name(place) for place in _places(module)):
            del sys.modules[name]


def _places(module: ModuleType) -> List[str]:
    """The file of a module, and the folders of a package."""
    file = getattr(module, "__file__", None)
    return [*filter(None, [file]), *(getattr(module, "__path__", None) or ())]
