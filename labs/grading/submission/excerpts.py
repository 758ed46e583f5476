"""Excerpts of the hand-written functions as source text: one function and what it needs, shown by themselves.

Solutions are read here, never imported: a notebook holds the text of what it gives, and of nothing else.

A *module* here is one file of the solutions by its dotted name, such as `friction.resting` or `checks`. A *package* is
a folder of modules, such as `friction`. A topic is one or the other.
"""

from __future__ import annotations

import ast
import re
import textwrap
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from labs.grading.submission.statements import Group, groups
from labs.project_folders import ROOT
from reference.errors import InvalidInput

SOLUTIONS = "solutions"
FOLDER = ROOT / SOLUTIONS
_WIDTH = 79
_NOTES = re.compile(r"\n\n {4}Notes\n {4}-----\n(?:(?! {4}\"\"\").*\n)*( {4}\"\"\")")


@dataclass(frozen=True)
class Excerpt:
    """A top-level statement of the solutions with the comment above it and the description below it.

    text: its source. defines: names that it binds. uses: names that it looks up. module: the module that it is in.
    """

    text: str
    defines: frozenset[str]
    uses: frozenset[str]
    module: str


@dataclass(frozen=True)
class TopicExcerpts:
    """All excerpts of a topic, and before them those of the modules that it imports from.

    Two modules may hold a statement of the same text, such as the definition of `Array`. It is taken once, from the
    first of them.
    """

    every: tuple[Excerpt, ...]

    @classmethod
    def of(cls, topic: str) -> TopicExcerpts:
        """Read a topic; raises `InvalidInput` if there are no solutions of it."""
        modules: list[str] = []
        _add_with_imports(topic, modules)
        return cls(tuple(excerpt for module in modules for excerpt in _read(module)))

    def defining(self, name: str) -> Excerpt:
        """The excerpt that defines a function of the topic."""
        return self.every[self._definition(name)]

    def needed(self, names: Collection[str], had: Collection[Excerpt] = ()) -> list[Excerpt]:
        """The excerpts that define the names and all that these need in turn, in order, without those had already.

        Raises
        ------
        InvalidInput
            If no solution defines such a name, or two modules define a needed name in different ways.
        """
        for name in names:
            if name not in self._definitions:
                known = ", ".join(sorted(self._definitions))
                raise InvalidInput(f"the solutions define no {name!r}; they define {known}")
        waiting, found = [self._definition(name) for name in names], set[int]()
        while waiting:
            number = waiting.pop()
            if number not in found:
                found.add(number)
                user = self.every[number]
                waiting += [self._definition(name, user.module) for name in user.uses if name in self._definitions]
        chosen = [self.every[number] for number in sorted(found)]
        _refuse_two_of_a_name([*had, *chosen])
        known_texts = {excerpt.text for excerpt in had}
        return [excerpt for excerpt in chosen if excerpt.text not in known_texts]

    @cached_property
    def _definitions(self) -> dict[str, list[int]]:
        """Name → the numbers of the excerpts that define it, in order."""
        found: dict[str, list[int]] = {}
        for number, excerpt in enumerate(self.every):
            for name in excerpt.defines:
                found.setdefault(name, []).append(number)
        return found

    def _definition(self, name: str, user: str | None = None) -> int:
        """The number of the excerpt that a name means in the module that uses it; without one, in the topic itself.

        A module means its own definition if it has one. Any other name was imported, and the last definition counts,
        because modules come in the order in which they import each other.
        """
        numbers = self._definitions[name]
        own = [number for number in numbers if self.every[number].module == user]
        text = self.every[own[0] if own else numbers[-1]].text
        return next(number for number in numbers if self.every[number].text == text)


def _refuse_two_of_a_name(excerpts: Collection[Excerpt]) -> None:
    texts: dict[str, str] = {}
    for excerpt in excerpts:
        for name in excerpt.defines:
            if texts.setdefault(name, excerpt.text) != excerpt.text:
                raise InvalidInput(
                    f"the solutions define {name} more than once, and one notebook cannot hold both definitions"
                )


def without_notes(text: str) -> str:
    """The source of functions with descriptions that end before their *Notes*, which say how a function is found."""
    return _NOTES.sub(r"\n\1", text)


def text_of(excerpts: Collection[Excerpt]) -> str:
    """Excerpts as one source: two empty lines around functions and classes, none between short statements."""
    lines, after_block = "", False
    for excerpt in excerpts:
        is_block = excerpt.text.startswith(("def ", "class ", "@"))
        lines += ("\n\n\n" if is_block or after_block else "\n") * bool(lines) + excerpt.text
        after_block = is_block
    return lines


def imports_of(excerpts: Collection[Excerpt]) -> str:
    """The imports that these excerpts need of other packages than solutions: for each module one line, or more."""
    wanted = {name for excerpt in excerpts for name in excerpt.uses}
    lines: set[str] = set()
    taken: dict[str, set[str]] = {}
    for node in (node for module in {excerpt.module for excerpt in excerpts} for node in _imports(module)):
        names = {ast.unparse(each) for each in node.names if (each.asname or each.name.partition(".")[0]) in wanted}
        if isinstance(node, ast.ImportFrom):
            taken.setdefault(node.module or "", set()).update(names)
        else:
            lines |= {f"import {name}" for name in names}
    for module, names in taken.items():
        beginning = f"from {module} import "
        several = textwrap.wrap(", ".join(sorted(names)), _WIDTH - len(beginning))
        lines |= {beginning + some.removesuffix(",") for some in several}
    return "\n".join(sorted(lines, key=lambda line: ("numpy" in line, line)))


def _add_with_imports(target: str, modules: list[str]) -> None:
    """Add a module, or all modules of a package, behind everything that they import from other packages."""
    paths = {_name(path): path for path in _paths(target)}
    for path in paths.values():
        for other in _imported(path):
            if other not in modules and other != target and other not in paths:
                _add_with_imports(other, modules)

    def add(name: str) -> None:
        """Add one module of the package behind those of the package that it imports."""
        if name in paths and name not in modules:
            for other in _imported(paths[name]):
                if other != name:
                    add(other)
            modules.append(name)

    for name in paths:
        add(name)


def _paths(target: str) -> list[Path]:
    """The files of a package, or the one file of a module."""
    path = FOLDER.joinpath(*target.split("."))
    if path.is_dir():
        return [file for file in sorted(path.glob("*.py")) if file.stem != "__init__"]
    return [_path(target)]


def _path(module: str) -> Path:
    path = FOLDER.joinpath(*module.split(".")).with_suffix(".py")
    if not path.is_file():
        raise InvalidInput(f"there are no solutions of {module!r}")
    return path


def _name(path: Path) -> str:
    """The dotted name of a module."""
    return ".".join(path.relative_to(FOLDER).with_suffix("").parts)


def _imported(path: Path) -> list[str]:
    """The modules and packages of the solutions that a file imports from."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = [node.module or "" for node in tree.body if isinstance(node, ast.ImportFrom)]
    return [name.removeprefix(f"{SOLUTIONS}.") for name in found if name.startswith(f"{SOLUTIONS}.")]


def _read(module: str) -> Iterator[Excerpt]:
    """The excerpts of a module, without its docstring and its imports."""
    source = _path(module).read_text(encoding="utf-8")
    lines = source.split("\n")
    found: list[list[Group]] = []
    for group in groups(source):
        if _is_import(group):
            continue
        if not _is_text(group):
            found.append([group])
        elif found:  # a text is the description of the value above it; the first one is the module's docstring
            found[-1].append(group)
    for several in found:
        first, last = several[0].first, several[-1].last
        while first > 1 and lines[first - 2].startswith("#"):
            first -= 1
        text = "\n".join(lines[first - 1 : last])
        defines = several[0].defines - _loop_variables(several[0].statements)
        yield Excerpt(text, defines, several[0].uses | _annotations(several[0].statements), module)


def _loop_variables(statements: Iterable[ast.stmt]) -> frozenset[str]:
    """The variables of comprehensions, which no other line sees."""
    nodes = (node for statement in statements for node in ast.walk(statement))
    targets = (node.target for node in nodes if isinstance(node, ast.comprehension))
    return frozenset(each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name))


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
    """The statements by which a module imports from packages other than the solutions."""
    for node in ast.parse(_path(module).read_text(encoding="utf-8")).body:
        text = ast.unparse(node)
        if isinstance(node, ast.Import | ast.ImportFrom) and SOLUTIONS not in text and "__future__" not in text:
            yield node


def _is_import(group: Group) -> bool:
    return all(isinstance(each, ast.Import | ast.ImportFrom) for each in group.statements)


def _is_text(group: Group) -> bool:
    return all(isinstance(each, ast.Expr) and isinstance(each.value, ast.Constant) for each in group.statements)
