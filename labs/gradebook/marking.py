"""The tables into which markers write points, with any spreadsheet: read, checked, and continued without any loss.

A line that somebody has filled in stays as it is, with the columns that a marker has added. A table to which nothing is
to be added is not touched at all.
"""

from __future__ import annotations

import difflib
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from labs.gradebook.sheets import Row, Sheet, number_in, plain, read_sheet
from labs.gradebook.tables import runs_as_formula
from labs.grading.judging.grade import write_private
from labs.grading.safe_text import one_line
from reference.errors import InvalidInput, listed

COLUMNS = ("question", "code", "possible", "points", "comment")
_NEEDED = ("question", "code", "points")
MOST_SAID = 5
"""So many wrong lines, and so many codes that may be meant, are named."""
Key = tuple[str, str]
"""A question and a code."""


@dataclass(frozen=True)
class Given:
    """Points that a marker gave for an answer, None if it is not marked yet."""

    points: float | None
    comment: str = ""

    @property
    def filled(self) -> bool:
        """Whether somebody has written something."""
        return self.points is not None or bool(self.comment)


@dataclass(frozen=True)
class Table:
    """A table as a marker saved it. given: what the marker wrote. places: the line of each, from 0."""

    path: Path
    sheet: Sheet = field(repr=False)
    possible: Mapping[str, int]
    given: Mapping[Key, Given]
    places: Mapping[Key, int] = field(repr=False)

    def write(self, wanted: Sequence[tuple[str, str, int]]) -> None:
        """Continue the table: with the lines that are wanted, and all others that somebody has filled in."""
        there = {line[:2] for line in wanted}
        kept = [key for key, given in self.given.items() if given.filled and key not in there]
        lines = [*wanted, *((question, code, self.possible[question]) for question, code in kept)]
        rows = [self._row(*line) for line in lines]
        if {line[:2] for line in lines} == self.places.keys() and set(rows) <= set(self.sheet.lines):
            return
        write_private(self.path, self.sheet.dialect.text([self.sheet.header, *rows]))

    def _row(self, question: str, code: str, possible: int) -> tuple[str, ...]:
        """A line as the marker left it, or an empty one."""
        place = self.places.get((question, code))
        new = {"question": question, "code": code}
        cells = (
            list(self.sheet.lines[place])
            if place is not None
            else [new.get(plain(each), "") for each in self.sheet.header]
        )
        for at in self.sheet.places("possible"):
            cells[at] = str(possible)
        return tuple(cells)

    def refuse_codes_of_nobody(self, known: Collection[str]) -> None:
        """Refuse a line that gives points to a code that nobody has, as after a spreadsheet took it for a number."""
        wrong = [key for key, given in self.given.items() if given.filled and key[1] not in known]
        _refuse(
            f"{self._where(key)} has the code {key[1]!r}, which nobody has{self._meant(key, known)}" for key in wrong
        )

    def _where(self, key: Key) -> str:
        return f"line {self.sheet.numbers[self.places[key]]} of {self.path.name}"

    def _meant(self, key: Key, known: Collection[str]) -> str:
        """The codes that a line may mean: of those without a line, the ones that a spreadsheet shows so, or similar."""
        question, code = key
        free = sorted(each for each in known if (question, each) not in self.places)
        same = [each for each in free if _as_shown(each) is not None and _as_shown(each) == _as_shown(code)]
        close = same or difflib.get_close_matches(code, free, MOST_SAID, 0.5) or free[:MOST_SAID]
        return f"; perhaps it is {' or '.join(close)}" if close else ""


def _as_shown(code: str) -> float | None:
    """The number for which a spreadsheet takes a code."""
    try:
        return float(code.replace(",", "."))
    except ValueError:
        return None


def read_table(path: Path, possible: Mapping[str, int]) -> Table:
    """What a marker has filled in; an empty table if there is no file yet. possible: points by question.

    Raises
    ------
    InvalidInput
        If a line has another question, no code, or points that its question does not have: the message names the lines.
    """
    if not path.is_file():
        return Table(path, Sheet(path.name, COLUMNS), possible, {}, {})
    sheet = read_sheet(path, COLUMNS)
    if any(len(sheet.places(each)) != 1 for each in _NEEDED):
        raise InvalidInput(
            f"{str(path)!r} has the columns {', '.join(sheet.header) or 'of an empty file'}; it needs"
            f" {listed(_NEEDED)} once each. If you move the file away, the command writes a new one."
        )
    given, places, wrong = dict[Key, Given](), dict[Key, int](), list[str]()
    for place, row in enumerate(sheet.rows()):
        where = f"line {row.number} of {path.name}"
        key, what, said = _read(row, possible)
        if said:
            wrong.append(f"{where} {said}")
        elif key in given and given[key].filled and what.filled and what != given[key]:
            before = sheet.numbers[places[key]]
            wrong.append(f"{where} and line {before} mark the same answer, {key[1]}, and do not agree")
        elif key not in given or what.filled:
            given[key], places[key] = what, place
    _refuse(wrong)
    return Table(path, sheet, possible, given, places)


def _read(row: Row, possible: Mapping[str, int]) -> tuple[Key, Given, str]:
    """A line, and what is wrong with it."""
    asked = {plain(key): key for key in possible}
    question, code, text = asked.get(plain(row["question"]), ""), row["code"].upper(), row["points"]
    comment = row["comment"]
    if comment.startswith("'") and runs_as_formula(comment[1:]):  # as earlier releases wrote it
        comment = comment[1:]
    points = number_in(text)
    given = Given(points, comment)
    if not question:
        said = f"has the question {row['question']!r}; there are {', '.join(possible)}"
    elif text and points is None:
        said = f"has {one_line(text, 60)!r} points: write a number"
    elif points is not None and not 0 <= points <= possible[question]:
        said = f"gives {points:g} points; the question {question} has {possible[question]}"
    else:
        said = "has no code" if given.filled and not code else ""
    return (question, code), given, said


def _refuse(wrong: Iterable[str]) -> None:
    """Raise if something is wrong: with the first lines, and how many there are."""
    every = list(wrong)
    more = f". There are {len(every) - MOST_SAID} others like these" if len(every) > MOST_SAID else ""
    if every:
        raise InvalidInput(f"{'; '.join(every[:MOST_SAID])}{more}. Correct this, and run the command again.")
