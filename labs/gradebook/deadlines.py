"""The rules of a course, in a small TOML file: deadlines, what a late submission loses, and whom to ask about a mark.

[due]
impulse = 2026-11-30T23:59:00+01:00

[late]
grace_minutes = 10      # so much later is still in time
free_days = 2           # of each student, for all labs of one run
percent_per_day = 10    # of the points reached, for each further day that has begun
most_days = 5           # later than that, nothing is left

[due.students.4711]     # deadlines of one student, by number
impulse = 2026-12-07T23:59:00+01:00

[regrade]               # whom to ask about a mark: said on each student's page
contact = "Ada Byron, ada@example.org"
days = 14               # so long a student may ask; without it no time is named
"""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

from labs.gradebook.roster import Student
from labs.gradebook.sheets import plain, read_text
from labs.gradebook.times import Received
from reference import checks, lecture
from reference.errors import InvalidInput, UnknownName, listed

DAY = timedelta(days=1)
_SHOWN = timedelta(hours=1)
"""A platform shows a duration of days to the hour."""
NOTHING_OFF = "nothing is taken off"
CALLED_LATE = f"late, says the platform, but not by how much: {NOTHING_OFF}"
NO_TIME = f"at a time that nobody knows: {NOTHING_OFF}"
OTHER_DEADLINE = "Moodle's worksheet judges its lateness by another deadline or clock than the rules"
ANYONE = "your instructor"
_STUDENTS = "students"


@dataclass(frozen=True)
class Lateness:
    """How late a submission is. days: that count, after grace and free days. share: of its points that is left."""

    days: int = 0
    share: float = 1.0
    said: str = ""


@dataclass(frozen=True)
class Deadlines:
    """The rules of a course.

    due: by lab. own: by a student's number, deadlines by lab. grace: that is still in time. free_days: that cost
    nothing. percent: of the points that each further day costs. most_days: after which nothing is left. contact: whom
    a student asks about a mark. days_to_ask: for how long; None if the course names no time.
    """

    due: Mapping[str, datetime] = field(default_factory=dict)
    own: Mapping[str, Mapping[str, datetime]] = field(default_factory=dict)
    grace: timedelta = timedelta(0)
    free_days: int = 0
    percent: float = 0.0
    most_days: int | None = None
    contact: str = ANYONE
    days_to_ask: int | None = None

    def of(self, student: str, lab: str) -> datetime | None:
        """The deadline of a student in a lab; None if there is none."""
        return self.own.get(student, {}).get(lab, self.due.get(lab))

    def lateness(self, student: str, lab: str, received: Received, others_late: bool = False) -> Lateness:
        """How late a submission is. Where nobody knows when it came, this costs nothing, and is said.

        others_late: whether the platform calls other submissions late; one that it does not call late is then in time.
        """
        due = self.of(student, lab)
        over = None if due is None else received.after(due, self.due.get(lab))
        if over is None:
            unknown = "" if due is None or others_late else NO_TIME
            return Lateness(said=CALLED_LATE if received.called_late else unknown)
        if over <= self.grace:
            return Lateness()
        begun = math.ceil(over / DAY)
        days = max(0, begun - self.free_days)
        gone = self.most_days is not None and begun > self.most_days
        share = 0.0 if gone else max(0.0, 1 - self.percent / 100 * days)
        free = f", {min(begun, self.free_days)} of them free" if self.free_days else ""
        off = f": {NOTHING_OFF}" if share == 1 and not free else ""
        return Lateness(days, share, f"{begun} {'day' if begun == 1 else 'days'} late{free}{off}")

    def is_judged_otherwise(self, student: str, lab: str, received: Received) -> bool:
        """Whether the platform counts lateness from another deadline, as after it has given a student more time."""
        own, everybodys = self.of(student, lab), self.due.get(lab)
        if own is None or received.at is None or not received.says_lateness:
            return False
        if (late_by := received.late_by) is None:
            return (received.after(own) or timedelta(0)) > self.grace
        overs = [received.after(due) for due in (own, everybodys) if due is not None]
        return all(over is None or abs(over - late_by) > _SHOWN for over in overs)

    def without_student(self, students: Collection[Student]) -> str:
        """Who has a deadline of their own and is none of these students, with similar ones; empty if nobody is."""
        known = {student.id for student in students}
        return listed([_nobody(number, students) for number in self.own if number not in known])


def _nobody(number: str, students: Collection[Student]) -> str:
    """A number that no student has, and the students who may be meant: the same by another name, or a similar one."""
    by_word: dict[str, Student] = {}
    for each in students:
        others = [key for keys in each.keys.values() for key in keys]
        by_word |= {plain(word): each for word in (*others, each.name, each.email, each.id) if word}
    meant = [by_word[word] for word in difflib.get_close_matches(plain(number), by_word, 3, 0.7)]
    shown = " or ".join(f"{each.id} ({each.name})" if each.name else each.id for each in dict.fromkeys(meant))
    return f"{number!r} (perhaps {shown})" if shown else repr(number)


def read_deadlines(path: Path) -> Deadlines:
    """Read the rules.

    Raises
    ------
    InvalidInput
        If the file is missing, is no TOML, or has a name or value that it may not have.
    """
    try:
        content = tomllib.loads(read_text(path))
    except OSError as error:
        raise InvalidInput(f"cannot read the rules {str(path)!r}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InvalidInput(f"{str(path)!r} is no TOML file: {error}") from None
    _only(content, {"due", "late", "regrade"}, "the rules")
    due, late, ask = dict(_table(content, "due")), _table(content, "late"), _table(content, "regrade")
    students = _table(due, _STUDENTS)
    due.pop(_STUDENTS, None)
    _only(late, set(_LATE), "[late]")
    _only(ask, set(_REGRADE), "[regrade]")
    contact = ask.get("contact", ANYONE)
    if not isinstance(contact, str):
        raise InvalidInput(f"contact is {contact!r} in the rules; it is a text in quotes")
    return Deadlines(
        _moments(due),
        {str(number): _moments(_table(students, number)) for number in students},
        timedelta(minutes=_number(late, "grace_minutes")),
        int(_number(late, "free_days")),
        100 * checks.fraction("percent_per_day / 100", _number(late, "percent_per_day") / 100),
        int(_number(late, "most_days")) if "most_days" in late else None,
        contact,
        int(_number(ask, "days")) if "days" in ask else None,
    )


_MOST = 10**6
_REGRADE = ("contact", "days")
_LATE = ("grace_minutes", "free_days", "percent_per_day", "most_days")


def _only(table: Mapping[str, Any], known: set[str], where: str) -> None:
    for name in table:
        if name not in known:
            raise UnknownName(f"entry of {where}", name, sorted(known))


def _table(content: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    found = content.get(name, {})
    if not isinstance(found, dict):
        raise InvalidInput(f"{name} is {found!r} in the rules; it is a table, [{name}]")
    return found


def _moments(table: Mapping[str, Any]) -> dict[str, datetime]:
    for lab, moment in table.items():
        lecture.topic(lab)
        if not isinstance(moment, datetime) or moment.tzinfo is None:
            raise InvalidInput(f"the deadline of {lab} is {moment}; write it with its zone: 2026-11-30T23:59:00+01:00")
    return dict(table)


def _number(table: Mapping[str, Any], name: str) -> float:
    value = table.get(name, 0)
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value <= _MOST:
        raise InvalidInput(f"{name} is {value!r} in the rules; it is a number from 0 to {_MOST}")
    return float(value)
