"""`collisions check`: the visible tests of what a file contains, in words."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from labs.cli import ending
from labs.cli.console import errors, output
from labs.grading.budget import SECONDS, Budget
from labs.grading.feedback import report
from labs.grading.judging import pytest_run
from labs.grading.submission import asked_predictions
from labs.grading.submission.reading import Submission
from labs.grading.wrapping import folded
from reference import lecture


def check(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Your notebook or .py file.", show_default=False)],
    topic: Annotated[
        list[str] | None,
        typer.Option(help="A topic; repeat for several. If you name none: those of which the file has functions."),
    ] = None,
    seconds: Annotated[
        float,
        typer.Option(
            metavar="S",
            min=1e-3,
            max=1e6,
            help="How long all of this may compute and sleep; what is not tried by then says so.",
        ),
    ] = SECONDS,
) -> None:
    """Check a notebook or a .py file: what is right, what is wrong and why, and what is to do.

    For example:  collisions check lab.ipynb
    """
    budget = Budget(seconds)
    submission, found = pytest_run.topics_of(file)
    topics = tuple(lecture.topic(name).name for name in topic) if topic else found
    if not topics:
        _nothing(submission)
        raise typer.Exit(ending.NOT_RIGHT)
    errors.print(f"Checking {submission.name} …", markup=False)
    sheet = pytest_run.run(file, topics, (pytest_run.VISIBLE,), budget=budget)
    for line in report.report(sheet, topics):
        output.print(line, markup=False, soft_wrap=True)
    if made := asked_predictions.in_words(asked_predictions.predictions_of(file)):
        output.print(made, markup=False)
    raise typer.Exit(ending.code_of(not report.all_right(sheet)))


def _nothing(submission: Submission) -> None:
    """Say why there is nothing to check: what is wrong with the file, or which functions are looked for."""
    first = next(entry.name for entry in lecture.functions_of(pytest_run.tested()[0]) if entry.role == "written")
    paragraphs = [
        *(str(complaint) for complaint in submission.complaints if complaint.kind != "missing"),
        f"{submission.name} defines no function of the lab, such as {first}.",
        f"Topics that can be checked: {', '.join(pytest_run.tested())} (--topic)",
    ]
    for line in (line for paragraph in paragraphs for line in folded(paragraph, 0)):
        output.print(line, markup=False, soft_wrap=True)
