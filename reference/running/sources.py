"""The source text that a piece of code is made of: its own files and those that they import, hashed."""

from __future__ import annotations

import ast
import functools
import hashlib
import importlib.util
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import reference

_INSTALLED = {"site-packages", "dist-packages"}
_LAB = {"labs", "reference", "solutions"}
"""The lab's own packages."""
_HERE = Path(reference.__file__).resolve().parents[1]
"""The folder that they are in: a checkout, or the folder of all installed packages."""
_ONE_AT_A_TIME = threading.Lock()
"""Two threads that parse at the same time sometimes raise "AST constructor recursion depth mismatch" (CPython 3.11)."""


def digest(source: str, once: bool = False) -> str:
    """A hash of a package or a `.py` file, and of everything that it imports except installed packages.

    Nothing is imported: files are found as Python would find them, and read. once: read a package only the first time
    in this process, since Python imports it only once as well; a `.py` file is always read.
    """
    whole, seen, waiting = hashlib.sha256(), set(), [source]
    while waiting:
        name = waiting.pop()
        if name not in seen:
            seen.add(name)
            text, imported = _first_part(name) if once and not name.endswith(".py") else _part(name)
            whole.update(f"{name} {text}\n".encode())
            waiting += sorted(imported)
    return whole.hexdigest()


def _part(name: str) -> tuple[str, frozenset[str]]:
    """A hash of the text of a package or a file, and the first names of the modules of one's own that it imports."""
    whole, names = hashlib.sha256(), frozenset[str]()
    for place, path in _files(name):
        text = path.read_bytes()
        whole.update(f"{path.relative_to(place.parent).as_posix()} {len(text)}\n".encode() + text)
        names |= _imported(text)
    return whole.hexdigest(), frozenset(name for name in names if _is_own(name))


_first_part = functools.cache(_part)


def _files(name: str) -> Iterator[tuple[Path, Path]]:
    """Each file of a package with the package's folder, or a module's own file; a part of a package counts as all."""
    for place in [Path(name).resolve()] if name.endswith(".py") else _places(name):
        for path in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
            yield place, path


@functools.cache
def _imported(text: bytes) -> frozenset[str]:
    """First names of the modules that a text imports, anywhere in it."""
    try:
        with _ONE_AT_A_TIME:
            nodes = list(ast.walk(ast.parse(text)))
    except (SyntaxError, ValueError):
        return frozenset()
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module and not node.level}
    return frozenset(name.partition(".")[0] for name in names)


def _is_own(name: str) -> bool:
    """Whether a name is the lab's own or code of one's own: neither standard library nor another installed package."""
    if name in sys.stdlib_module_names:
        return False
    places = _places(name)
    if name in _LAB and any(place.parent == _HERE for place in places):
        return True
    return any(not _INSTALLED & set(place.parts) for place in places)


def _places(name: str) -> list[Path]:
    """The folders of a package or the file of a module; empty where there is none, or it is not written in Python."""
    try:
        spec = importlib.util.find_spec(name.partition(".")[0])  # looking up a first name imports nothing
    except (ImportError, ValueError):
        return []
    if spec is None:
        return []
    if spec.submodule_search_locations is not None:
        return [Path(place).resolve() for place in spec.submodule_search_locations]
    return [Path(spec.origin).resolve()] if spec.origin and spec.origin.endswith(".py") else []
