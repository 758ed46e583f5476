"""How platforms name what they deliver: which student an entry of a folder belongs to, and when it was handed in.

| platform | an entry of the folder |
|---|---|
| Gradescope | `submission_310/`, and students' names in `submission_metadata.yml` |
| Canvas | `lovelaceada_LATE_7_4711_impulse-1.ipynb`: name, whether late, Canvas' numbers of student and file |
| Canvas without names | `anon_x7Kd2_4711_impulse.ipynb` |
| Moodle | `Ada Lovelace_4711_assignsubmission_file_/impulse.ipynb`: name, and the number of the participant |
| Blackboard | `Lab 5_ada_attempt_2026-11-30-22-10-00_impulse.ipynb`: login, and when on the clock of the platform |
| Brightspace | `397063-2557369 - Ada Lovelace - Nov 30, 2026 1010 PM/impulse.ipynb`: name, and when on its clock |
| nbgrader | `submitted/ada/impulse/impulse.ipynb`, with `timestamp.txt` beside it |
| none | `ada/impulse.ipynb`, `ada.zip` or `ada.ipynb` |

Canvas delivers each file of the current attempt by itself. Moodle delivers a folder for its files, and another one for
a text that was entered online.
"""

from __future__ import annotations

import contextlib
import re
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from labs.gradebook.times import moment

CANVAS, GRADESCOPE, MOODLE, NBGRADER, PLAIN = "Canvas", "Gradescope", "Moodle", "nbgrader", "plain"
BLACKBOARD, BRIGHTSPACE = "Blackboard", "Brightspace"
METADATA = "submission_metadata.yml"
"""Gradescope's file of who handed in what."""
TIMESTAMP = "timestamp.txt"
"""nbgrader's file of when."""
_CANVAS = re.compile(
    r"^(?P<name>.+?)_(?:(?P<late>LATE)_)?(?P<id>\d+)_(?:(?P<file>\d+)_(?P<rest>.+)|(?P<entered>text|link)\.html)$"
)
_CANVAS_HIDES = re.compile(r"^(?:(?P<late>LATE)_)?(?P<id>anon_[0-9A-Za-z]+)_(?:(?P<file>\d+)_(?P<rest>.+)|\w+\.html)$")
_APART = re.compile(
    r"-(?:\d+|[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12})(?=(?:\.[A-Za-z][A-Za-z0-9]*)*\.[A-Za-z0-9]*$)"
)
"""What Canvas puts behind the name of a file if the student has handed in another one of this name before."""
_MOODLE = re.compile(r"^(?P<name>.+?)(?:_(?P<id>\d+))?_assignsubmission_(?P<kind>[a-z]+)(?:_(?P<rest>.*))?$")
_BLACKBOARD = re.compile(r"^[^_]+_(?P<id>.+?)_attempt_(?P<when>\d{4}(?:-\d\d){5})(?:_(?P<rest>.+)|\.txt)$")
_BRIGHTSPACE = re.compile(r"^(?P<id>\d+)-\d+ - (?P<name>.+) - (?P<when>\w{3,9} \d{1,2}, \d{4} \d{3,4} [AP]M)$")
_CLOCKS = ("%Y-%m-%d-%H-%M-%S", "%b %d, %Y %I%M %p", "%B %d, %Y %I%M %p")
"""How Blackboard and Brightspace write a time into a name."""
_GRADESCOPE = re.compile(r"^submission_(?P<id>\d+)$")
SUFFIXES = (".ipynb", ".py", ".zip")
"""What a submission should end in, in lower case."""
_ENDING = re.compile(r"(?:\.(?:ipynb|py|zip))?\.[A-Za-z0-9]+$", re.IGNORECASE)


@dataclass(frozen=True)
class Owner:
    """Whose an entry is, as far as its name says.

    platform: whose naming it is. key: the student's number or name there. name: of the student, empty if the platform
    does not say. attempt: of several submissions of one student, the last counts. late: whether the platform calls it
    late. file: the name that the student gave the file, empty for a folder. number: of several files of that name, the
    one with the highest is the newest. received: when it came, on the clock of the platform, if the name says so.
    """

    platform: str
    key: str
    name: str = ""
    attempt: int = 0
    late: bool = False
    file: str = ""
    number: int = 0
    received: datetime | None = None


def owner_of(entry: str, is_file: bool = True) -> Owner:
    """Read the name of an entry of a folder."""
    if found := _MOODLE.match(entry):
        return Owner(MOODLE, found["id"] or found["name"], found["name"], file=found["rest"] or "")
    if found := _GRADESCOPE.match(entry):
        return Owner(GRADESCOPE, found["id"], attempt=int(found["id"]))
    if (found := _BLACKBOARD.match(entry) or _BRIGHTSPACE.match(entry)) and (when := _clock(found["when"])):
        if found.re is _BRIGHTSPACE:  # no number there is known to be the student's alone
            return Owner(BRIGHTSPACE, f"{found['id']} {found['name']}", found["name"], _order(when), received=when)
        return Owner(BLACKBOARD, found["id"], attempt=_order(when), file=found["rest"] or entry, received=when)
    if found := _CANVAS_HIDES.match(entry) or _CANVAS.match(entry):
        file = _APART.sub("", found["rest"] or entry)
        name = found.groupdict().get("name") or ""
        return Owner(CANVAS, found["id"], name, late=bool(found["late"]), file=file, number=int(found["file"] or 0))
    return Owner(PLAIN, _ENDING.sub("", entry) or entry if is_file else entry)


def _clock(text: str) -> datetime | None:
    """A time in a name, without a zone; None if it is none."""
    for form in _CLOCKS:
        with contextlib.suppress(ValueError):
            return datetime.strptime(text, form)
    return None


def _order(when: datetime) -> int:
    return int(f"{when:%Y%m%d%H%M%S}")


@dataclass(frozen=True)
class Submitter:
    """One student of a Gradescope submission, and when it was handed in."""

    key: str
    name: str
    email: str
    received: datetime | None


def submitters(metadata: Any) -> dict[str, list[Submitter]]:
    """By the number of a submission, who handed it in, from Gradescope's file as plain data.

    What is not as Gradescope writes it is left out: the entry then belongs to nobody, and says so.
    """
    found: dict[str, list[Submitter]] = {}
    for entry, content in metadata.items() if isinstance(metadata, dict) else ():
        matched = _GRADESCOPE.match(str(entry))
        if not matched or not isinstance(content, dict):
            continue
        received = content.get(":created_at")
        people = content.get(":submitters")
        found[matched["id"]] = [
            Submitter(
                str(person.get(":sid") or ""),
                str(person.get(":name") or ""),
                str(person.get(":email") or ""),
                moment(received),
            )
            for person in (people if isinstance(people, list) else ())
            if isinstance(person, dict)
        ]
    return found
