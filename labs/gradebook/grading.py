"""Grades one submission of a class in a worker process: reads it, runs it, and returns plain data.

A worker keeps one grader for all the submissions that it gets. What is found depends on the submission, the tests and
the lab alone, so that the same file has the same grade byte for byte whenever and wherever it is graded. What depends
on the machine and the moment, time and memory, is returned apart from it.
"""

from __future__ import annotations

import atexit
import contextlib
import hashlib
import platform
import tempfile
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from labs.building.marking import marks_of
from labs.gradebook import protection, scenario_runs
from labs.gradebook.similarity import own_code
from labs.gradebook.written import answers_in, questions
from labs.grading.calling.remote import Grader, Limits
from labs.grading.diagnosis.fingerprints.reading import FOLDER as FINGERPRINTS
from labs.grading.errors import UnreadableSubmission
from labs.grading.judging.grade import SCHEMA, VERSION, grade
from labs.grading.judging.pytest_run import HIDDEN, VISIBLE
from labs.grading.submission.statements import groups
from labs.grading.worker.tier import Tier
from labs.project_folders import AUTOGRADER
from reference.engines.distributions import lab_version
from reference.errors import InvalidInput


@dataclass(frozen=True)
class Task:
    """A submission to grade. student: the number. file: its name, which a message may show. content: its bytes.

    with_runs: whether its functions also run in the scenarios of the lab, which changes nothing in the grade.
    unsandboxed: whether it may be graded where it can open the files of the machine.
    """

    student: str
    name: str
    lab: str
    entry: str
    file: str
    content: bytes
    release: str
    seconds: float
    with_runs: bool = False
    unsandboxed: bool = False


@dataclass(frozen=True)
class Graded:
    """What came of a task. content: of `grade.json`. measured: seconds and memory, which differ from run to run.

    code: of the student's own, without what the lab gives. runs: in scenarios; None if none were wanted.
    """

    student: str
    content: dict[str, Any]
    measured: dict[str, float]
    code: str = ""
    runs: list[dict[str, Any]] | None = None


def identity(task: Task) -> dict[str, Any]:
    """Whose grade it is, of which file, and what it was graded with: a grade with another identity is not this one."""
    return {
        "student": task.student,
        "name": task.name,
        "lab": task.lab,
        "entry": task.entry,
        "file": task.file,
        "sha256": hashlib.sha256(task.content).hexdigest(),
        "release": task.release,
        "seconds": task.seconds,
        "versions": versions(task.lab),
    }


def versions(lab: str) -> dict[str, str]:
    """Of all that a grade depends on besides the submission; of tests and known mistakes a digest of their text."""
    tests, mistakes = hashlib.sha256(), FINGERPRINTS / f"{lab}.json"
    for folder in (VISIBLE, HIDDEN):
        tests.update((AUTOGRADER / folder / f"test_{lab}.py").read_bytes())
    return {
        "collisions-lab": lab_version(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "tests": tests.hexdigest(),
        "known mistakes": hashlib.sha256(mistakes.read_bytes() if mistakes.exists() else b"").hexdigest(),
    }


_WORDS = {"tests": "the tests", "known mistakes": "the known mistakes", "collisions-lab": "the lab"}
"""What `versions` has by other names, or needs an article."""


def refuse_other_versions(before: Mapping[str, str], worker: Mapping[str, str], lab: str) -> None:
    """Refuse a grade that was not made with what the others of the class were made with.

    before: the versions when the run began. worker: those that the grade was made with.

    Raises
    ------
    InvalidInput
        If they differ, because files were edited meanwhile, or because the worker of a cluster has other ones.
    """
    if worker == before:
        return
    now = versions(lab)
    if edited := [name for name in before if now[name] != before[name]]:
        raise InvalidInput(
            f"{' and '.join(_WORDS.get(name, name) for name in edited)} of {lab} were changed while the class was being"
            " graded, so not all grades would be made alike. Grades that are finished are kept. When the files are as"
            " you want them, run the same command again: it grades everything again that was graded with others"
        )
    others = [
        f"{_WORDS.get(name, name)} {worker.get(name, 'missing')[:12]}"
        for name in before
        if worker.get(name) != before[name]
    ]
    raise InvalidInput(
        f"a worker has other versions than this machine: {', '.join(others)}. Install the same lab and packages there,"
        " and run the same command again"
    )


_ONE_AT_A_TIME = threading.Lock()
"""Of a worker with several threads: pytest runs once in a process."""


def grade_one(task: Task) -> Graded:
    """Grade a submission; one that cannot be read earns nothing, and says why."""
    with _ONE_AT_A_TIME:
        try:
            return _grade(task)
        finally:
            groups.cache_clear()  # the trees of long hostile texts would fill the memory, one submission after another


def _grade(task: Task) -> Graded:
    began, processor = time.monotonic(), time.process_time()
    content: dict[str, Any] = {"schema": SCHEMA, "version": VERSION, "identity": identity(task)}
    runs: list[dict[str, Any]] | None = None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, Path(task.file).name or "submission.ipynb")
        path.write_bytes(task.content)
        code = own_code(path, task.lab)
        try:
            found = grade(path, [task.lab], grader=_grader(task.unsandboxed), seconds=task.seconds)
            marks = marks_of(found.sheet, path, task.lab)
        except (UnreadableSubmission, InvalidInput) as error:
            content |= {"unreadable": str(error), "marks": {}, "points": 0.0}
        else:
            content |= found.content()
            content["marks"] = {
                kind: {"reached": count.reached, "possible": count.possible} for kind, count in marks.counts.items()
            }
            content["points"] = round(marks.total, 4)
            content["answers"] = answers_in(path, [question.key for question in questions(task.lab)])
            runs = (
                scenario_runs.run(path, task.lab, _grader(task.unsandboxed), task.seconds) if task.with_runs else None
            )
    content["identity"]["versions"] = versions(task.lab)  # others than before if a test was edited meanwhile
    measured = {
        "seconds": time.monotonic() - began,
        "processor_seconds": time.process_time() - processor,
    }
    with contextlib.suppress(ImportError):  # Windows has none
        import resource  # noqa: PLC0415

        measured["memory_kb"] = float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
    return Graded(task.student, content, measured, code, runs)


@cache
def _grader(unsandboxed: bool) -> Grader:
    """The grader of this worker; it ends with the worker's process."""
    grader = Grader(Limits(), least=Tier.PROCESS if unsandboxed else protection.LEAST)
    atexit.register(grader.close)
    return grader
