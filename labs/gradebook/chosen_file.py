"""Which of the files that a student handed in is graded, and which others may have been meant.

What a file is about decides first: one in which functions of the lab are written, then one that is as the student found
it, and one about another lab last. Among those alike the name decides: the notebook with the name of the lab, then a
Python file of that name, then what has the name in its own or in a folder's, then what is called like the student, and
then the only one that there is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath

from labs.gradebook.delivered_files import DeliveredFile, shown
from labs.gradebook.layouts import Owner
from labs.gradebook.subject import Look, looks
from labs.grading.errors import UnreadableSubmission
from labs.grading.submission.opening import is_called_python, is_notebook_or_python, starts_like_one

_LAB, _HAS_LAB, _STUDENT, _ANY = 0, 2, 4, 6
"""Ranks of a notebook by its name; that of a Python file is one more, but for the last."""
_START, _MOST_STARTS = 2**16, 5
"""So many bytes of so many files are looked at for a notebook with another name."""


@dataclass(frozen=True)
class Entry:
    """An entry of the folder that a platform delivers, and whose it is."""

    path: Path
    owner: Owner

    @property
    def name(self) -> str:
        """Its name as text."""
        return shown(self.path.name)


@dataclass(frozen=True)
class Candidate:
    """A file that may be graded. name_rank: how likely its name makes it the one, the lowest first. look: at its text.

    is_behind: whether another file has more than twice as many functions of the lab.
    """

    entry: Entry
    file: DeliveredFile
    name_rank: tuple[int, bool, bool]
    look: Look = field(default_factory=Look)
    is_behind: bool = False

    @property
    def rank(self) -> tuple[object, ...]:
        """How likely it is the one that is meant, the lowest first."""
        return self.look.subject, self.is_behind, self.name_rank

    @property
    def order(self) -> tuple[object, ...]:
        """The first in this order is graded. Of one name it is the newest, and else the one less deep in folders.

        Where no name says anything, it is the newest.
        """
        path, newest = self.file.path, -self.entry.owner.number
        by_name = len(path.parts), path.name.lower()
        return self.rank, newest * self.is_anything, *by_name, newest, self.file.name, self.entry.name

    @property
    def is_anything(self) -> bool:
        """Whether nothing in its name says that it is for this lab."""
        return self.name_rank[0] == _ANY


@dataclass(frozen=True)
class Choice:
    """The file that is graded, and those that may have been meant instead. file: None if nobody can say which."""

    file: Candidate | None
    others: tuple[Candidate, ...] = ()


def choice(files: Sequence[tuple[Entry, DeliveredFile]], lab: str) -> Choice:
    """Choose the file of a lab."""
    candidates = _looked_at(_candidates(files, lab), lab)
    ordered = sorted(_without_modules(candidates), key=lambda each: each.order)
    if not ordered:
        return Choice(None)
    best, *others = ordered
    unsure = [each for each in others if best.is_anything and _nobody_can_tell(best, each)]
    if unsure:
        return Choice(None, (best, *unsure))
    meant = [each for each in candidates if each is not best and _may_be_meant(each, best)]
    return Choice(best, tuple(sorted(meant, key=lambda each: each.order)))


def listed(candidates: Sequence[Candidate]) -> str:
    """The names of files in words, those of their entries if they came in several."""
    several = len({each.entry.path for each in candidates}) > 1
    return in_words([each.entry.name if several else each.file.name for each in candidates])


def in_words(names: Sequence[str]) -> str:
    """Names, the first for all if there are many."""
    return " and ".join(names) if len(names) < 3 else f"{names[0]} and {len(names) - 1} others"


def _candidates(files: Sequence[tuple[Entry, DeliveredFile]], lab: str) -> list[Candidate]:
    """The notebooks and Python files; if there are none, what holds one under another name, such as `impulse.json`."""
    named = [(entry, file) for entry, file in files if is_notebook_or_python(file.name)]
    proper = [(entry, file) for entry, file in named if _is_proper(file)]
    odd = [(entry, file) for entry, file in named if not _is_proper(file)]
    looked_at = odd or ([] if proper else sorted(files, key=lambda each: lab not in each[1].name.lower()))
    odd = [(entry, file) for entry, file in looked_at[:_MOST_STARTS] if _starts_like_one(file)]
    return [Candidate(entry, file, _name_rank(file, lab, entry.owner.key)) for entry, file in (*proper, *odd)]


def _looked_at(candidates: Sequence[Candidate], lab: str) -> list[Candidate]:
    """The candidates, notebooks first, with what a look at their text says."""
    likely = sorted(candidates, key=lambda each: (is_called_python(each.file.name), each.order))
    found = looks([each.file for each in likely], lab)
    most = max((look.written for look in found), default=0)
    return [
        replace(each, look=look, is_behind=look.is_this_lab and 2 * look.written < most)
        for each, look in zip(likely, found, strict=True)
    ]


def _without_modules(candidates: Sequence[Candidate]) -> list[Candidate]:
    """The candidates without Python files that lie elsewhere and no higher than a notebook of the lab.

    A whole tree that is handed in holds the project's own `impulse.py`, and perhaps an untouched notebook.
    """
    notebooks = [each for each in candidates if not is_called_python(each.file.name) and each.look.is_this_lab]
    return [
        each
        for each in candidates
        if not (notebooks and is_called_python(each.file.name))
        or any(_is_beside(each, other) or len(each.file.path.parts) < len(other.file.path.parts) for other in notebooks)
    ]


def _nobody_can_tell(best: Candidate, other: Candidate) -> bool:
    """Whether another file, with another name, is as likely to be meant as the best one, which no name speaks for."""
    if other.file.path.name.lower() == best.file.path.name.lower():
        return False
    if best.look.is_this_lab:
        return other.rank == best.rank and other.entry.owner.number == best.entry.owner.number
    return other.name_rank == best.name_rank


def _may_be_meant(other: Candidate, best: Candidate) -> bool:
    """Whether a person should know of another file: the best one is doubtful, or the other one may be this lab's."""
    named, doubtful = not other.is_anything, not best.look.is_this_lab
    if other.rank == best.rank or (named and other.name_rank == best.name_rank):
        return True
    if other.look.is_this_lab and (not best.look.written or other.name_rank < best.name_rank):
        return True
    return _is_beside(other, best) and (other.look.is_this_lab or named or doubtful)


def _is_proper(file: DeliveredFile) -> bool:
    return file.path.suffix.lower() in (".ipynb", ".py")


def _starts_like_one(file: DeliveredFile) -> bool:
    try:
        return not file.shut and starts_like_one(file.read(_START), file.name)
    except (OSError, UnreadableSubmission):
        return False


def _name_rank(file: DeliveredFile, lab: str, student: str) -> tuple[int, bool, bool]:
    path = PurePosixPath(file.name.lower())
    stem = path.stem if _is_proper(file) else path.name.removesuffix("".join(path.suffixes))
    if stem == lab:
        rank = _LAB
    elif lab in path.parts[:-1] or lab in stem:
        rank = _HAS_LAB
    else:
        rank = _STUDENT if stem == student.lower() else _ANY
    return rank + (rank != _ANY and is_called_python(file.name)), not _is_proper(file), bool(file.shut)


def _is_beside(other: Candidate, one: Candidate) -> bool:
    """Whether a file lies in the folder of another one, or came in another entry."""
    return other.entry.path != one.entry.path or other.file.path.parent == one.file.path.parent
