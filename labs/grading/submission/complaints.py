"""What a student should know of a file that was read: what Python cannot read in it, and functions out of place."""

from __future__ import annotations

import ast
import builtins
import difflib
import re
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from labs.grading.safe_text import one_line
from labs.grading.submission.cells import Cell, Complaint, merge_mark, place
from labs.grading.submission.effects import Effects
from labs.grading.submission.known_calls import AT_HAND
from labs.grading.submission.magics import cell_magic
from labs.grading.submission.sharing import called_as
from labs.grading.submission.slicing import looked_up
from labs.grading.submission.statements import Group, defined_as
from labs.grading.submission.syntax_errors import explained
from reference import lecture

MOST = 5
"""So many complaints of a kind are listed; the others are counted."""
_NAMED = 3  # so many of the functions that a mistake costs are named; the others are counted
_WHAT = {
    "unreadable": "cells that Python cannot read",
    "repeated": "functions that are defined several times",
    "missing": "functions that are missing",
    "other": "complaints about the file",
}
_ALIKE = 0.85  # similarity, at most 1, from which a name is taken for a misspelling of another one
_LOOKED_AT = 500  # the most names that are compared so
_ZERO = {"zeros", "empty", "zeros_like", "empty_like", "defaultdict"}
_DEFINES = re.compile(r"^[^\w\s#'\"]{0,2}def[ \t]+(\w+)", re.MULTILINE | re.IGNORECASE)


@dataclass(frozen=True)
class Located:
    """A group of statements and the cell that it is in."""

    group: Group
    cell: Cell


def unreadable(error: Exception, cell: Cell, source: str) -> Complaint:
    """What keeps Python from reading a cell. source: without what only a notebook's kernel understands."""
    if found := merge_mark(cell.source):
        text = f"a merge left its mark {found[1]!r}: keep one version, and delete all marks"
        return Complaint(text, cell.number, found[0], "unreadable")
    if (nul := cell.source.find("\0")) >= 0:
        line = cell.source.count("\n", 0, nul) + 1
        text = "a NUL character is in it, which no editor shows: delete the line and type it again"
        return Complaint(f"Python cannot read this: {text}", cell.number, line, "unreadable")
    if not isinstance(error, SyntaxError):
        why = "it holds half a character" if isinstance(error, UnicodeError) else "too deeply nested"
        return Complaint(f"Python cannot read this: {why}", cell.number, kind="unreadable")
    number, sentence = explained(error, source)
    quoted = one_line(source.split("\n")[number - 1], 80)
    return Complaint(f"Python cannot read '{quoted}': {sentence}", cell.number, number, "unreadable")


def definitions(source: str) -> list[str]:
    """The functions of a source that Python cannot read."""
    return list(dict.fromkeys(_DEFINES.findall(source)))


def with_its_cost(complaint: Complaint, cell: Cell, elsewhere: Mapping[str, Cell]) -> Complaint:
    """The complaint about an unreadable cell, and which functions that costs.

    elsewhere: names that are defined where Python can read it, each with the cell.
    """
    names = definitions(cell.source)
    other = {name: elsewhere[name] for name in names if name in elsewhere}
    lost = [name for name in names if name not in other]
    sentences = [f"Until then {_some(lost)} cannot be checked."] if lost else []
    for number in dict.fromkeys(cell.number for cell in other.values()):
        again = [name for name, cell in other.items() if cell.number == number]
        sentences.append(f"Until then {place(number, None)} counts for {_some(again)}.")
    end = "" if complaint.text.endswith("?") else "."
    return replace(complaint, text=f"{complaint.text}{end} {' '.join(sentences[:2])}") if sentences else complaint


def _some(names: Sequence[str]) -> str:
    shown, more = [one_line(name, 80) for name in names[:_NAMED]], len(names) - _NAMED
    if more > 0:
        return f"{', '.join(shown)} and {more} more"
    return " and ".join([", ".join(shown[:-1]), shown[-1]] if len(shown) > 1 else shown)


def misplaced(missing: Collection[str], pieces: Sequence[Located]) -> Iterator[Complaint]:
    """Complaints of missing functions that are inside another one, and of a `return` outside of every function."""
    above = ""
    for piece in pieces:
        for statement in piece.group.statements:
            yield from _stray_return(statement, piece.cell, above)
            if missing and isinstance(statement, ast.FunctionDef | ast.ClassDef):
                yield from _hidden(missing, statement, piece.cell)
            above = statement.name if isinstance(statement, ast.FunctionDef) else above


def _hidden(missing: Collection[str], outer: ast.FunctionDef | ast.ClassDef, cell: Cell) -> Iterator[Complaint]:
    """Complaints of missing functions that are defined inside a function or a class."""
    where = f"the {'class' if isinstance(outer, ast.ClassDef) else 'function'} {one_line(outer.name, 80)}"
    for node in ast.walk(outer):
        if node is not outer and isinstance(node, ast.FunctionDef) and node.name in missing:
            text = f"{node.name} is inside {where}, where nothing else finds it: move it to the left margin"
            yield Complaint(text, cell.number, node.lineno)


def _stray_return(statement: ast.stmt, cell: Cell, above: str) -> Iterator[Complaint]:
    """A complaint, if a statement outside of every function returns. above: the last function before it."""
    waiting: list[ast.AST] = [statement]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Return):
            whose = f"if it belongs to {one_line(above, 80)}, indent it like the lines of that function"
            text = "this return is outside of every function" + (f": {whose}" if above else "")
            yield Complaint(text, cell.number, node.lineno)
        elif not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.expr):
            waiting.extend(ast.iter_child_nodes(node))


def in_cells_of_text(missing: Collection[str], texts: Sequence[Cell]) -> Iterator[Complaint]:
    """Complaints of missing functions that are written in cells of text, as one key turns a code cell into one."""
    for cell in texts:
        for name in definitions(cell.source):
            if name in missing and "```" not in cell.source:
                after = f" after {place(cell.number, None)}" if cell.number else ""
                yield Complaint(f"{name} is in a cell of text{after}: select that cell, and press Esc and Y")


def below_a_magic(missing: Collection[str], cells: Sequence[Cell]) -> Iterator[Complaint]:
    """Complaints of missing functions in cells whose first line keeps a notebook from running them as Python."""
    for cell in cells:
        if (magic := cell_magic(cell.source)) and (
            names := [each for each in definitions(cell.source) if each in missing]
        ):
            text = f"its first line, {one_line(magic, 60)}, keeps the notebook from defining {_some(names)}: delete it"
            yield Complaint(text, cell.number, 1)


def not_at_hand(functions: Collection[str], kept: Sequence[Located], pieces: Sequence[Located]) -> Iterator[Complaint]:
    """Complaints of what the functions look up and do not have where they are graded: other packages and files.

    kept: the pieces that the functions need, of all pieces of the file.
    """
    bindings = Counter(name for piece in pieces for name in piece.group.defines)
    used = looked_up([piece.group for piece in kept], functions)
    if used - bindings.keys() - vars(builtins).keys() - {"__file__"}:  # a star may stand for them
        used.add("*")
    for piece in kept:
        group, cell = piece.group, piece.cell
        alone = (path.split(".")[0] for name, path in group.modules.items() if bindings[name] == 1 and name in used)
        absent = {package for package in alone if package and package not in AT_HAND}
        for package in sorted(absent) if not group.is_compound else ():
            text = (
                f"{one_line(package, 80)} is not there where this is graded, only NumPy and Python's own library: if it"
                " is a file of your own, copy what you need of it into this one"
            )
            yield Complaint(text, cell.number, group.first)
        if "__file__" in group.uses:
            text = "__file__ is not defined where this is graded, and no other file is there: write its numbers here"
            yield Complaint(text, cell.number, group.first)


def not_filled(functions: Collection[str], kept: Sequence[Located], pieces: Sequence[Located]) -> Iterator[Complaint]:
    """Complaints of tables that the functions need and that stay empty, as what fills them cannot be called here.

    kept: the pieces that the functions need, of all pieces of the file.
    """
    groups = [piece.group for piece in kept]
    used, here = looked_up(groups, functions), {id(group) for group in groups}
    begun = [piece for piece in kept if _is_empty(piece.group)]
    empty = {name: piece for piece in begun for name in piece.group.defines & used}
    worked_on = {name for group in groups for name in group.uses if not group.functions}
    worked_on |= {name for group in groups for each in group.functions for name in _worked_on(each.does)}
    imported = {name: path for piece in pieces for name, path in piece.group.modules.items()}
    absent = {name for name, path in imported.items() if path.split(".")[0] not in AT_HAND}
    for piece in pieces:
        calls = piece.group.does.calls if id(piece.group) not in here else ()
        given = {
            name: start
            for call in calls
            for start in absent & {call.root, *call.roots}
            for name in call.given | call.receiver
        }
        for name in sorted(given.keys() & empty.keys() - worked_on):
            table = empty.pop(name)
            text = (
                f"this statement was left out, because {one_line(given[name], 80)} is not there where this is graded:"
                f" {one_line(name, 80)} stays as {place(table.cell.number, table.group.first)} makes it"
            )
            yield Complaint(text, piece.cell.number, piece.group.first)


def _worked_on(does: Effects) -> Iterator[str]:
    """Names whose objects a function changes, or whose methods it calls."""
    yield from does.changes
    yield from (name for call in does.calls if call.called.startswith(".") for name in call.receiver)


def _is_empty(group: Group) -> bool:
    """Whether statements only bind names to what has nothing in it yet: `{}`, `dict()`, `np.zeros(3)`."""
    values = [each.value for each in group.statements if isinstance(each, ast.Assign | ast.AnnAssign)]
    return len(values) == len(group.statements) and all(map(_has_nothing, values))


def _has_nothing(value: ast.expr | None) -> bool:
    match value:
        case ast.List(elts=[]) | ast.Dict(keys=[]) | ast.Call(args=[], keywords=[]):
            return True
        case ast.Call():
            return called_as(value).removeprefix(".") in _ZERO
    return False


def misspelt(missing: Sequence[str], pieces: Sequence[Located]) -> Iterator[Complaint]:
    """Complaints about functions whose names look like those of missing ones."""
    plainly = {_letters(name): name for name in missing}
    others = [(name, piece) for piece in pieces for name in sorted(piece.group.defines - lecture.FUNCTIONS.keys())]
    for name, piece in others[:_LOOKED_AT]:
        if defined_as(piece.group, name) == "def":
            for near in difflib.get_close_matches(_letters(name), plainly, 1, _ALIKE):
                text = f"is {one_line(name, 80)} meant to be {plainly[near]}? It counts under that name alone"
                if foreign := [letter for letter in name if not letter.isascii()]:
                    text += f", and {foreign[0]} (U+{ord(foreign[0]):04X}) is another letter"
                yield Complaint(text, piece.cell.number, piece.group.first)


def _letters(name: str) -> str:
    return name.replace("_", "").lower()


def few(complaints: Sequence[Complaint]) -> list[Complaint]:
    """The first complaints of each kind, and how many more there are."""
    found: list[Complaint] = []
    for kind in dict.fromkeys(complaint.kind for complaint in complaints):
        alike = [complaint for complaint in complaints if complaint.kind == kind]
        found += alike[:MOST]
        if len(alike) > MOST:
            found.append(Complaint(f"and {len(alike) - MOST} more {_WHAT[kind]}", kind=kind))
    return found
