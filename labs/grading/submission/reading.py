"""Reads a student's file as the source text of the wanted functions, and says what is wrong with the file.

The file is never run here. It is read (`cells`), freed of lines that only a notebook understands (`magics`), and cut
down to what the functions need (`slicing`). Lines that are left out remain as empty lines, so that an error's line
number leads back to the student's own line, and in a notebook to the code cell.

If a function is defined several times, its last definition counts, unless a cell was made for it: one that is tagged
with the function's name, or that nbgrader knows by that name. A function may be written in several versions, the
first ones for simpler cases in cells that are tagged `draft-NAME`; the last version that is written counts.
"""

from __future__ import annotations

import ast
import functools
import warnings
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from labs.grading.errors import UnreadableSubmission
from labs.grading.safe_text import one_line
from labs.grading.submission.cells import Cell, Complaint, place, read_cells
from labs.grading.submission.complaints import (
    Located,
    below_a_magic,
    definitions,
    few,
    in_cells_of_text,
    misplaced,
    misspelt,
    not_at_hand,
    not_filled,
    unreadable,
    with_its_cost,
)
from labs.grading.submission.kept_text import assembled, kept_pieces
from labs.grading.submission.magics import without_magics
from labs.grading.submission.slicing import needed, used_by
from labs.grading.submission.statements import Group, called_in, defined_as, groups
from labs.grading.submission.stubs import is_open_version, is_stub

__all__ = ["Complaint", "Submission", "read"]

DRAFT = "draft-"
"""Begins the tag of a cell for a first version of a function."""
_TOO_MUCH = (ValueError, RecursionError, MemoryError)  # raised by ast for text that no person writes


@dataclass(frozen=True)
class Submission:
    """What a student handed in.

    name: the file's, fit to be shown. text: Python source of the functions and what they need. functions: the wanted
    ones that it defines, in the order in which they were wanted. complaints: what the student should know. starts: the
    number of lines of `text` before each code cell, with the cell's number; empty for a `.py` file. unread: wanted
    functions in text that Python cannot read.
    """

    name: str
    text: str
    functions: tuple[str, ...] = ()
    complaints: tuple[Complaint, ...] = ()
    starts: tuple[tuple[int, int], ...] = ()
    unread: tuple[str, ...] = ()

    def uses(self, name: str) -> list[str]:
        """The functions of the submission that one of them calls, directly or through other code that it needs."""
        return used_by(self._groups, name, self.functions)

    def reached(self, name: str) -> set[str]:
        """The functions of the submission that one of them calls, directly or through others, without itself."""
        waiting, seen = [name], {name}
        while waiting:
            found = set(self.uses(waiting.pop())) - seen
            seen |= found
            waiting += found
        return seen - {name}

    def code_of(self, name: str) -> str:
        """What a function is made of besides other functions of the lab: the same whatever its layout and place.

        In a kernel's history it stands as often as its cell was run, and only the last time counts.
        """
        others = frozenset(self.functions) - {name}
        last = {each: group for group in self._groups for each in group.defines}
        own = [
            group
            for group in self._groups
            if not group.defines & others
            and not any(last[each] is not group and defined_as(group, each) == "def" for each in group.defines)
        ]
        kept = [own[at] for at in needed(own, [name])]
        try:
            return "\n".join(sorted({ast.unparse(each) for group in kept for each in group.statements}))
        except RecursionError:  # a sum of hundreds of terms: the text as it stands
            lines = self.text.split("\n")
            return "\n".join(line for group in kept for line in lines[group.first - 1 : group.last])

    def function_at(self, line: int | None) -> str | None:
        """The function of the submission that contains a line of the text, if one does."""
        around = (group for group in self._groups if line and group.first <= line <= group.last)
        return next((name for group in around for name in self.functions if name in group.defines), None)

    def is_compound(self, line: int) -> bool:
        """Whether the statement in a line holds others, as a loop does."""
        return any(group.is_compound for group in self._groups if group.first <= line <= group.last)

    def without(self, text: str, line: int | None) -> str | None:
        """A text of this submission without the statements in a line; None if there are none in it."""
        around = [group for group in self._groups if line and group.first <= line <= group.last]
        lines = text.split("\n")
        for group in around:
            lines[group.first - 1 : group.last] = [""] * (group.last - group.first + 1)
        return "\n".join(lines) if around and "\n".join(lines) != text else None

    def left_out(self, line: int | None, why: str) -> Complaint:
        """That the statement in a line was left out, because of what it did on loading."""
        return Complaint(f"{self.where(line or 1)}: this statement was left out, because it {why}")

    def borrows(self, name: str) -> dict[str, str]:
        """Variables in lower case that a function of a notebook takes from other cells, with the cell that set each.

        An example is `step`, left behind by a plot, where an argument was meant. What the function calls is a helper,
        and so is a name that a later cell gives to a function.
        """
        own = [group for group in self._groups if name in group.defines]
        used, here = {each for group in own for each in group.uses}, {self._cell(group) for group in own}
        called = {each for group in own for each in called_in(group)}
        last = {each: group for group in self._groups for each in sorted(group.defines & used - called)}
        return {
            variable: self._cell(group)
            for variable, group in last.items()
            if variable.islower() and defined_as(group, variable) == "value" and self._cell(group) not in here
        }

    def _cell(self, group: Group) -> str:
        return self.where(group.first).rpartition(", ")[0]

    @functools.cached_property
    def _groups(self) -> tuple[Group, ...]:
        try:
            return groups(self.text)
        except (SyntaxError, *_TOO_MUCH):  # each cell may be valid, and all of them together not
            return ()

    def where(self, line: int) -> str:
        """A line of the text in the student's words: "line 12", or "code cell 3, line 2"."""
        before = [(start, cell) for start, cell in self.starts if start < line]
        return place(before[-1][1], line - before[-1][0]) if before else place(None, line)


def read(path: Path | str, wanted: Collection[str], also: Collection[str] = ()) -> Submission:
    """Read a `.ipynb` or `.py` file, looking for the wanted functions.

    also: functions that are kept if they are defined, and not missed otherwise. Raises `UnreadableSubmission` if the
    file holds no code at all; anything less is a complaint.
    """
    path = Path(path)
    name = one_line(path.name or path.absolute().name or str(path))
    try:
        every, complaints = read_cells(path)
    except UnreadableSubmission as error:
        raise UnreadableSubmission(f"{name}: {error}") from None
    cells, texts = [cell for cell in every if cell.code], [cell for cell in every if not cell.code]
    pieces, sources, unread = list[Located](), list[str](), list[tuple[Cell, Complaint]]()
    for cell in cells:
        source, found, complaint = _parsed(cell)
        sources.append(source)
        pieces += [Located(group, cell) for group in found]
        if complaint:
            unread.append((cell, complaint))
    pieces = _without_open_versions(pieces)
    defined = {name: piece.cell for piece in pieces for name in piece.group.defines}
    complaints += [with_its_cost(complaint, cell, defined) for cell, complaint in unread]
    functions = [each for each in wanted if _check_definition(each, pieces, complaints)]
    missing = [each for each in wanted if each not in defined]
    complaints.extend(misplaced(missing, pieces))
    complaints.extend(in_cells_of_text(missing, texts))
    complaints.extend(below_a_magic(missing, cells))
    complaints.extend(misspelt(missing, pieces))
    if missing:
        text = f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing"
        complaints.append(Complaint(text, kind="missing"))
    functions += [name for name in also if name in defined and name not in wanted]
    kept = kept_pieces(pieces, functions)
    complaints.extend(not_at_hand(functions, kept, pieces))
    complaints.extend(not_filled(functions, kept, pieces))
    text, starts = assembled(cells, sources, kept)
    lost = {each for cell, _ in unread for each in definitions(cell.source)}
    return Submission(
        name, text, tuple(functions), tuple(few(complaints)), starts, tuple(each for each in missing if each in lost)
    )


def _parsed(cell: Cell) -> tuple[str, tuple[Group, ...], Complaint | None]:
    """The cell's Python and its statements; empty, with a complaint, if Python cannot read it."""
    source = cell.source
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about a backslash in a text: the student sees that elsewhere
        try:
            return source, groups(source), None
        except (SyntaxError, *_TOO_MUCH):
            source = without_magics(source)
        try:
            return source, groups(source), None
        except (SyntaxError, *_TOO_MUCH) as error:
            return "", (), unreadable(error, cell, source)


def _without_open_versions(pieces: list[Located]) -> list[Located]:
    """The pieces without the versions of functions that are not written yet, if another version is."""
    still_open = [piece for piece in pieces if all(map(is_open_version, piece.group.statements))]
    if not still_open:
        return pieces
    others = [piece for piece in pieces if piece not in still_open and not all(map(is_stub, piece.group.statements))]
    written = {name for piece in others for name in piece.group.defines}
    return [piece for piece in pieces if piece not in still_open or not piece.group.defines <= written]


def _check_definition(name: str, pieces: list[Located], complaints: list[Complaint]) -> bool:
    """Whether the submission defines the function; complains of copies, and of an import instead of a definition."""
    found = [piece for piece in pieces if defined_as(piece.group, name)]
    kinds = {defined_as(piece.group, name) for piece in found}
    if kinds == {"import"}:
        complaints.append(Complaint(f"{name} is imported, not written", found[-1].cell.number, found[-1].group.first))
        return False
    if len([piece for piece in found if f"{DRAFT}{name}" not in piece.cell.tags]) > 1:
        counts = _counting(name, found)
        where = place(counts.cell.number, counts.group.first)
        text = f"{name} is defined {len(found)} times; the one at {where} counts"
        complaints.append(Complaint(text, kind="repeated"))
    return bool(found)


def _counting(name: str, found: list[Located]) -> Located:
    """The definition that counts: the last one, or the last one in a cell made for it."""
    return ([piece for piece in found if name in piece.cell.tags] or found)[-1]
