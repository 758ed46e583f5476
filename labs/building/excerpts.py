"""The hand-written functions as pieces of source text: what one of them needs can be cut out and shown by itself.

Solutions are read here, never imported: a notebook holds the text of what it gives, and of nothing else.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from labs.grading.submission.slicing import Group, groups
from labs.project_folders import ROOT
from reference.errors import InvalidInput

SOLUTIONS = "solutions"
FOLDER = ROOT / SOLUTIONS
CHECKS = "checks"
"""The module of solutions that every topic may use."""


@dataclass(frozen=True)
class Piece:
    """A top-level statement of the solutions with the comment or text that belongs to it.

    text: its source. defines: names that it binds. uses: names that it looks up. module: where it stands.
    """

    text: str
    defines: frozenset[str]
    uses: frozenset[str]
    module: str


@dataclass(frozen=True)
class Pieces:
    """All of one topic with what it imports of other solutions, what is needed first in front."""

    every: tuple[Piece, ...]

    @classmethod
    def of(cls, topic: str) -> Pieces:
        """Read a topic; raises `InvalidInput` if there are no solutions of it."""
        order: list[str] = []
        _visit(topic, order)
        return cls(tuple(piece for module in order for piece in _read(module)))

    @cached_property
    def _places(self) -> dict[str, list[int]]:
        found: dict[str, list[int]] = {}
        for place, piece in enumerate(self.every):
            for name in piece.defines:
                found.setdefault(name, []).append(place)
        return found

    def needed(self, names: Collection[str], had: Collection[Piece] = ()) -> list[Piece]:
        """The pieces that define the names and what these need in turn, in order, without those that are had already.

        Raises
        ------
        InvalidInput
            If there is no such name, or two modules give different things one name that is needed of both.
        """
        for name in names:
            if name not in self._places:
                raise InvalidInput(f"the solutions define no {name!r}; they define {', '.join(sorted(self._places))}")
        waiting, found = [self._place(name, "") for name in names], set[int]()
        while waiting:
            place = waiting.pop()
            if place not in found:
                found.add(place)
                piece = self.every[place]
                waiting += [self._place(name, piece.module) for name in piece.uses if name in self._places]
        chosen = [self.every[place] for place in sorted(found)]
        self._refuse_two_of_a_name([*had, *chosen])
        known = {piece.text for piece in had}
        return [piece for piece in chosen if piece.text not in known]

    def _place(self, name: str, module: str) -> int:
        """Where a name that a module looks up is defined: in the module itself if it does."""
        places = self._places[name]
        found = next((place for place in places if self.every[place].module == module), places[-1])
        return next(place for place in places if self.every[place].text == self.every[found].text)  # the first like it

    def _refuse_two_of_a_name(self, pieces: Collection[Piece]) -> None:
        texts: dict[str, str] = {}
        for piece in pieces:
            for name in piece.defines:
                if texts.setdefault(name, piece.text) != piece.text:
                    raise InvalidInput(f"the solutions define {name} more than once: these cannot stand side by side")


def text_of(pieces: Collection[Piece]) -> str:
    """Pieces as one source: two empty lines around what is defined, none between short statements."""
    lines, before = "", False
    for piece in pieces:
        block = piece.text.startswith(("def ", "class ", "@"))
        lines += ("\n\n\n" if block or before else "\n") * bool(lines) + piece.text
        before = block
    return lines


def imports_of(pieces: Collection[Piece]) -> str:
    """The imports that these pieces need of other packages than solutions: one line for each module."""
    wanted = {name for piece in pieces for name in piece.uses}
    lines: set[str] = set()
    taken: dict[str, set[str]] = {}
    for node in (node for module in {piece.module for piece in pieces} for node in _imports(module)):
        names = {ast.unparse(each) for each in node.names if (each.asname or each.name.partition(".")[0]) in wanted}
        if isinstance(node, ast.ImportFrom):
            taken.setdefault(node.module or "", set()).update(names)
        else:
            lines |= {f"import {name}" for name in names}
    lines |= {f"from {module} import {', '.join(sorted(names))}" for module, names in taken.items() if names}
    return "\n".join(sorted(lines, key=lambda line: ("numpy" in line, line)))


def _visit(module: str, order: list[str]) -> None:
    """Add a module behind those that it imports."""
    for path in _files(module):
        for other in _imported(path):
            if other not in order and other != module and not other.startswith(f"{module}."):
                _visit(other, order)
    for path in _ordered(module):
        name = _name(path)
        if name not in order:
            order.append(name)


def _ordered(module: str) -> list[Path]:
    """The files of a module, those that others of it import in front."""
    files = {_name(path): path for path in _files(module)}
    order: list[str] = []

    def add(name: str) -> None:
        if name in files and name not in order:
            for other in _imported(files[name]):
                if other != name:
                    add(other)
            order.append(name)

    for name in files:
        add(name)
    return [files[name] for name in dict.fromkeys(order)]


def _files(module: str) -> list[Path]:
    path = FOLDER.joinpath(*module.split("."))
    if path.is_dir():
        return [file for file in sorted(path.glob("*.py")) if file.stem != "__init__"]
    if not path.with_suffix(".py").is_file():
        raise InvalidInput(f"there are no solutions of {module!r}")
    return [path.with_suffix(".py")]


def _name(path: Path) -> str:
    return ".".join(path.relative_to(FOLDER).with_suffix("").parts)


def _imported(path: Path) -> list[str]:
    """The modules of the solutions that a file imports from."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = [node.module or "" for node in tree.body if isinstance(node, ast.ImportFrom)]
    return [name.removeprefix(f"{SOLUTIONS}.") for name in found if name.startswith(f"{SOLUTIONS}.")]


def _read(module: str) -> Iterator[Piece]:
    """The pieces of a module, without its docstring and its imports."""
    source = _files(module)[0].read_text(encoding="utf-8")
    lines = source.split("\n")
    found: list[list[Group]] = []
    for group in groups(source):
        if _is_import(group):
            continue
        if _is_text(group):
            if found:
                found[-1].append(group)  # the description of the value above it
            continue
        found.append([group])
    for several in found:
        first, last = several[0].first, several[-1].last
        while first > 1 and lines[first - 2].startswith("#"):
            first -= 1
        text = "\n".join(lines[first - 1 : last])
        yield Piece(text, several[0].defines, several[0].uses | _annotations(several[0].statements), module)


def _annotations(statements: Iterable[ast.stmt]) -> frozenset[str]:
    """The names in type hints, which nothing looks up as the code runs."""
    hints: list[ast.expr | None] = []
    for node in (node for statement in statements for node in ast.walk(statement)):
        if isinstance(node, ast.FunctionDef):
            hints.append(node.returns)
        elif isinstance(node, ast.arg | ast.AnnAssign):
            hints.append(node.annotation)
    nodes = (node for hint in hints if hint is not None for node in ast.walk(hint))
    return frozenset(node.id for node in nodes if isinstance(node, ast.Name))


def _imports(module: str) -> Iterator[ast.Import | ast.ImportFrom]:
    """The statements by which a module imports what is not of the solutions."""
    for node in ast.parse(_files(module)[0].read_text(encoding="utf-8")).body:
        text = ast.unparse(node)
        if isinstance(node, ast.Import | ast.ImportFrom) and SOLUTIONS not in text and "__future__" not in text:
            yield node


def _is_import(group: Group) -> bool:
    return all(isinstance(each, ast.Import | ast.ImportFrom) for each in group.statements)


def _is_text(group: Group) -> bool:
    return all(isinstance(each, ast.Expr) and isinstance(each.value, ast.Constant) for each in group.statements)
