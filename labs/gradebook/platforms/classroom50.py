"""Classroom 50: the student's repository becomes `result.json` and `release-body.md`, with the visible tests alone.

    python -m labs.gradebook.platforms.classroom50 REPOSITORY impulse

The format is https://github.com/foundation50/classroom50/blob/main/schemas/result-v1.schema.json, and the contract of
an autograder is https://github.com/foundation50/classroom50/wiki/Advanced-Autograding. What an autograder needs is
published with the assignment, so nothing hidden may be in it: this module runs in the tree that students get.

Threat: the runner reads the standard output for commands, so nothing of a student is printed. A result that is there
already, perhaps a link, is replaced and never written through.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from labs.gradebook.arrivals import Missing, arrival_with_content
from labs.gradebook.layouts import PLAIN, Owner
from labs.gradebook.platforms import shapes
from labs.gradebook.platforms.lines import Content, Line, Paragraph, about, lines
from labs.gradebook.platforms.running import run, written
from labs.gradebook.platforms.text import markdown
from labs.grading.errors import UnreadableSubmission
from labs.grading.judging.grade import grade as grade_file
from labs.grading.judging.grade import write_private
from labs.grading.judging.pytest_run import VISIBLE
from labs.project_folders import STUDENT_NOTEBOOKS
from reference import lecture
from reference.errors import InvalidInput

RESULT, BODY = "result.json", "release-body.md"
SCHEMA = "classroom50/result/v1"
NEEDED = ("CLASSROOM", "ASSIGNMENT", "SUBMISSION_TAG", "COMMIT_URL", "RELEASE_URL")
"""Variables of the runner without which there is no result."""

_TEST = shapes.at_most(
    {"score": "max-score"},
    shapes.table(
        {"test-name": shapes.name, "passed": shapes.flag, "score": shapes.whole, "max-score": shapes.whole},
        needed=("test-name", "passed", "score", "max-score"),
    ),
)
_FIELDS: dict[str, shapes.Check] = {
    "schema": shapes.one_of(SCHEMA), "classroom": shapes.name, "assignment": shapes.name,
    "assignment_type": shapes.one_of("individual", "group", "team"), "owner": shapes.name,
    "submission": shapes.like(r"submit/.+"), "commit": shapes.name, "release": shapes.name, "review": shapes.name,
    "datetime": shapes.like(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ"), "score": shapes.whole, "max-score": shapes.whole,
    "tests": shapes.listed(_TEST),
}  # fmt: skip
CHECK = shapes.at_most({"score": "max-score"}, shapes.table(_FIELDS, needed=tuple(_FIELDS)))
"""What Classroom 50 takes."""


def result(content: Content, environment: Mapping[str, str], now: datetime) -> dict[str, Any]:
    """What Classroom 50 keeps of a grade.

    Raises
    ------
    InvalidInput
        If the runner has not said whose submission it is.
    """
    if missing := [name for name in NEEDED if not environment.get(name)]:
        raise InvalidInput(f"the runner has not set {', '.join(missing)}")
    shown = _shown(content)
    return {
        "schema": SCHEMA,
        "classroom": environment["CLASSROOM"],
        "assignment": environment["ASSIGNMENT"],
        "assignment_type": environment.get("ASSIGNMENT_TYPE") or "individual",
        "owner": environment.get("OWNER") or environment.get("USERNAME") or "",
        "submission": environment["SUBMISSION_TAG"],
        "commit": environment["COMMIT_URL"],
        "release": environment["RELEASE_URL"],
        "review": environment.get("REVIEW_URL") or environment["COMMIT_URL"],
        "datetime": now.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "score": sum(line.got for line in shown),
        "max-score": sum(line.possible for line in shown),
        "tests": [
            {"test-name": line.name, "passed": line.passed, "score": line.got, "max-score": line.possible}
            for line in shown
        ],
    }


def body(content: Content, lab: str) -> str:
    """What the student reads on the page of the release, as Markdown."""
    shown = _shown(content)
    got, possible = sum(line.got for line in shown), sum(line.possible for line in shown)
    title = f"### {lecture.topic(lab).title}: {got} of {possible} points of the visible tests\n\n"
    wrong = [line for line in shown if not line.passed]
    said = [*about(content), *(() if "unreadable" in content else (word for line in wrong for word in _headed(line)))]
    return f"{title}{markdown(said)}\n\nHidden tests, inputs, predictions and written questions are graded later.\n"


def _shown(content: Content) -> list[Line]:
    """The lines of visible tests. There are none of hidden ones where this runs, and none would be shown."""
    return [line for line in lines(content) if line.function and not line.hidden]


def _headed(line: Line) -> Iterator[Paragraph]:
    yield Paragraph(f"{line.name} ({line.got} of {line.possible})")
    yield from line.words


def graded(repository: Path, lab: str) -> Content:
    """The grade of a repository by the visible tests. What cannot be read gets nothing of what there is to get."""
    places = [repository / name for name in (f"{lab}.ipynb", f"{lab}.py", f"labs/notebooks/{lab}.ipynb")]
    entry = next((place for place in places if place.is_file()), repository)
    arrived = arrival_with_content(entry, Owner(PLAIN, ""), lab)
    if isinstance(arrived, Missing):
        return _unreadable(lab, "", f"{arrived.why}.")
    found, read = arrived
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, Path(found.file).name)
        path.write_bytes(read)
        try:
            content = grade_file(path, [lab], (VISIBLE,)).content()
        except (UnreadableSubmission, InvalidInput) as error:
            return _unreadable(lab, path.name, str(error))
    return {**content, "identity": {"file": path.name}, "notes": list(found.notes)}


def _unreadable(lab: str, file: str, why: str) -> Content:
    """The grade of nothing: what the notebook earns that everybody starts with, and why."""
    content = grade_file(STUDENT_NOTEBOOKS / f"{lab}.ipynb", [lab], (VISIBLE,)).content()
    return {**content, "identity": {"file": file}, "unreadable": why}


def grade(repository: Path, lab: str) -> None:
    """Grade a repository, and write what the runner takes into it."""
    content = graded(repository, lab)
    write_private(repository / BODY, body(content, lab))
    written(result(content, os.environ, datetime.now(UTC)), CHECK, repository / RESULT)


if __name__ == "__main__":
    sys.exit(run(lambda: grade(Path(sys.argv[1]), sys.argv[2])))
