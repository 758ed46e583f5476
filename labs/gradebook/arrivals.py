"""Finds the submissions in a folder as a platform delivers it: one file for each student, and what was odd about it.

All entries of a student's last attempt are one submission, since Canvas delivers each file by itself. Nothing is run
here; what files, links and archives could do to us is the subject of `delivered_files`.
"""

from __future__ import annotations

import contextlib
import stat
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from functools import partial
from pathlib import Path, PurePosixPath

from labs.gradebook.chosen_file import Candidate, Entry, choice, in_words, listed
from labs.gradebook.delivered_files import NOT_THEIRS, DeliveredFile, delivered, is_hidden, shown
from labs.gradebook.layouts import (
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
from labs.grading.errors import UnreadableSubmission
from labs.grading.safe_text import cause_of, one_line
from labs.grading.submission.opening import is_notebook_or_python, most_bytes
from reference.errors import InvalidInput

EARLIER = "came before it"
"""What a note says of earlier attempts, which need nobody."""
_SUBMITTED = "submitted"
"""nbgrader's folder of what was handed in."""
_TIME = 1000
"""Bytes of the longest file that says when."""


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
    """An entry from which nothing can be graded, and why.

    unreadable_here: whether this machine is to blame and not the submission. stray: whether it may be no submission at
    all, but a file that lies among them.
    """

    owner: Owner
    entry: str
    why: str
    unreadable_here: bool = False
    stray: bool = False


def arrivals(folder: Path, lab: str) -> tuple[list[Arrival], list[Missing]]:
    """The submissions of a lab in a folder, sorted by entry; of several of one student the last attempt.

    Raises
    ------
    InvalidInput
        If there is no such folder, it cannot be listed, or nothing in it is a submission.
    """
    try:
        folder = _with_students(folder)
        known, paths = _gradescope(folder), sorted(folder.iterdir())
    except OSError as error:
        raise InvalidInput(f"the folder {str(folder)!r} cannot be read: {error.strerror}") from None
    found: dict[tuple[str, str, str], list[tuple[Entry, Submitter | None]]] = {}
    for path in paths:
        for owner, person in () if _is_nobodys(path) else _owners(path, known):
            found.setdefault((owner.platform, owner.key, owner.name), []).append((Entry(path, owner), person))
    last = sorted((_last(each, lab) for each in found.values()), key=lambda each: each.entry)
    missing = [each for each in last if isinstance(each, Missing)]
    if all(each.stray for each in missing) and len(missing) == len(last):
        raise InvalidInput(f"{str(folder)!r} holds no submission: neither folders of students nor notebooks")
    return [each for each in last if isinstance(each, Arrival)], missing


def _is_nobodys(path: Path) -> bool:
    """Whether an entry is no student's. A folder whose name begins with a dot may be one's, as the name is free."""
    is_theirs = path.name not in NOT_THEIRS and _is_folder(path)
    return path.name == METADATA or (is_hidden(path.name) and not is_theirs)


def arrival(path: Path, owner: Owner, lab: str) -> Arrival | Missing:
    """The file of an entry that is graded, or why there is none."""
    return _submission([Entry(path, owner)], lab)


def arrival_with_content(path: Path, owner: Owner, lab: str) -> tuple[Arrival, bytes] | Missing:
    """The file of an entry that is graded, and its bytes, or why there is none."""
    found = arrival(path, owner, lab)
    if isinstance(found, Missing):
        return found
    content = content_of(found)
    return content if isinstance(content, Missing) else (found, content)


def content_of(arrived: Arrival) -> bytes | Missing:
    """The bytes of the file, or why they cannot be had. What the system refuses is raised: no student is to blame."""
    try:
        return arrived.read()
    except UnreadableSubmission as error:
        return Missing(arrived.owner, arrived.entry, f"{arrived.file}: {error}")


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
    except (yaml.YAMLError, OSError, ValueError, RecursionError) as error:
        raise InvalidInput(f"{METADATA} cannot be read: {one_line(str(error))}") from None


def _owners(path: Path, known: dict[str, list[Submitter]]) -> Iterator[tuple[Owner, Submitter | None]]:
    """Whose an entry is: a submission of a group belongs to each of its members."""
    owner = owner_of(shown(path.name), not _is_folder(path))
    if owner.platform != GRADESCOPE or not known.get(owner.key):
        yield owner, None
        return
    for person in known[owner.key]:
        yield Owner(GRADESCOPE, person.key or person.email or person.name, person.name, owner.attempt), person


def _is_folder(path: Path) -> bool:
    try:
        return stat.S_ISDIR(path.lstat().st_mode)
    except OSError:
        return False


def _last(entries: Sequence[tuple[Entry, Submitter | None]], lab: str) -> Arrival | Missing:
    """The last attempt of one student, with a note of the others."""
    attempt = max(entry.owner.attempt for entry, _ in entries)
    now = [(entry, person) for entry, person in entries if entry.owner.attempt == attempt]
    found, person = _submission_or_why([entry for entry, _ in now], lab), now[0][1]
    before = [entry.name for entry, _ in entries if entry.owner.attempt < attempt]
    note = f"{', '.join(before)} {EARLIER} and {'is' if len(before) == 1 else 'are'} not graded"
    if isinstance(found, Missing):
        return replace(found, why=f"{found.why}; {note}") if before else found
    if person is not None:
        found = replace(found, received=person.received, email=person.email)
    return replace(found, notes=(*found.notes, note)) if before else found


def _submission_or_why(entries: Sequence[Entry], lab: str) -> Arrival | Missing:
    """What one student handed in. An error that nobody expects is the fault of no other submission."""
    try:
        return _submission(entries, lab)
    except InvalidInput:  # there is no such lab
        raise
    except Exception as error:
        why = f"it cannot be looked at: {cause_of(error)}"
        return Missing(entries[0].owner, entries[0].name, why, unreadable_here=True)


def _submission(entries: Sequence[Entry], lab: str) -> Arrival | Missing:
    """What one student handed in, in one entry or in several."""
    inside = [(entry, delivered(entry.path, entry.owner.file or entry.name)) for entry in entries]
    files = [(entry, file) for entry, there in inside for file in there.files]
    named = [f"{entry.name}: " * (len(entries) > 1) + said for entry, there in inside for said in there.troubles]
    chosen = choice(files, lab)
    if chosen.file is None:
        if chosen.others:
            why = f"it holds {listed(chosen.others)}, and none is named {lab}"
        else:
            why = _nothing([file for _, file in files]) if not named else ""
        here = any(there.unreadable_here for _, there in inside)
        return Missing(entries[0].owner, entries[0].name, "; ".join(filter(None, [why, *named])), here, _stray(entries))
    entry, file = chosen.file.entry, chosen.file.file
    if file.shut:
        return Missing(entry.owner, entry.name, f"{file.name} {file.shut}")
    if file.size > (most := most_bytes(file.name)):
        size = f"{file.size / 2**20:.0f} MB, more than {most / 2**20:.0f}"
        return Missing(entry.owner, entry.name, f"{file.name} has {size}")
    doubt = [f"{_called(chosen.file, entries)} {said}" for said in [chosen.file.look.said] if said]
    other = [f"it holds {listed([chosen.file, *chosen.others])}; {_called(chosen.file, entries)} is graded"]
    stamp = _timestamp(entry, file, [each for other, each in files if other is entry])
    owner = replace(entry.owner, platform=NBGRADER) if stamp and entry.owner.platform == PLAIN else entry.owner
    received = entry.owner.received or _moment_of_nbgrader(stamp)
    notes = (*other * bool(chosen.others), *doubt, *named)
    return Arrival(owner, entry.name, file.name, partial(file.read, most + 1), received, stamp, notes=notes)


def _called(file: Candidate, entries: Sequence[Entry]) -> str:
    return file.entry.name if len(entries) > 1 else file.file.name


def _moment_of_nbgrader(stamp: str) -> datetime | None:
    """A time of nbgrader, which itself takes one without a zone for UTC."""
    return moment(stamp) or moment(f"{stamp} UTC")


def _timestamp(entry: Entry, graded: DeliveredFile, files: Iterable[DeliveredFile]) -> str:
    """When a submission was handed in, as nbgrader writes it into the folder of the assignment; empty if it does not.

    Anywhere else, such as in an archive or beside another platform's name, the student may have written the file.
    """
    if entry.owner.platform != PLAIN or not _is_folder(entry.path):
        return ""
    places = (PurePosixPath(TIMESTAMP), PurePosixPath(*graded.path.parts[:-1][:1], TIMESTAMP))
    for file in files:
        if file.path in places and not file.shut:
            with contextlib.suppress(OSError, UnreadableSubmission):
                return file.read(_TIME).decode("utf-8-sig", "replace").strip()
    return ""


def _nothing(files: Sequence[DeliveredFile]) -> str:
    only = f", only {in_words([file.name for file in files])}" if files else ""
    return f"there is neither a notebook nor a .py file{only}"


def _stray(entries: Sequence[Entry]) -> bool:
    """Whether nothing says that these are anybody's: files with free names, such as `canvas.csv`."""
    return all(
        each.owner.platform == PLAIN
        and not _is_folder(each.path)
        and each.path.suffix.lower() not in SUFFIXES
        and not is_notebook_or_python(each.name)
        for each in entries
    )
