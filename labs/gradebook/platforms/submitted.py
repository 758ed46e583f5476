"""Grades the one submission that a platform has put into a folder, on the platform's machine.

That machine is a container that the platform throws away, so the submission is graded even where there is no sandbox.
"""

from __future__ import annotations

from pathlib import Path

from labs.gradebook.arrivals import Missing, arrival_with_content
from labs.gradebook.grading import Graded, Task, grade_one
from labs.gradebook.layouts import PLAIN, Owner
from labs.grading.budget import SECONDS
from labs.grading.judging.grade import SCHEMA, VERSION


def graded_folder(folder: Path, lab: str, student: str) -> Graded:
    """The grade of what is in a folder; of a folder with nothing to grade, one that says why.

    Raises
    ------
    GraderFailed
        If the tests could not be run, for no fault of the submission.
    """
    arrived = arrival_with_content(folder, Owner(PLAIN, student), lab)
    if isinstance(arrived, Missing):
        identity = {"student": student, "lab": lab, "file": ""}
        content = {"schema": SCHEMA, "version": VERSION, "identity": identity, "unreadable": f"{arrived.why}."}
        return Graded(student, {**content, "marks": {}, "points": 0.0}, {"seconds": 0.0})
    found, read = arrived
    task = Task(student, "", lab, found.entry, found.file, read, "", SECONDS, unsandboxed=True)
    graded = grade_one(task)
    graded.content["notes"] = list(found.notes)
    return graded
