"""The grades of a class in a folder: each is written once, in one go, and a run that was stopped continues.

    grades/students/4711/grade.json      what the student's submission earned, and with what it was graded
    grades/students/4711/measured.json   how long it took, and how much memory
    grades/students/4711/runs.json       what the student's functions did in the scenarios of the lab
    grades/python/4711.py                the student's own code, for tools that look for copies

A grade counts as done if it has the identity of the submission that is to be graded now: the same file, lab, release
and versions. Everything else is graded again. The grade of a student who hands in nothing any more is put away, into
`withdrawn/`: perhaps the command was given the wrong folder.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import re
import shutil
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from labs.gradebook.grading import Graded, Task, identity
from labs.gradebook.locks import locked
from labs.gradebook.protection import is_open
from labs.grading.judging.grade import as_json, read_grade, write_private
from reference.errors import InvalidInput

STUDENTS, WITHDRAWN, PYTHON = "students", "withdrawn", "python"
GRADE, MEASURED, RUNS = "grade.json", "measured.json", "runs.json"
_LOCK = ".grading"
WORKING = ".working"
"""The folder of the workers' temporary files. It belongs to the run that holds the lock."""
_SAFE = re.compile(r"[^A-Za-z0-9._-]+")


@dataclass
class Book:
    """A folder of grades."""

    folder: Path

    def place(self, student: str) -> Path:
        """The folder of a student: a name that no file system trips over, and no other student has."""
        safe = _SAFE.sub("-", student).strip(".-")[:60]
        if safe != student or not safe:
            safe = f"{safe}-{hashlib.sha256(student.encode('utf-8', 'surrogatepass')).hexdigest()[:8]}"
        return self.folder / STUDENTS / safe

    def grade_of(self, student: str) -> dict[str, Any] | None:
        """What was written about a student; None if nothing was, or it cannot be read."""
        with contextlib.suppress(InvalidInput, OSError):
            return read_grade(self.place(student) / GRADE)
        return None

    def seconds(self, student: str) -> float:
        """How long the grading of a student's submission took, s; 0 if that is not known."""
        seconds = _plain(self.place(student) / MEASURED).get("seconds")
        return float(seconds) if isinstance(seconds, int | float) else 0.0

    def runs_of(self, student: str) -> list[dict[str, Any]] | None:
        """What the functions of the student's graded submission did in scenarios; None if they were not run."""
        grade, kept = self.grade_of(student), _plain(self.place(student) / RUNS)
        if grade is None or kept.get("identity") != grade.get("identity") or not isinstance(kept.get("runs"), list):
            return None
        return list(kept["runs"])

    def code_of(self, student: str) -> str:
        """The student's own code; empty if there is none."""
        try:
            return (self.folder / PYTHON / f"{self.place(student).name}.py").read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError):
            return ""

    def is_done(self, task: Task) -> bool:
        """Whether the grade that is there is the one of this submission, and its runs are there if they are wanted.

        A grade that was made without protection of files is made again where there is protection.
        """
        found = self.grade_of(task.student)
        if found is None or found.get("identity") != identity(task) or (is_open(found) and not task.unsandboxed):
            return False
        return not task.with_runs or "unreadable" in found or self.runs_of(task.student) is not None

    def keep(self, graded: Graded) -> None:
        """Write a grade; what was there before stays until the new one is whole."""
        place = self.place(graded.student)
        self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        for folder in (place.parent, place, self.folder / PYTHON):
            folder.mkdir(exist_ok=True, mode=0o700)
        write_private(self.folder / PYTHON / f"{place.name}.py", graded.code)
        write_private(place / MEASURED, as_json(graded.measured))
        if graded.runs is not None:
            write_private(place / RUNS, as_json({"identity": graded.content["identity"], "runs": graded.runs}))
        write_private(place / GRADE, as_json(graded.content))

    def everybody(self) -> set[str]:
        """All students who were ever graded here, those included whose grade is put away."""
        grades = [*self.folder.glob(f"{STUDENTS}/*/{GRADE}"), *self.folder.glob(f"{WITHDRAWN}/*/{GRADE}")]
        return {str(_identity(path).get("student", "")) for path in grades}

    def withdraw_others(self, students: Iterable[str], lab: str) -> list[str]:
        """Put away the grades of a lab of students who hand in nothing any more, and say whose they were."""
        kept, gone = {self.place(each) for each in students}, []
        for place in sorted(self.folder.glob(f"{STUDENTS}/*")):
            content = _identity(place / GRADE)
            if place not in kept and content.get("lab") == lab:
                away = self.folder / WITHDRAWN
                away.mkdir(exist_ok=True, mode=0o700)
                shutil.rmtree(away / place.name, ignore_errors=True)
                place.rename(away / place.name)
                (self.folder / PYTHON / f"{place.name}.py").unlink(missing_ok=True)
                gone.append(str(content.get("student", place.name)))
        return gone

    @contextlib.contextmanager
    def alone(self) -> Iterator[None]:
        """Nobody else grades into this folder meanwhile.

        Raises
        ------
        InvalidInput
            If somebody does, or this is Windows, which has no such locks.
        """
        busy = f"somebody else is grading into {str(self.folder)!r}: wait until they are done"
        with locked(self.folder / _LOCK, busy):
            yield


def _identity(path: Path) -> dict[str, Any]:
    found = _plain(path).get("identity")
    return found if isinstance(found, dict) else {}


def _plain(path: Path) -> dict[str, Any]:
    """The object in a file; an empty one if there is none that can be read."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}
