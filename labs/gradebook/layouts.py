"""How platforms name what they deliver: which student an entry of a folder belongs to, and when it was handed in.

| platform | an entry of the folder |
|---|---|
| Gradescope | `submission_310/`, and students' names in `submission_metadata.yml` |
| Canvas | `lovelaceada_LATE_7_4711_impulse-1.ipynb`: name, whether late, Canvas' numbers of student and file, attempt |
| Moodle | `Ada Lovelace_4711_assignsubmission_file_/impulse.ipynb`: name, and the number of the participant |
| nbgrader | `submitted/ada/impulse/impulse.ipynb`, with `timestamp.txt` beside it |
| none | `ada/impulse.ipynb`, `ada.zip` or `ada.ipynb` |
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import datetime
from pathlib import PurePosixPath
from typing import Any

from labs.gradebook.times import moment

CANVAS, GRADESCOPE, MOODLE, NBGRADER, PLAIN = "Canvas", "Gradescope", "Moodle", "nbgrader", "plain"
METADATA = "submission_metadata.yml"
"""Gradescope's file of who handed in what."""
TIMESTAMP = "timestamp.txt"
"""nbgrader's file of when."""
_CANVAS = re.compile(r"^(?P<name>[^_]+)_(?:(?P<late>LATE)_)?(?P<id>\d+)_(?P<file>\d+)_(?P<rest>.+)$")
_ATTEMPT = re.compile(r"-(\d+)(?=\.\w+$)")
_MOODLE = re.compile(r"^(?P<name>.+)_(?P<id>\d+)_assignsubmission_file(?:_(?P<rest>.*))?$")
_GRADESCOPE = re.compile(r"^submission_(?P<id>\d+)$")


@dataclass(frozen=True)
class Owner:
    """Whose an entry is, as far as its name says.

    platform: whose naming it is. key: the student's number or name there. name: of the student, empty if the platform
    does not say. attempt: of several files of one student, the last counts. late: whether the platform calls it late.
    file: the name that the student gave the file, empty for a folder.
    """

    platform: str
    key: str
    name: str = ""
    attempt: int = 0
    late: bool = False
    file: str = ""


def owner_of(entry: str) -> Owner:
    """Read the name of an entry of a folder."""
    if found := _MOODLE.match(entry):
        return Owner(MOODLE, found["id"], found["name"], file=found["rest"] or "")
    if found := _GRADESCOPE.match(entry):
        return Owner(GRADESCOPE, found["id"])
    if found := _CANVAS.match(entry):
        attempt = _ATTEMPT.search(found["rest"])
        file = _ATTEMPT.sub("", found["rest"])
        return Owner(CANVAS, found["id"], found["name"], int(attempt[1]) if attempt else 0, bool(found["late"]), file)
    return Owner(PLAIN, PurePosixPath(entry).stem if entry.lower().endswith(SUFFIXES) else entry)


SUFFIXES = (".ipynb", ".py", ".zip")
"""What a submission may end in, in lower case."""


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
