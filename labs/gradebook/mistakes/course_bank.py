"""The course's own bank: mistakes that the lab does not know and that an instructor has named.

    course-bank/impulse.toml     the mistakes of a lab (`entries`)

The folder lies outside the project and outside the grades, so it outlives both: next year's students who return the
same wrong numbers read the same title and hint. A grade keeps the numbers, and the texts are joined to it whenever a
page or an export is made. So a grade does not depend on the bank, nothing is run again when a mistake is named or its
title is changed, and `grade.json` stays the same byte for byte.
"""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from labs.gradebook.locks import locked
from labs.gradebook.mistakes.entries import Entry, entries_of, read_entries, text_in, text_of
from labs.gradebook.mistakes.same_numbers import Numbers, Shelf, numbers_in
from labs.grading.diagnosis.fingerprints.reading import Known, known
from labs.grading.diagnosis.probes import probed
from labs.grading.diagnosis.unnamed import known_numbers, probe_keys
from labs.grading.diagnosis.words import renamed
from labs.grading.judging.grade import write_private
from labs.grading.safe_text import plain
from reference.errors import InvalidInput, UnknownName

COURSE_BANK = Path("course-bank")
"""The folder of the bank unless somebody names another one."""
_LOCK = ".naming"


@dataclass(frozen=True)
class CourseBank:
    """The mistakes that a course has named, of all labs."""

    folder: Path
    entries: tuple[Entry, ...] = ()

    def named(self, numbers: Numbers) -> Entry | None:
        """The mistake that gives the same numbers."""
        own, shelf = self._shelves.get(numbers.function, ((), None))
        place = shelf.nearest(numbers) if shelf else None
        return None if place is None else own[place]

    def joined(self, content: Mapping[str, Any]) -> dict[str, Any]:
        """The content of a grade with the course's title and hint where a function makes a mistake of its bank."""
        if "functions" not in content:
            return dict(content)
        return {**content, "functions": [self._joined(each) for each in content["functions"]]}

    def _joined(self, function: Mapping[str, Any]) -> Mapping[str, Any]:
        numbers = numbers_in(function)
        entry = self.named(numbers) if numbers else None
        if entry is None:
            return function
        title, help = plain(entry.title), plain(entry.help)
        return {
            **function,
            "verdict": "named",
            "mistakes": [entry.id],
            "named_by_course": {"title": title, "help": help},
            "message": renamed(function["message"], function["name"], title, help),
        }

    def notes(self, lab: str) -> list[str]:
        """What an instructor should know of its entries of a lab."""
        stale = [
            entry.id
            for own, shelf in self._shelves.values()
            for place, entry in enumerate(own)
            if entry.topic == lab and not shelf.is_of_today(place)
        ]
        return [f"The lab has changed too much to recognise {', '.join(stale)} of the course's bank."] if stale else []

    def refusal(self, entry: Entry) -> str:
        """Why a mistake cannot be named; empty if it can."""
        if twin := self.named(entry.numbers):
            return f"{twin.id}, {twin.title!r}, has the same numbers: change the text of that one"
        if any(entry.id == other.id for other in self.entries):
            return "the bank has another mistake of this name: write a name of your own between the brackets"
        for mistake in known(entry.function).mistakes:
            if not mistake.origins and _agree(entry.numbers, mistake):
                return f"it gives the same numbers for single cases as {mistake.id}, which the lab knows"
        return ""

    def with_entries(self, new: Sequence[Entry]) -> CourseBank:
        """Write more entries at the end of their files; what is there already is left as it is."""
        if not new:
            return self
        self.folder.mkdir(parents=True, exist_ok=True)
        with locked(self.folder / _LOCK):
            for topic in dict.fromkeys(entry.topic for entry in new):
                path = self.folder / f"{topic}.toml"
                before = text_in(path)
                gap = "\n" * (2 - before.endswith("\n")) if before else ""
                text = before + gap + text_of(entry for entry in new if entry.topic == topic)
                _check(entries_of(text, path.name), path)
                _write(path, text)
        return read_bank(self.folder)

    @cached_property
    def _shelves(self) -> dict[str, tuple[tuple[Entry, ...], Shelf]]:
        functions: dict[str, list[Entry]] = {}
        for entry in self.entries:
            functions.setdefault(entry.function, []).append(entry)
        return {name: (tuple(own), Shelf(name, [entry.numbers for entry in own])) for name, own in functions.items()}


def read_bank(folder: Path) -> CourseBank:
    """Read a bank; one that is not there yet is empty.

    Raises
    ------
    InvalidInput
        If a file is not of a lab, or an entry is not as it has to be, has no title or help, or gives the same numbers
        as another one. The message names the file, the line and the choices.
    """
    labs = list(dict.fromkeys(entry.topic for entry in probed()))
    found: list[Entry] = []
    for path in sorted(folder.glob("*.toml")):
        if path.stem not in labs:
            raise InvalidInput(f"{path.name} in the course's bank: {UnknownName('lab', path.stem, labs)}")
        own = read_entries(path)
        _check(own, path)
        found += own
    return CourseBank(folder, tuple(found))


def _check(entries: Sequence[Entry], path: Path) -> None:
    shelves: dict[str, tuple[list[str], Shelf]] = {}
    for entry in entries:
        if entry.topic != path.stem:
            raise InvalidInput(f"{entry.where}: [{entry.id}] is about {entry.function}; move it to {entry.topic}.toml")
        for field in ("title", "help"):
            if not getattr(entry, field):
                raise InvalidInput(f"{entry.where}: the {field} of [{entry.id}] is empty, and students read it")
        ids, shelf = shelves.setdefault(entry.function, ([], Shelf(entry.function)))
        if (twin := shelf.nearest(entry.numbers)) is not None:
            raise InvalidInput(f"{entry.where}: [{entry.id}] has the same numbers as [{ids[twin]}]; keep one of them")
        ids.append(entry.id)
        shelf.add(entry.numbers)


def _agree(own: Numbers, mistake: Known) -> bool:
    """Whether numbers are those of a known mistake, wherever the code gives an answer at all."""
    theirs = dict(zip(probe_keys(own.function), known_numbers(own.function, mistake), strict=True))
    keys = [key for key, value in own.values.items() if value != "none" and key in theirs]
    shelf = Shelf(own.function, [Numbers(own.function, {key: theirs[key] for key in keys})])
    return shelf.nearest(Numbers(own.function, {key: own.values[key] for key in keys})) is not None


def _write(path: Path, text: str) -> None:
    """Write a file in one go. Who may read it stays as it is: a bank has nobody's data."""
    mode = None
    with contextlib.suppress(FileNotFoundError):
        mode = path.stat().st_mode & 0o777
    write_private(path, text)
    if mode is not None:
        path.chmod(mode)
