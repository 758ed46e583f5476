"""The source text that a piece of code is made of: its own files and those that they import, hashed."""

from __future__ import annotations

import ast
import functools
import hashlib
import importlib.util
import re
import sys
import threading
from collections.abc import Iterable, Iterator
from pathlib import Path

import reference

_INSTALLED = {"site-packages", "dist-packages"}
_LAB = {"labs", "reference", "solutions"}
"""The lab's own packages."""
_HERE = Path(reference.__file__).resolve().parents[1]
"""The folder that they are in: a checkout, or the folder of all installed packages."""
_WORD = re.compile(rb"\bimport\b")
_PLAIN = re.compile(
    rb"^(?<!\\\n)(?<!\\\r\n)[ \t]*(?:from[ \t]+([a-zA-Z_.][\w.]*)[ \t]+import\b|import[ \t]+([\w., \t]+)$)",
    re.MULTILINE,
)
"""An import as most are written: a line of ASCII letters that begins a statement, and of `import` ends it as well."""
_ONE_AT_A_TIME = threading.Lock()
"""Two threads that parse at the same time sometimes raise "AST constructor recursion depth mismatch" (CPython 3.11)."""


class Texts:
    """What was read of packages and files, so that each is read only once.

    files_again: whether a `.py` file is read each time all the same, as it is in a worker, which imports a package only
    once, but runs such a file again for each job. What the file imports is imported once, wherever it lies.
    """

    def __init__(self, files_again: bool = False) -> None:
        self._files_again, self._known = files_again, dict[str, tuple[str, frozenset[str]]]()
        self._data = dict[str, str]()

    def part(self, name: str, is_imported: bool = False) -> tuple[str, frozenset[str]]:
        """A hash of the text of a package or a file, and the first names of the modules that it imports."""
        if name not in self._known or (self._files_again and name.endswith(".py") and not is_imported):
            self._known[name] = _part(name)
        return self._known[name]

    def data(self, folder: Path) -> str:
        """A hash of all files of a folder; empty where it has none."""
        if str(folder) not in self._data:
            whole, paths = hashlib.sha256(), sorted(path for path in folder.glob("*") if path.is_file())
            for path in paths:
                text = path.read_bytes()
                whole.update(f"{path.name} {len(text)}\n".encode() + text)
            self._data[str(folder)] = whole.hexdigest() if paths else ""
        return self._data[str(folder)]


IMPORTED = Texts(files_again=True)
"""What this process read when it began, for a worker."""


def digest(source: str, texts: Texts | None = None) -> str:
    """A hash of a package or a `.py` file, and of everything that it imports except installed packages.

    Nothing is imported: files are found as Python would find them, and read. texts: what was read before, and is not
    to be read again.
    """
    whole, seen, waiting, texts = hashlib.sha256(), set(), [source], texts or Texts()
    while waiting:
        name = waiting.pop()
        if name not in seen:
            seen.add(name)
            text, imported = texts.part(name, is_imported=name != source)
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
    beside = frozenset(_beside(Path(name).resolve().parent, names)) if name.endswith(".py") else frozenset[str]()
    return whole.hexdigest(), frozenset(name for name in names if _is_own(name)) | beside


def _beside(folder: Path, names: Iterable[str]) -> Iterator[str]:
    """Files of these modules in the folder of a `.py` file, which may put that folder on the path as it runs."""
    for name in names:
        module, package = folder / f"{name}.py", folder / name
        yield from (str(path) for path in (module, *sorted(package.rglob("*.py"))) if path.is_file())


def _files(name: str) -> Iterator[tuple[Path, Path]]:
    """Each file of a package with the package's folder, or a module's own file; a part of a package counts as all."""
    for place in [Path(name).resolve()] if name.endswith(".py") else _places(name):
        for path in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
            yield place, path


@functools.cache
def _imported(text: bytes) -> frozenset[str]:
    """First names of the modules that a text imports, anywhere in it.

    Parsing takes twenty times as long as reading, and each worker would do it anew. So a text is parsed only if it has
    the word `import` beyond plain lines. A plain line within a string counts as well: a file too many does no harm.
    """
    plain = _PLAIN.findall(text)
    if len(plain) == len(_WORD.findall(text)):
        modules = b",".join(start or several for start, several in plain).decode().split(",")
        return frozenset(re.split(r"[.\s]", module.strip())[0] for module in modules) - {""}
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
