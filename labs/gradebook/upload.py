"""The marks in a platform's own file, to be uploaded: Canvas' gradebook, or Moodle's grading worksheet.

A mark goes into one column that cannot be mistaken for another one, and is scaled to the points that the platform gives
for the lab. Of Canvas' gradebook only this column and those that say who a student is are written, so that an upload
changes no other assignment. A cell without a mark of ours stays as it is, and so does Canvas' `EX` (excused).

Threat: names are hostile text, and a spreadsheet may run a cell as a formula. What the platform reads back (numbers,
logins, headings) is written exactly as it came. Neither platform reads names, so a name that would run as a formula
gets an apostrophe before it, and every other name is written as it came.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace

from labs.gradebook import moodle
from labs.gradebook.layouts import CANVAS, MOODLE
from labs.gradebook.roster import POINTS_POSSIBLE, Roster
from labs.gradebook.sheets import number_in, plain
from labs.gradebook.tables import OUT_OF, Mark, number, runs_as_formula
from reference import lecture
from reference.errors import InvalidInput, UnknownName

NO_COLUMN = "none"
"""What the option says if no file is to be written for the platform."""
_ASSIGNMENT = re.compile(r"^(?P<title>.+) \((?P<number>\d+)\)$")
"""A column of Canvas that belongs to an assignment; every other one is computed and cannot be filled."""
_NAMES = ("Student", "LastName", "FirstName")
_NUMBERS = ("ID", "SIS User ID", "SIS Login ID", "Integration ID")
_WHO = (*_NAMES, *_NUMBERS, "Root Account", "Section")
"""The columns by which Canvas finds a student, in the order in which it writes them; it reads the numbers back."""
_READ_BACK = ("identifier", "grade", "maximum", "graded", "comments")
"""What Moodle reads back."""
_EXCUSED = "EX"


@dataclass(frozen=True)
class Target:
    """Where the marks go. place: of the column, from 0. title: its heading. possible: the points of the lab there.

    possible is None if the file does not say it; the marks are then of a hundred.
    """

    platform: str
    place: int
    title: str
    possible: float | None

    @property
    def scale(self) -> float:
        """What a mark of a hundred is multiplied with."""
        return 1.0 if self.possible is None else self.possible / OUT_OF

    @property
    def said(self) -> str:
        """Which column it is, and of how many points, in words."""
        if self.possible is None:
            return f"column {self.title!r}; the file does not say its maximum, so the marks are of {OUT_OF:g} points"
        if self.possible == OUT_OF:
            return f"column {self.title!r}, of {OUT_OF:g} points"
        factor = f"every mark of {OUT_OF:g} is multiplied by {self.scale:g}"
        return f"column {self.title!r}, which has {self.possible:g} points, so {factor}"


def target(roster: Roster, lab: str, column: str = "") -> Target | None:
    """The column of a roster for a lab; None if the roster is no platform's, or no column is wanted.

    column: its heading, its title without the number, its number alone, or `none`. Without it, the column whose title
    is the lab's.

    Raises
    ------
    InvalidInput
        If it is not clear which column is meant, or the lab has no points there. The message names the columns.
    """
    if column.strip() == NO_COLUMN:
        return None
    if column and roster.kind != CANVAS:
        raise InvalidInput("--column chooses a column of Canvas' gradebook, and the roster is none: leave it out")
    if roster.kind == CANVAS:
        return _with_points(_in_canvas(roster, lab, column))
    return _with_points(_in_moodle(roster)) if roster.kind == MOODLE else None


def _in_canvas(roster: Roster, lab: str, column: str) -> Target:
    matched = ((place, _ASSIGNMENT.match(each.strip())) for place, each in enumerate(roster.sheet.header))
    every = {place: found for place, found in matched if found}
    names = [plain(each) for each in ([column] if column else [lab, lecture.topic(lab).title])]
    fit = [
        place for place, found in every.items()
        if any(name in (plain(found[0]), plain(found["title"]), column and found["number"]) for name in names)
    ]  # fmt: skip
    choices = [found[0] for found in every.values()]
    if len(fit) == 1:
        return Target(CANVAS, fit[0], every[fit[0]][0], _points_possible(roster, fit[0]))
    if column and not fit:
        raise UnknownName("assignment of --column", column, choices)
    several = f"{len(fit)} columns" if fit else "no column"
    titled = " or ".join(map(repr, [column] if column else [lab, lecture.topic(lab).title]))
    raise InvalidInput(
        f"Canvas' gradebook has {several} titled {titled}."
        f" Say where the marks belong: --column with one of these, or with its number: {'; '.join(choices) or 'none'}."
        f" With --column {NO_COLUMN} no file is made for Canvas."
    )


def _points_possible(roster: Roster, place: int) -> float | None:
    who = next(at for at, heading in enumerate(roster.sheet.header) if heading.strip() in _NAMES)
    lines = (line for line in roster.sheet.lines if plain(line[who]) == POINTS_POSSIBLE)
    return next((number_in(line[place]) for line in lines), None)


def _in_moodle(roster: Roster) -> Target:
    sheet = roster.sheet
    columns = _in_words(roster)
    grades = sheet.places(columns["grade"]) if "grade" in columns else []
    if len(grades) != 1:
        raise InvalidInput(
            f"Moodle's worksheet has {len(grades) or 'no'} columns 'Grade' for the marks; it has"
            f" {', '.join(sheet.header)}. Download it from the assignment, or write --column {NO_COLUMN} to get no file"
            " for Moodle."
        )
    title = sheet.header[grades[0]].strip()
    maximum = next(iter(sheet.places(columns["maximum"])), None) if "maximum" in columns else None
    most = {None if maximum is None else number_in(sheet.lines[place][maximum]) for place in roster.places}
    if len(most) > 1:
        heading = sheet.header[maximum or 0].strip()
        raise InvalidInput(f"the students of Moodle's worksheet have different values of {heading!r}")
    return Target(MOODLE, grades[0], title, most.pop())


def _in_words(roster: Roster) -> dict[str, str]:
    """What the columns of Moodle's worksheet mean, in its language."""
    words = moodle.language_of(roster.sheet.header)
    return words.columns(roster.sheet.header) if words else {}


def _with_points(found: Target) -> Target:
    if found.possible == 0:
        raise InvalidInput(
            f"{found.title!r} has 0 points in {found.platform}, so every mark would be 0: give it points there and"
            f" export the file again, or write --column {NO_COLUMN}"
        )
    return found


def filled(roster: Roster, marks: Iterable[Mark], to: Target) -> str:
    """The platform's file with the marks in it, as UTF-8, with the line ends that it had.

    Canvas recognises semicolons. Moodle expects the commas that it writes.
    """
    by_id = {mark.student.id: mark for mark in marks}
    lines = [list(line) for line in roster.sheet.lines]
    for place, student in zip(roster.places, roster.students, strict=True):
        mark = by_id.get(student.id)
        if mark is not None and mark.score is not None and lines[place][to.place].strip().upper() != _EXCUSED:
            lines[place][to.place] = number(mark.score * to.scale)
    columns, exact = _columns(roster, to), _read_back(roster, to)
    every = [
        [line[place] if place in exact else _harmless(line[place]) for place in columns]
        for line in lines
    ]  # fmt: skip
    dialect = roster.sheet.dialect
    if to.platform == MOODLE:
        dialect = replace(dialect, delimiter=",")
    return dialect.text([[roster.sheet.header[place] for place in columns], *every])


def _columns(roster: Roster, to: Target) -> list[int]:
    if to.platform == MOODLE:
        return list(range(len(roster.sheet.header)))
    return [place for place, each in enumerate(roster.sheet.header) if place == to.place or each.strip() in _WHO]


def _read_back(roster: Roster, to: Target) -> set[int]:
    """The columns that the platform reads, which are written exactly as they came."""
    headings = {plain(each) for each in _NUMBERS}
    if to.platform == MOODLE:
        columns = _in_words(roster)
        headings = {columns[meaning] for meaning in _READ_BACK if meaning in columns}
    return {to.place, *(place for place, each in enumerate(roster.sheet.header) if plain(each) in headings)}


def _harmless(cell: str) -> str:
    """A cell as it came, unless a spreadsheet would run it: a number such as −1 runs nothing."""
    return f"'{cell}" if number_in(cell) is None and runs_as_formula(cell) else cell
