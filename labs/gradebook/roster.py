"""The students of a course, from a CSV file: a plain one, or the one that a platform exports.

| | columns that are read |
|---|---|
| Canvas' gradebook | `Student`, or `LastName` and `FirstName`; `ID`, `SIS User ID`, `SIS Login ID` |
| Moodle's grading worksheet | `Identifier` (`Participant 4711`), `Full name`, `Email address`, `ID number` |
| plain | `student_id` or `Matrikelnummer`, and `name` or first and last name, and `email` if there are such |
| Gradescope, Brightspace, Blackboard | as a plain one: `SID`, `OrgDefinedId`, `Student ID` or `Username` |

Moodle's columns are found in every language of `moodle.toml`; two of them say when a submission came.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from labs.gradebook import moodle
from labs.gradebook.layouts import BLACKBOARD, CANVAS, GRADESCOPE, MOODLE, NBGRADER, PLAIN, Owner
from labs.gradebook.sheets import Row, Sheet, plain, read_sheet
from labs.gradebook.times import Received
from reference.errors import InvalidInput

_PARTICIPANT = re.compile(r"^\D*(\d+)$")
POINTS_POSSIBLE = "points possible"
_NO_STUDENT = (POINTS_POSSIBLE, "student, test")
"""In Canvas' file: a line of the points, and a student who exists for trying."""
_CANVAS = (("Student", "ID"), ("LastName", "FirstName", "ID"))
"""What Canvas' gradebook has at least; an instructor may choose to have the names in two columns."""
_OWN = ("student_id", "student id", "sid", "orgdefinedid", "username", "matrikelnummer", "matrikelnr", "matrikelnr.")
"""What a table may call a student's number, the best first."""
_SHORTENED = re.compile(r"[1-9](?:[.,]\d+)?E\+\d+", re.IGNORECASE)
_FIRST, _LAST = ("first_name", "first name", "vorname"), ("last_name", "last name", "nachname")
_OTHERS = ("name", "full name", *_FIRST, *_LAST, "email")


@dataclass(frozen=True)
class Student:
    """A student. id: unique in the course. keys: by platform, the numbers and names by which it calls the student.

    received: when the student's submission came, if the roster says so.
    """

    id: str
    name: str = ""
    email: str = ""
    keys: Mapping[str, frozenset[str]] = field(default_factory=dict, compare=False)
    received: Received = field(default=Received(), compare=False)


@dataclass(frozen=True)
class Roster:
    """All students. kind: whose file it was. sheet: what the file says, to be filled in and given back.

    places: the line of each student, from 0.
    """

    students: tuple[Student, ...]
    kind: str = PLAIN
    sheet: Sheet = field(default=Sheet(""), repr=False)
    places: tuple[int, ...] = ()

    def owner(self, owner: Owner, email: str = "") -> Student | None:
        """The student whom a platform's name of a submission means; None if it means nobody, or several.

        A number is compared with numbers of the same platform alone: Canvas' number of one student may be the course's
        number of another. If it is nobody's, the address and the name are tried.
        """
        said = [(owner.key, _numbers), (email, _addresses), (owner.name, _names)]
        if owner.platform in _FREE:
            said += [(owner.key, _addresses), (owner.key, _names)]
        for text, of in said:
            found = [each for each in self.students if plain(text) in of(each, owner.platform)] if text else []
            if found:
                return found[0] if len(found) == 1 else None
        return None


def read_roster(path: Path) -> Roster:
    """Read a roster.

    Raises
    ------
    InvalidInput
        If the file is missing, is no table with such columns, or names a student twice.
    """
    known = {*(heading for each in _CANVAS for heading in each), *moodle.every_heading(), *_OWN, *_OTHERS}
    sheet = read_sheet(path, known)
    kind, reader = _reader(sheet, path)
    people = [reader(row) for row in sheet.rows()]
    _refuse_lost_numbers(sheet, kind, people)
    kept = {place: each for place, each in enumerate(people) if each.id and plain(each.name) not in _NO_STUDENT}
    if not kept:
        raise InvalidInput(f"{str(path)!r} names no student")
    student, times = Counter(each.id for each in kept.values()).most_common(1)[0]
    if times > 1:
        lines = [str(sheet.numbers[place]) for place, each in kept.items() if each.id == student]
        raise InvalidInput(f"{str(path)!r} has the student {student!r} twice, in the lines {' and '.join(lines[:2])}")
    return Roster(tuple(kept.values()), kind, sheet, tuple(kept))


def _refuse_lost_numbers(sheet: Sheet, kind: str, people: Iterable[Student]) -> None:
    """Refuse a line that names nobody, and a number that a spreadsheet has shortened: the student would be lost."""
    for line, student in zip(sheet.numbers, people, strict=True):
        numbers = [student.id, *(key for keys in student.keys.values() for key in keys)]
        if short := next(filter(_SHORTENED.fullmatch, numbers), ""):
            raise InvalidInput(
                f"line {line} of {sheet.name} has the number {short!r}, which a spreadsheet has shortened. Format its"
                " column as text there, or save the roster from the platform without opening it."
            )
        if kind == PLAIN and not student.id:
            raise InvalidInput(f"line {line} of {sheet.name} has no number of a student ({student.name or 'no name'})")


def _reader(sheet: Sheet, path: Path) -> tuple[str, Callable[[Row], Student]]:
    """Whose file a table is, and what reads a line of it."""
    there = {plain(each) for each in sheet.header}
    if any({plain(each) for each in needs} <= there for needs in _CANVAS):
        return CANVAS, _of_canvas
    if words := moodle.language_of(sheet.header):
        columns = words.columns(sheet.header)
        return MOODLE, lambda row: _of_moodle(row, columns, words)
    if there & set(_OWN):
        return PLAIN, _of_ours
    raise InvalidInput(
        f"{str(path)!r} has the columns {', '.join(sheet.header) or 'of an empty file'}. A roster is Canvas' gradebook"
        f" (Student, ID), Moodle's grading worksheet (Identifier, Full name), or a table with {' or '.join(_OWN)}."
        " If Moodle's worksheet is in another language, switch Moodle to English and download it again."
    )


def of_everybody(owners: Iterable[Owner]) -> Roster:
    """A roster of those who handed something in, where a course has none."""
    return Roster(tuple(Student(each.key, each.name, keys={each.platform: frozenset({each.key})}) for each in owners))


_FREE = (PLAIN, NBGRADER, BLACKBOARD)
"""Where a folder may have any name: a number, an address, or the student's."""
_OWN_NUMBERS = (CANVAS, MOODLE)
"""Platforms whose numbers are not those of the course."""


def _numbers(student: Student, platform: str) -> set[str]:
    own = {student.id} if platform not in _OWN_NUMBERS else set()
    return {plain(each) for each in (*own, *student.keys.get(platform, ())) if each}


def _addresses(student: Student, platform: str) -> set[str]:
    return {plain(student.email)} - {""}


def _names(student: Student, platform: str) -> set[str]:
    return {plain(each) for each in (student.name, *_turned(student.name)) if each}


def _turned(name: str) -> Sequence[str]:
    """Other forms of a name: `Lovelace, Ada` and `lovelaceada` for `Ada Lovelace`, and the other way round."""
    last, comma, first = name.partition(",")
    if not comma:
        first, _, last = name.rpartition(" ")
    first, last = first.strip(), last.strip()
    squeezed = re.sub(r"[^a-z0-9]", "", plain(last + first))
    return (f"{first} {last}", f"{last}, {first}", squeezed) if first and last else ()


def _of_canvas(row: Row) -> Student:
    name = row["Student"] or _last_first(row["LastName"], row["FirstName"])
    login, number, own = row["SIS Login ID"], row["ID"], row["SIS User ID"]
    others = frozenset({login, own} - {""})
    email, keys = login if "@" in login else "", {CANVAS: frozenset({number}), GRADESCOPE: others, PLAIN: others}
    return Student(own or login or number, name, email, keys)


def _last_first(last: str, first: str) -> str:
    return f"{last}, {first}" if last and first else last or first


def _of_moodle(row: Row, columns: Mapping[str, str], words: moodle.Words) -> Student:
    cells = {meaning: row[heading] for meaning, heading in columns.items()}
    found = _PARTICIPANT.match(cells["identifier"])
    number = found[1] if found else ""
    received = words.received(cells.get("submitted", ""), cells.get("status", ""))
    keys = {MOODLE: frozenset({number} - {""})}
    return Student(cells.get("number") or number, cells.get("name", ""), cells.get("email", ""), keys, received)


def _of_ours(row: Row) -> Student:
    """A student of a table that is no platform's gradebook. Brightspace writes `#` before numbers and logins."""
    first, last = (next((row[each] for each in columns if row[each]), "") for columns in (_FIRST, _LAST))
    name = row["name"] or row["full name"] or _last_first(last, first)
    numbers = [row[column].removeprefix("#") for column in _OWN]
    others = {
        platform: frozenset({row[column]} - {""})
        for platform, column in ((CANVAS, "canvas_id"), (MOODLE, "moodle_id"), (GRADESCOPE, "gradescope_sid"))
    }
    keys = {**others, PLAIN: frozenset({*numbers} - {""})}
    return Student(next((each for each in numbers if each), ""), name, row["email"], keys)
