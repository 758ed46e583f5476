"""Writes marks of the Collisions Lab into nbgrader's gradebook. Run it with the Python that has nbgrader.

    python into_gradebook.py --course COURSE

It reads `marks.json` beside this file. Run it after `nbgrader autograde`, and before `nbgrader generate_feedback` and
`nbgrader export`. It needs nothing of the lab.

`nbgrader autograde --no-execute` believes the outputs that a student hands in. So every score of a check is written
here, and a submission without a grade, or with another file than the one that was graded, gets no points and waits for
a person. What a person wrote into the gradebook by hand stays, unless the marks have points for the same answer.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import sys
from pathlib import Path
from typing import Any

WAITS = "This submission has not been graded yet."


def main() -> int:
    """Write the marks; returns 1 if a submission has none."""
    parser = argparse.ArgumentParser(description="Write marks of the Collisions Lab into nbgrader's gradebook.")
    parser.add_argument("--course", type=Path, default=Path(), help="the course's folder, which has submitted/")
    parser.add_argument("--db", help="the gradebook, if it is not gradebook.db in that folder: sqlite:///…")
    parser.add_argument("--marks", type=Path, default=Path(__file__).with_name("marks.json"))
    chosen = parser.parse_args()
    programs = str(Path(sys.executable).parent)  # nbgrader calls alembic, which lies beside its Python
    os.environ["PATH"] = os.pathsep.join([programs, os.environ.get("PATH", "")])
    try:
        from nbgrader.api import Gradebook, MissingEntry  # noqa: PLC0415 - this says what is missing
    except ImportError:
        return _fail("this Python has no nbgrader: run this with the one that you run nbgrader with")
    file = chosen.course / "gradebook.db"
    if not chosen.db and not file.is_file():
        return _fail(f"there is no {file}: name the course's folder with --course, or the gradebook with --db")
    marks = json.loads(chosen.marks.read_text(encoding="utf-8"))
    with Gradebook(chosen.db or f"sqlite:///{file.resolve()}") as book:
        try:
            notebook = book.find_notebook(marks["lab"], marks["lab"])
        except MissingEntry:
            return _fail(f"the gradebook has no assignment {marks['lab']!r} with a notebook of that name")
        if wrong := _other_points(notebook, marks["cells"]):
            return _fail(f"the assignment is not the one that was graded: {wrong}")
        waiting = [
            submission.student.id
            for submission in book.assignment_submissions(marks["lab"])
            if not _written(book, submission, marks, chosen.course)
        ]
        book.db.commit()
        absent = sorted(
            set(marks["students"]) - {each.student.id for each in book.assignment_submissions(marks["lab"])}
        )
    written = len(marks["students"]) - len(absent) - len(set(waiting) & set(marks["students"]))
    print(f"The marks of {written} submissions are in the gradebook.")
    for student in waiting:
        print(f"{student!r} has no points, because the file was not graded: grade and export again.")
    for student in absent:
        print(f"{student!r} has marks, and no submission in the gradebook: run nbgrader autograde first.")
    return 1 if waiting or absent else 0


def _fail(why: str) -> int:
    print(f"Error: {why}", file=sys.stderr)
    return 2


def _other_points(notebook: Any, cells: dict[str, int]) -> str:
    """What differs between the checks of the notebook and those that were graded."""
    there = {cell.name: cell.max_score for cell in notebook.grade_cells if cell.name.startswith("check-")}
    differing = [name for name in {*there, *cells} if there.get(name) != cells.get(name)]
    return ", ".join(f"{name} has {there.get(name)} and not {cells.get(name)} points" for name in sorted(differing))


def _written(book: Any, submission: Any, marks: dict[str, Any], course: Path) -> bool:
    """Write the marks of one submission; returns whether there are any of the file that was handed in."""
    student, lab = submission.student.id, marks["lab"]
    found = marks["students"].get(student)
    if found is not None and found["sha256"] not in _hashes(course / "submitted" / student / lab):
        found = None
    scores = found["scores"] if found else {name: {"got": 0} for name in marks["cells"]}
    for cell, score in scores.items():
        grade = book.find_grade(cell, lab, lab, student)
        grade.auto_score, grade.needs_manual_grade = score["got"], found is None
        comment = book.find_comment(cell.removeprefix("check-"), lab, lab, student)
        comment.auto_comment = found["comments"].get(cell.removeprefix("check-")) if found else WAITS
    for cell, answer in found["answers"].items() if found else ():
        grade = book.find_grade(cell, lab, lab, student)
        grade.manual_score, grade.needs_manual_grade = answer["points"], False
        if answer["comment"]:
            book.find_comment(cell, lab, lab, student).manual_comment = answer["comment"]
    return found is not None


def _hashes(folder: Path) -> set[str]:
    """The hashes of the files that a student handed in."""
    return {hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.glob("*") if path.is_file()}


if __name__ == "__main__":
    sys.exit(main())
