"""PrairieLearn: one submission in `/grade/student` becomes `/grade/results/results.json`.

    python -m labs.gradebook.platforms.prairielearn /grade impulse

The format is that of external grading, https://prairielearn.readthedocs.io/en/latest/externalGrading/, and of the
element pl-external-grader-results, which shows it: it escapes names and descriptions, and turns the escapes of a
terminal in messages into colours. Here such escapes are made visible, as everywhere.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from labs.assessment.shares import QUESTIONS, SHARES
from labs.gradebook.platforms import shapes
from labs.gradebook.platforms.lines import COUNTED, Content, Line, Paragraph, about, lines, of_hundred
from labs.gradebook.platforms.running import run, written
from labs.gradebook.platforms.submitted import graded_folder
from labs.gradebook.platforms.text import unmarked
from labs.grading.safe_text import one_line

RESULTS = "results/results.json"
MOST_BYTES = 10**6
"""Of a result, says PrairieLearn."""
_TEST = shapes.at_most(
    {"points": "max_points"},
    shapes.table(
        {
            "name": shapes.name, "description": shapes.text, "points": shapes.number(), "max_points": shapes.number(),
            "message": shapes.text, "output": shapes.text,
        },
        needed=("name", "points", "max_points"),
    ),
)  # fmt: skip
_GRADED = shapes.table(
    {
        "gradable": shapes.flag, "score": shapes.number(1), "message": shapes.text, "output": shapes.text,
        "tests": shapes.listed(_TEST),
    },
    needed=("score",),
)  # fmt: skip
_REFUSED = shapes.table(
    {"gradable": shapes.flag, "format_errors": shapes.listed(shapes.name)}, needed=("gradable", "format_errors")
)
CHECK = shapes.either(lambda value: value.get("gradable") is False, _REFUSED, _GRADED)
"""What PrairieLearn takes: a score, or what keeps a file from being graded."""


def result(content: Content) -> dict[str, Any]:
    """What PrairieLearn shows of a grade. A file that cannot be read costs no attempt."""
    if "unreadable" in content:
        return {"gradable": False, "format_errors": [one_line(str(content["unreadable"])) or "It cannot be read."]}
    by_hand = f"A person marks the written questions, {SHARES[QUESTIONS]} more points of a hundred."
    return {
        "gradable": True,
        "score": round(min(1.0, float(content["points"]) / COUNTED), 4),
        "message": unmarked([*about(content), Paragraph(by_hand)]),
        "tests": [_test(line) for line in lines(content)],
    }


def _test(line: Line) -> dict[str, Any]:
    return {
        "name": one_line(line.name),
        "description": "Its inputs are hidden." if line.hidden else "",
        "points": round(of_hundred(line, line.got), 2),
        "max_points": round(of_hundred(line, line.possible), 2),
        "message": unmarked(line.words),
    }


def grade(root: Path, lab: str) -> None:
    """Grade the submission in the platform's folder."""
    graded = graded_folder(root / "student", lab, "")
    (root / RESULTS).parent.mkdir(exist_ok=True)
    written(result(graded.content), CHECK, root / RESULTS)


if __name__ == "__main__":
    sys.exit(run(lambda: grade(Path(sys.argv[1]), sys.argv[2])))
