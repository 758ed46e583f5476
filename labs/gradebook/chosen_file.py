"""Which of the files that a student handed in is graded, and which others may have been meant.

The notebook with the name of the lab comes first, then a Python file of that name, then what has the name in its own or
in a folder's, then what is called like the student, and then the only one that there is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from labs.gradebook.delivered_files import DeliveredFile, shown
from labs.gradebook.layouts import Owner
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
    """A file that may be graded. rank: how likely it is the one, the lowest first."""

    entry: Entry
    file: DeliveredFile
    rank: tuple[int, bool, bool]

    @property
    def order(self) -> tuple[object, ...]:
        """The first in this order is graded. Of one name it is the newest, and else the one less deep in folders."""
        path = self.file.path
        return self.rank, len(path.parts), path.name.lower(), -self.entry.owner.number, self.file.name, self.entry.name

    @property
    def is_anything(self) -> bool:
        """Whether nothing in its name says that it is for this lab."""
        return self.rank[0] == _ANY


@dataclass(frozen=True)
class Choice:
    """The file that is graded, and those that may have been meant instead. file: None if nobody can say which."""

    file: Candidate | None
    others: tuple[Candidate, ...] = ()


def choice(files: Sequence[tuple[Entry, DeliveredFile]], lab: str) -> Choice:
    """Choose the file of a lab."""
    ordered = sorted(_candidates(files, lab), key=lambda each: each.order)
    if not ordered:
        return Choice(None)
    best, *others = ordered
    alike = [each for each in others if each.rank == best.rank]
    if best.is_anything and any(each.file.path.name.lower() != best.file.path.name.lower() for each in alike):
        return Choice(None, (best, *alike))
    return Choice(best, tuple(each for each in others if each in alike or _is_beside(each, best)))


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
    return [Candidate(entry, file, _rank(file, lab, entry.owner.key)) for entry, file in (*proper, *odd)]


def _is_proper(file: DeliveredFile) -> bool:
    return file.path.suffix.lower() in (".ipynb", ".py")


def _starts_like_one(file: DeliveredFile) -> bool:
    try:
        return not file.shut and starts_like_one(file.read(_START), file.name)
    except (OSError, UnreadableSubmission):
        return False


def _rank(file: DeliveredFile, lab: str, student: str) -> tuple[int, bool, bool]:
    path = PurePosixPath(file.name.lower())
    stem = path.stem if _is_proper(file) else path.name.removesuffix("".join(path.suffixes))
    if stem == lab:
        rank = _LAB
    elif lab in path.parts[:-1] or lab in stem:
        rank = _HAS_LAB
    else:
        rank = _STUDENT if stem == student.lower() else _ANY
    return rank + (rank != _ANY and is_called_python(file.name)), not _is_proper(file), bool(file.shut)


def _is_beside(other: Candidate, best: Candidate) -> bool:
    """Whether another file with such a name lies beside the best one, or came in another entry."""
    elsewhere = other.entry.path != best.entry.path
    return not other.is_anything and (elsewhere or other.file.path.parent == best.file.path.parent)
