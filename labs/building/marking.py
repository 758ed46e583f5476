"""Marks a student's notebook in a lab: functions, inputs and predictions are counted, a person marks the questions."""

from __future__ import annotations

from pathlib import Path

from labs.assessment import exposures
from labs.assessment.marks import Marks, marks
from labs.building import lessons
from labs.grading.judging.grade import grade
from labs.grading.judging.score_sheet import Sheet
from labs.grading.submission.asked_predictions import predictions_in, predictions_of
from reference import lecture


def marked(file: Path, topic: str, questions: float | None = None) -> Marks:
    """What a notebook reached. questions: points that a person gave for the written questions, if they are marked.

    A prediction of the lesson that the notebook has lost counts as not made.

    Raises
    ------
    UnknownName, InvalidInput, UnreadableSubmission
        If there is no such lab, the questions do not have so many points, or the file cannot be read.
    """
    name = lecture.topic(topic).name
    return marks_of(grade(file, [name]).sheet, file, name, questions)


def marks_of(sheet: Sheet, file: Path, name: str, questions: float | None = None) -> Marks:
    """The same of a notebook whose tests have been run."""
    lesson = lessons.read(name)
    asked = predictions_in(cell.text for cell in lesson.cells if cell.code)
    made = predictions_of(file)
    possible = sum(cell.points for cell in lesson.cells if cell.kind == "answer")
    return marks(
        (sum(outcome.earned for outcome in sheet.outcomes), sum(outcome.points for outcome in sheet.outcomes)),
        exposures.found_in(file, name),
        (sum(made.get(key, False) for key in asked), len(asked)),
        (questions, possible),
    )
