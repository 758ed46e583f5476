"""Finds the submissions in a folder as a platform delivers it: one file for each student, and what was odd about it.

Threat: names, links and archives are hostile. Links are not followed, nothing is unpacked to the disk, and of an
archive one file is read, up to the size that the grader reads anyway. Nothing is run here.
"""

from __future__ import annotations

import stat
import zipfile
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from datetime import datetime
from itertools import islice
from pathlib import Path, PurePosixPath

from labs.gradebook.layouts import (
    CANVAS,
    GRADESCOPE,
    METADATA,
    NBGRADER,
    PLAIN,
    SUFFIXES,
    TIMESTAMP,
    Owner,
    Submitter,
    owner_of,
    submitters,
)
from labs.gradebook.times import moment
from labs.grading.safe_text import one_line
from labs.grading.submission.cells import FILE_LIMIT
from reference.errors import InvalidInput

EARLIER = "came before it"
"""What a note says of earlier attempts, which need nobody."""
MOST_FILES, DEEPEST = 5000, 6
"""So many files of one entry are looked at, in folders so deep. A release through the impulse lab has 841."""
_NOT_THEIRS = ("__MACOSX", ".ipynb_checkpoints", "__pycache__", ".git", ".venv")
_SUBMITTED = "submitted"
"""nbgrader's folder of what was handed in."""


@dataclass(frozen=True)
class Arrival:
    """What one student handed in.

    owner: whose it is, as far as the platform's names say. entry: the folder, archive or file that it came in. file:
    its name there. read: gives its bytes. received: when, if the platform says so. stamp: how nbgrader writes that.
    notes: what the instructor should know.
    """

    owner: Owner
    entry: str
    file: str
    read: Callable[[], bytes] = field(repr=False, compare=False)
    received: datetime | None = None
    stamp: str = ""
    email: str = ""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Missing:
    """An entry from which nothing can be graded, and why."""

    owner: Owner
    entry: str
    why: str


@dataclass(frozen=True)
class _File:
    """A file of an entry: where it is there, how to read it, how large it is."""

    name: str
    size: int
    read: Callable[[], bytes] = field(repr=False)


def arrivals(folder: Path, lab: str) -> tuple[list[Arrival], list[Missing]]:
    """The submissions of a lab in a folder, sorted by entry; of several of one student the last attempt.

    Raises
    ------
    InvalidInput
        If there is no such folder, or nothing in it.
    """
    folder = _with_students(folder)
    known = _gradescope(folder)
    found: dict[tuple[str, str], list[Arrival | Missing]] = {}
    for entry in sorted(folder.iterdir()):
        if entry.name in (METADATA, *_NOT_THEIRS) or not _may_be_submission(entry):
            continue
        for owner, who in _owners(entry, known):
            arrived = arrival(entry, owner, lab)
            if who and isinstance(arrived, Arrival):
                arrived = replace(arrived, received=who.received, email=who.email)
            found.setdefault((owner.platform, owner.key), []).append(arrived)
    if not found:
        raise InvalidInput(f"{str(folder)!r} holds no submission: neither folders of students nor notebooks")
    last = [_last(each) for each in found.values()]
    return [each for each in last if isinstance(each, Arrival)], [each for each in last if isinstance(each, Missing)]


def _shown(name: str) -> str:
    """A name of the file system as text: bytes that are no UTF-8 become escapes."""
    return name.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def _with_students(folder: Path) -> Path:
    """The folder that has an entry for each student: nbgrader's is one below."""
    if not folder.is_dir():
        raise InvalidInput(f"{str(folder)!r} is no folder: name the one that the platform's archive unpacks to")
    return folder / _SUBMITTED if (folder / _SUBMITTED).is_dir() else folder


def _gradescope(folder: Path) -> dict[str, list[Submitter]]:
    file = folder / METADATA
    if not file.is_file() or file.is_symlink():
        return {}
    try:
        import yaml  # type: ignore[import-untyped] # noqa: PLC0415 - comes with jupytext, and only Gradescope's folders need it
    except ImportError:
        raise InvalidInput(f'{METADATA} is read with PyYAML: pip install -e ".[dev]"') from None
    try:
        return submitters(yaml.safe_load(file.read_text(encoding="utf-8")))
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise InvalidInput(f"{METADATA} cannot be read: {one_line(str(error))}") from None


def _may_be_submission(entry: Path) -> bool:
    return entry.is_dir() or (entry.suffix.lower() in SUFFIXES and not entry.name.startswith("."))


def _owners(entry: Path, known: dict[str, list[Submitter]]) -> Iterator[tuple[Owner, Submitter | None]]:
    """Whose an entry is: a submission of a group belongs to each of its members."""
    owner = owner_of(_shown(entry.name))
    if owner.platform != GRADESCOPE or not known.get(owner.key):
        yield owner, None
        return
    for person in known[owner.key]:
        yield Owner(GRADESCOPE, person.key or person.email or person.name, person.name), person


def arrival(entry: Path, owner: Owner, lab: str) -> Arrival | Missing:
    """The file of an entry that is graded, or why there is none."""
    if entry.is_symlink():
        return Missing(owner, _shown(entry.name), "it is a link, which is not followed")
    try:
        files = list(_files(entry))
    except (OSError, zipfile.BadZipFile, NotImplementedError, RuntimeError) as error:
        return Missing(owner, _shown(entry.name), f"it cannot be opened: {one_line(str(error))}")
    nbgrader = next((each for each in files if PurePosixPath(each.name).name == TIMESTAMP), None)
    candidates = [each for each in files if each.name.lower().endswith((".ipynb", ".py"))]
    wanted = sorted(candidates, key=lambda each: (_rank(each.name, lab), each.name))
    if not wanted:
        return Missing(owner, _shown(entry.name), "it holds neither a notebook nor a .py file")
    best = [each for each in wanted if _rank(each.name, lab) == _rank(wanted[0].name, lab)]
    if _rank(best[0].name, lab) == _ANY and len(best) > 1:
        return Missing(owner, _shown(entry.name), f"it holds {_some(best)}, and none is named {lab}")
    chosen = best[0]
    notes = (f"it holds {_some(best)}; {chosen.name} is graded",) if len(best) > 1 else ()
    if chosen.size > FILE_LIMIT:
        return Missing(owner, _shown(entry.name), f"{chosen.name} has {chosen.size / 2**20:.0f} MB, more than 10")
    if nbgrader and owner.platform == PLAIN:
        owner = replace(owner, platform=NBGRADER)
    stamp = nbgrader.read().decode("utf-8", "replace").strip() if nbgrader and nbgrader.size < FILE_LIMIT else ""
    received = moment(stamp) or moment(f"{stamp} UTC")  # nbgrader itself takes a time without a zone for UTC
    return Arrival(owner, _shown(entry.name), chosen.name, chosen.read, received, stamp, notes=notes)


_ANY = 4


def _rank(name: str, lab: str) -> int:
    """How likely a file is to be the one of a lab: 0 for the notebook of its name."""
    path = PurePosixPath(name.lower())
    if path.stem == lab:
        return 0 if path.suffix == ".ipynb" else 1
    if lab in path.parts[:-1] or lab in path.stem:
        return 2 if path.suffix == ".ipynb" else 3
    return _ANY


def _some(files: Iterable[_File]) -> str:
    names = [each.name for each in files]
    return " and ".join(names) if len(names) < 3 else f"{names[0]} and {len(names) - 1} others like it"


def _last(each: list[Arrival | Missing]) -> Arrival | Missing:
    """The last attempt of one student, with a note of the others."""
    *before, last = sorted(each, key=lambda one: (one.owner.attempt, one.entry))
    if before and isinstance(last, Arrival):
        names, are = ", ".join(one.entry for one in before), "is" if len(before) == 1 else "are"
        note = f"{names} {EARLIER} and {are} not graded"
        return replace(last, notes=(*last.notes, note))
    return last


def _files(entry: Path) -> Iterator[_File]:
    """The ordinary files of an entry."""
    if entry.is_dir():
        yield from _in_folder(entry)
    elif entry.suffix.lower() == ".zip":
        yield from _in_archive(entry)
    else:
        owner = owner_of(_shown(entry.name))
        name = owner.file if owner.platform == CANVAS else _shown(entry.name)
        yield _File(name, entry.stat().st_size, entry.read_bytes)


def _in_folder(folder: Path) -> Iterator[_File]:
    waiting, left = deque([folder]), MOST_FILES
    while waiting and left:
        for path in sorted(path for path in waiting.popleft().iterdir() if not _is_hidden(path.name))[:left]:
            left -= 1
            name = _shown(path.relative_to(folder).as_posix())
            if path.is_symlink():
                continue
            if path.is_dir() and len(PurePosixPath(name).parts) < DEEPEST:
                waiting.append(path)
            elif path.is_file():
                yield _File(name, path.stat().st_size, path.read_bytes)


def _in_archive(path: Path) -> Iterator[_File]:
    with zipfile.ZipFile(path) as archive:
        theirs = (info for info in archive.infolist() if not info.is_dir() and not _is_hidden(info.filename))
        for info in islice(theirs, MOST_FILES):
            if not stat.S_ISLNK(info.external_attr >> 16):
                yield _File(info.filename, info.file_size, _reader(path, info))


def _reader(path: Path, info: zipfile.ZipInfo) -> Callable[[], bytes]:
    """Reads one file of an archive, and no more than the grader would: a header may lie about the size."""

    def read() -> bytes:
        with zipfile.ZipFile(path) as archive, archive.open(info) as file:
            return file.read(FILE_LIMIT + 1)

    return read


def _is_hidden(name: str) -> bool:
    parts = [part for part in PurePosixPath(name).parts if part not in (".", "..")]
    return any(part.startswith(".") or part in _NOT_THEIRS for part in parts)
