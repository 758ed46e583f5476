"""Whose each submission of a class is, and what is still to be graded."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from labs.gradebook.arrivals import Arrival, Missing, arrivals, content_of
from labs.gradebook.class_run import Failures
from labs.gradebook.grading import Task
from labs.gradebook.layouts import Owner
from labs.gradebook.roster import Roster, Student, of_everybody
from labs.gradebook.sheets import plain
from labs.grading.safe_text import cause_of


@dataclass
class Class:
    """The submissions of one lab, by student.

    handed: what each student handed in. unusable: entries from which nothing can be graded, with the student if known.
    strangers: arrivals of nobody on the roster; they are graded under the platform's own number. strays: names of files
    that are no submission and nobody's.
    """

    lab: str
    roster: Roster
    handed: dict[str, Arrival] = field(default_factory=dict)
    unusable: dict[str, Missing] = field(default_factory=dict)
    strangers: dict[str, Student] = field(default_factory=dict)
    strays: list[str] = field(default_factory=list)

    @property
    def students(self) -> tuple[Student, ...]:
        """Everybody on the roster, and then the strangers."""
        return (*self.roster.students, *self.strangers.values())


def read_class(folder: Path, lab: str, roster: Roster | None = None) -> Class:
    """Read a folder of submissions.

    Raises
    ------
    InvalidInput
        If there is no such folder, or nothing in it.
    """
    there, unusable = arrivals(folder, lab)
    owners = [*(each.owner for each in there), *(each.owner for each in unusable if not each.stray)]
    found = Class(lab, roster or of_everybody({(each.platform, each.key): each for each in owners}.values()))
    known = [(arrival, _student(found, arrival)) for arrival in there]
    doubts = {arrival.entry: tuple(_other_name(found.roster, arrival.owner, student)) for arrival, student in known}
    for arrival, student in sorted(known, key=lambda each: (not doubts[each[0].entry], _when(each[0]))):
        notes = [*arrival.notes, *doubts[arrival.entry]]
        if before := found.handed.get(student.id):
            notes.append(f"{before.entry} is of the same student and is not graded")
        found.handed[student.id] = replace(arrival, notes=tuple(notes))
    for missing in unusable:
        if missing.stray and found.roster.owner(missing.owner) is None:
            found.strays.append(missing.entry)
            continue
        student = _student(found, missing)
        if arrived := found.handed.get(student.id):
            said = f"{missing.entry}: {missing.why}"
            found.handed[student.id] = replace(arrived, notes=(*arrived.notes, said))
        else:
            found.unusable[student.id] = missing
    return found


def _when(arrival: Arrival) -> float:
    return arrival.received.timestamp() if arrival.received else 0.0


def _other_name(roster: Roster, owner: Owner, student: Student) -> Iterator[str]:
    """That a platform names a submission otherwise than the student whose number it has, as it does for groups."""
    if owner.platform == roster.kind and owner.name and student.name and _letters(owner.name) != _letters(student.name):
        yield (
            f"{owner.platform} calls it the submission of {owner.name!r}, but the roster has {student.name!r} for its"
            " number: if it is a group's, the others have no mark yet"
        )


def _letters(name: str) -> list[str]:
    """The letters of a name in no order: Canvas writes `lovelaceada` for `Lovelace, Ada`."""
    return sorted(filter(str.isalnum, plain(name)))


def _student(found: Class, entry: Arrival | Missing) -> Student:
    email = entry.email if isinstance(entry, Arrival) else ""
    owner = entry.owner
    student = found.roster.owner(owner, email)
    if student is None:  # a name that no student of the roster has
        number = f"{owner.platform} {owner.key}"
        student = found.strangers.setdefault(number, Student(number, owner.name, email))
    return student


def tasks(
    found: Class, release: str, seconds: float, with_runs: bool, failures: Failures, unsandboxed: bool = False
) -> Iterator[Task]:
    """The submissions as tasks; each is read only when it is wanted.

    One that is damaged joins those from which nothing can be graded, and what else cannot be read the failures.
    """
    names = {student.id: student.name for student in found.students}
    for student, missing in found.unusable.items():
        if missing.unreadable_here:
            failures.said[student] = f"it could not be graded: {missing.why}"
    for student, arrival in sorted(found.handed.items()):
        try:
            content = content_of(arrival)
        except Exception as error:  # it belongs to this submission, whatever it is
            why = error.strerror if isinstance(error, OSError) and error.strerror else cause_of(error)
            failures.said[student] = f"it could not be graded: {arrival.file} cannot be read: {why}"
            continue
        if isinstance(content, Missing):
            found.unusable[student] = content
            del found.handed[student]
            continue
        yield Task(
            student,
            names.get(student, ""),
            found.lab,
            arrival.entry,
            arrival.file,
            content,
            release,
            seconds,
            with_runs,
            unsandboxed,
        )
