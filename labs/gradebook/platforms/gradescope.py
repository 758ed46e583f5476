"""Gradescope: one submission in `/autograder/submission` becomes `/autograder/results/results.json`.

    python -m labs.gradebook.platforms.gradescope /autograder impulse

The format is that of https://gradescope-autograders.readthedocs.io/en/latest/specs/, and the metadata of a submission
that of https://gradescope-autograders.readthedocs.io/en/latest/submission_metadata/.

Threat: this runs as root beside a submission, whose code runs as nobody, in the sandbox of the grader. `run_autograder`
takes everybody else's right to read the tests and the results.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from labs.assessment.shares import QUESTIONS, SHARES
from labs.gradebook.platforms import shapes
from labs.gradebook.platforms.lines import COUNTED, Content, Line, Paragraph, about, lines, mistakes, of_hundred
from labs.gradebook.platforms.running import run, written
from labs.gradebook.platforms.submitted import graded_folder
from labs.gradebook.platforms.text import markdown

RESULTS, METADATA = "results/results.json", "submission_metadata.json"
VISIBLE, LATER = "visible", "after_published"
MOST_BYTES = 10 * 2**20
"""Of the metadata."""

_FORMAT = shapes.one_of("text", "html", "simple_format", "md", "ansi")
_VISIBILITY = shapes.one_of("hidden", "after_due_date", LATER, VISIBLE)
_TEST = shapes.at_most(
    {"score": "max_score"},
    shapes.table(
        {
            "score": shapes.number(), "max_score": shapes.number(), "status": shapes.one_of("passed", "failed"),
            "name": shapes.name, "name_format": _FORMAT, "number": shapes.name, "output": shapes.text,
            "output_format": _FORMAT, "tags": shapes.listed(shapes.name), "visibility": _VISIBILITY,
            "extra_data": shapes.anything,
        },
        needed=("score", "max_score", "name"),
    ),
)  # fmt: skip
CHECK = shapes.table(
    {
        "score": shapes.number(COUNTED), "execution_time": shapes.number(), "output": shapes.text,
        "output_format": _FORMAT, "test_output_format": _FORMAT, "test_name_format": _FORMAT,
        "visibility": _VISIBILITY, "stdout_visibility": shapes.one_of("hidden"), "extra_data": shapes.anything,
        "tests": shapes.listed(_TEST), "leaderboard": shapes.listed(shapes.anything),
    },
    needed=("score", "tests", "stdout_visibility"),
)  # fmt: skip
"""What Gradescope takes; besides, no output of the grader may be shown to a student."""


def result(content: Content, seconds: float) -> dict[str, Any]:
    """What Gradescope shows of a grade. seconds: how long the grading took."""
    said = about(content)
    if "unreadable" not in content:
        later = "The tests that are hidden until grades are published count as well."
        by_hand = f"A person marks the written questions, {SHARES[QUESTIONS]} points of a hundred."
        said += [Paragraph(f"Of a hundred points, {COUNTED} are given here. {later} {by_hand}")]
    identity = {key: value for key, value in content.get("identity", {}).items() if key != "name"}
    return {
        "score": round(float(content["points"]), 2),
        "execution_time": round(seconds, 2),
        "output": markdown(said),
        "output_format": "md",
        "test_output_format": "md",
        "test_name_format": "text",
        "stdout_visibility": "hidden",
        "extra_data": {
            "grade": identity, "tier": content.get("tier", ""), "missing": list(content.get("missing", ())),
            "mistakes": mistakes(content),
        },
        "tests": [_test(line) for line in lines(content)],
    }  # fmt: skip


def _test(line: Line) -> dict[str, Any]:
    return {
        "name": line.name,
        "number": line.number,
        "score": round(of_hundred(line, line.got), 2),
        "max_score": round(of_hundred(line, line.possible), 2),
        "status": "passed" if line.passed else "failed",
        "output": markdown(line.words),
        "output_format": "md",
        "tags": [line.function] if line.function else [],
        "visibility": LATER if line.hidden else VISIBLE,
    }


def submission_id(path: Path) -> str:
    """Gradescope's number of the submission; empty if the file does not say."""
    try:
        with open(path, encoding="utf-8") as file:
            found = json.loads(file.read(MOST_BYTES))
    except (OSError, ValueError, RecursionError):
        return ""
    return str(found.get("id", "")) if isinstance(found, Mapping) else ""


def grade(root: Path, lab: str) -> None:
    """Grade the submission in the platform's folder."""
    graded = graded_folder(root / "submission", lab, submission_id(root / METADATA))
    written(result(graded.content, graded.measured["seconds"]), CHECK, root / RESULTS)


if __name__ == "__main__":
    sys.exit(run(lambda: grade(Path(sys.argv[1]), sys.argv[2])))
