"""Mistakes without a name that several students of a class share: everybody who returned the same wrong numbers.

A class is gone through in an order that depends on the numbers alone, and everybody joins the nearest of those before
who have the same numbers. A cluster keeps its name from run to run because its first numbers are kept in the table to
be filled in (`naming`): who returns the same within the tolerance belongs to it, whatever the last digits are.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from labs.gradebook.mistakes.entries import Entry
from labs.gradebook.mistakes.same_numbers import Numbers, Shelf, numbers_in
from labs.gradebook.similarity import function_in
from labs.grading.diagnosis.unnamed import Value

FEWEST = 2
"""Students who share a mistake."""
_LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789"
"""Without those that are easily taken for each other."""
_LETTERS_OF_A_NAME = 4


@dataclass(frozen=True)
class Cluster:
    """Students who share a mistake without a name.

    id: its name until a person gives it one. numbers: that it is known by. code: the shortest version of the function.
    place, gives: the simplest case in which it is wrong, among those with a single case, and the answer there.
    """

    id: str
    numbers: Numbers
    students: tuple[str, ...]
    code: str
    place: int
    gives: str

    @property
    def function(self) -> str:
        """Which function is wrong."""
        return self.numbers.function


@dataclass(frozen=True)
class _Member:
    student: str
    numbers: Numbers
    place: int
    gives: str


def clusters(
    contents: Mapping[str, Mapping[str, Any]],
    code_of: Callable[[str], str],
    waiting: Sequence[Entry] = (),
    taken: Collection[str] = (),
) -> list[Cluster]:
    """The clusters of a class, the largest first. contents: the grades by student, with the course's names joined.

    code_of: a student's own code. waiting: what was in the table of the last run. taken: names that are used elsewhere.
    """
    members: dict[str, list[_Member]] = {}
    for student, content in contents.items():
        for each in content.get("functions", ()):
            numbers = None if "named_by_course" in each else numbers_in(each)
            if numbers:
                found = _Member(student, numbers, each["unnamed"]["place"], each["unnamed"]["gives"])
                members.setdefault(each["name"], []).append(found)
    names = {*taken, *(entry.id for entry in waiting)}
    shared = [
        _cluster(entry, numbers, own, code_of, names)
        for function, several in sorted(members.items())
        for entry, numbers, own in _groups(function, several, waiting)
        if len(own) >= FEWEST
    ]
    return sorted(shared, key=lambda each: (-len(each.students), each.id))


def _groups(
    function: str, members: Sequence[_Member], waiting: Sequence[Entry]
) -> list[tuple[Entry | None, Numbers, list[_Member]]]:
    """Members with the same numbers; with the entry of the last run, if there is one."""
    before = [entry for entry in waiting if entry.function == function]
    shelf = Shelf(function, [entry.numbers for entry in before])
    found: list[tuple[Entry | None, Numbers, list[_Member]]] = [(entry, entry.numbers, []) for entry in before]
    for member in sorted(members, key=lambda each: [_order(value) for value in each.numbers.values.values()]):
        place = shelf.nearest(member.numbers)
        if place is None:
            shelf.add(member.numbers)
            found.append((None, member.numbers, [member]))
        else:
            found[place][2].append(member)
    return found


def _order(value: Value) -> tuple[str, float]:
    return (value, 0.0) if isinstance(value, str) else ("", float(value))


def _cluster(
    entry: Entry | None, numbers: Numbers, members: Sequence[_Member], code_of: Callable[[str], str], names: set[str]
) -> Cluster:
    versions = [(function_in(code_of(each.student), numbers.function), each) for each in members]
    code, shortest = min(versions, key=lambda each: (not each[0], len(each[0]), each[0], each[1].student))
    students = tuple(sorted(each.student for each in members))
    id = entry.id if entry else _name(numbers, names)
    names.add(id)
    return Cluster(id, numbers, students, code, shortest.place, shortest.gives)


def _name(numbers: Numbers, names: Collection[str]) -> str:
    """A name that no other cluster has."""
    letters = [_LETTERS[byte % len(_LETTERS)] for byte in hashlib.sha256(numbers.text().encode()).digest()]
    choices = (f"{numbers.function}-{''.join(letters[:length])}" for length in range(_LETTERS_OF_A_NAME, len(letters)))
    return next(each for each in choices if each not in names)
