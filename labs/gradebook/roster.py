"""The students of a course, from a CSV file: a plain one, or the one that Canvas or Moodle exports and takes back.

| | columns that are read |
|---|---|
| plain | `student_id`, and `name` and `email` if there are such |
| Canvas' gradebook | `Student`, `ID`, `SIS User ID`, `SIS Login ID` |
| Moodle's grading worksheet | `Identifier` (`Participant 4711`), `Full name`, `Email address`, `ID number` |
"""

from __future__ import annotations

import csv
import io
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from labs.gradebook.layouts import CANVAS, GRADESCOPE, MOODLE, NBGRADER, PLAIN, Owner
from reference.errors import InvalidInput

MOST_BYTES = 10 * 2**20
BYTE_ORDER_MARK = "\ufeff"
_CANVAS, _MOODLE, _PLAIN = ("Student", "ID"), ("Identifier", "Full name"), ("student_id",)
_PARTICIPANT = re.compile(r"^\D*(\d+)$")
POINTS_POSSIBLE = "points possible"
_NO_STUDENT = (POINTS_POSSIBLE, "student, test")
"""In Canvas' file: a line of the points, and a student who exists for trying."""


@dataclass(frozen=True)
class Student:
    """A student. id: unique in the course. keys: by platform, the numbers and names by which it calls the student."""

    id: str
    name: str = ""
    email: str = ""
    keys: Mapping[str, frozenset[str]] = field(default_factory=dict, compare=False)


@dataclass(frozen=True)
class Roster:
    """All students. kind: whose file it was. header, lines: what the file says, to be filled in and given back.

    places: the line of each student, from 0. newline, mark: how its lines end, and the byte-order mark that it began
    with, empty if it had none.
    """

    students: tuple[Student, ...]
    kind: str = PLAIN
    header: tuple[str, ...] = ()
    lines: tuple[tuple[str, ...], ...] = field(default=(), repr=False)
    places: tuple[int, ...] = ()
    newline: str = "\n"
    mark: str = ""

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
        If the file is missing, is no CSV file with such columns, or names a student twice.
    """
    try:
        read = path.read_bytes()[: MOST_BYTES + 1].decode("utf-8")
    except OSError as error:
        raise InvalidInput(f"cannot read the roster {str(path)!r}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InvalidInput(f"{str(path)!r} is not UTF-8 text: save the roster as CSV in UTF-8") from None
    text = read.removeprefix(BYTE_ORDER_MARK)
    if len(text) > MOST_BYTES:
        raise InvalidInput(f"{str(path)!r} has more than 10 MB: a roster is smaller")
    try:
        written, *lines = list(csv.reader(io.StringIO(text, newline=""), strict=True)) or [[]]
    except csv.Error as error:
        raise InvalidInput(f"{str(path)!r} is no CSV file: {error}") from None
    header = [each.strip() for each in written]
    kind = next((kind for kind, needs in _KINDS.items() if set(needs) <= set(header)), None)
    if kind is None:
        needed = " or ".join(", ".join(needs) for needs in _KINDS.values())
        raise InvalidInput(f"{str(path)!r} has the columns {', '.join(header)}; a roster has {needed}")
    rows = [dict(zip(header, line, strict=False)) for line in lines]
    people = {place: _READERS[kind](row) for place, row in enumerate(rows) if any(row.values())}
    kept = {place: each for place, each in people.items() if each.id and plain(each.name) not in _NO_STUDENT}
    ids = [each.id for each in kept.values()]
    if twice := next((each for each in ids if ids.count(each) > 1), ""):
        raise InvalidInput(f"{str(path)!r} has the student {twice!r} twice")
    if not kept:
        raise InvalidInput(f"{str(path)!r} names no student")
    newline, mark = "\r\n" if text.partition("\n")[0].endswith("\r") else "\n", read[: len(read) - len(text)]
    return Roster(tuple(kept.values()), kind, tuple(written), tuple(map(tuple, lines)), tuple(kept), newline, mark)


def of_everybody(owners: Iterable[Owner]) -> Roster:
    """A roster of those who handed something in, where a course has none."""
    return Roster(tuple(Student(each.key, each.name, keys={each.platform: frozenset({each.key})}) for each in owners))


def plain(text: str) -> str:
    """A name or number in one spelling: no accents, no case, single spaces."""
    bare = "".join(each for each in unicodedata.normalize("NFKD", text) if not unicodedata.combining(each))
    return " ".join(bare.casefold().split())


_FREE = (PLAIN, NBGRADER)
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


def _of_canvas(row: Mapping[str, str]) -> Student:
    login, number = row.get("SIS Login ID", "").strip(), row.get("ID", "").strip()
    others = frozenset({login, row.get("SIS User ID", "").strip()} - {""})
    email, keys = login if "@" in login else "", {CANVAS: frozenset({number}), GRADESCOPE: others, PLAIN: others}
    return Student(row.get("SIS User ID", "").strip() or login or number, row.get("Student", "").strip(), email, keys)


def _of_moodle(row: Mapping[str, str]) -> Student:
    found = _PARTICIPANT.match(row.get("Identifier", "").strip())
    number = found[1] if found else ""
    own = row.get("ID number", "").strip()
    return Student(own or number, row.get("Full name", "").strip(), row.get("Email address", "").strip(),
                   {MOODLE: frozenset({number} - {""})})  # fmt: skip


def _of_ours(row: Mapping[str, str]) -> Student:
    others = {
        platform: frozenset({row.get(column, "").strip()} - {""})
        for platform, column in ((CANVAS, "canvas_id"), (MOODLE, "moodle_id"), (GRADESCOPE, "gradescope_sid"))
    }
    return Student(row["student_id"].strip(), row.get("name", "").strip(), row.get("email", "").strip(), others)


_KINDS = {CANVAS: _CANVAS, MOODLE: _MOODLE, PLAIN: _PLAIN}
_READERS = {CANVAS: _of_canvas, MOODLE: _of_moodle, PLAIN: _of_ours}
