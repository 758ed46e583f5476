"""nbgrader: grades become a file of marks, which `into_gradebook.py` writes into nbgrader's gradebook.

nbgrader lives in an environment of its own, which need not have the lab. So the lab writes plain data, and a script
that needs nothing but nbgrader reads it: https://nbgrader.readthedocs.io/en/stable/api/gradebook.html.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from labs.gradebook.marking import Given
from labs.gradebook.platforms import shapes
from labs.gradebook.platforms.lines import Content, Paragraph, about, lines
from labs.gradebook.platforms.text import markdown
from labs.gradebook.written import Question

SCHEMA = "collisions-lab/nbgrader"
_SCORE = shapes.at_most(
    {"got": "possible"}, shapes.table({"got": shapes.number(), "possible": shapes.whole}, needed=("got", "possible"))
)
_ANSWER = shapes.table({"points": shapes.number(), "comment": shapes.text}, needed=("points", "comment"))
_STUDENT = shapes.table(
    {
        "sha256": shapes.like("[0-9a-f]{64}"), "file": shapes.text, "scores": shapes.keyed(_SCORE),
        "comments": shapes.keyed(shapes.text), "answers": shapes.keyed(_ANSWER),
    },
    needed=("sha256", "scores", "comments", "answers"),
)  # fmt: skip
CHECK = shapes.table(
    {"schema": shapes.one_of(SCHEMA), "lab": shapes.name, "cells": shapes.keyed(shapes.whole),
     "students": shapes.keyed(_STUDENT)},
    needed=("schema", "lab", "cells", "students"),
)  # fmt: skip
"""What `into_gradebook.py` takes."""


def marks(
    lab: str, points: Mapping[str, int], grades: Mapping[str, Content],
    given: Mapping[str, Mapping[str, Given]], asked: Sequence[Question],
) -> dict[str, Any]:  # fmt: skip
    """The file of marks.

    points: by function, what its check is worth in the notebook. grades: by nbgrader's name of a student. given: what a
    person gave for written questions, by student and question.
    """
    return {
        "schema": SCHEMA,
        "lab": lab,
        "cells": {f"check-{name}": worth for name, worth in points.items()},
        "students": {
            student: _student(content, points, given.get(student, {}), asked) for student, content in grades.items()
        },
    }


def _student(
    content: Content, points: Mapping[str, int], given: Mapping[str, Given], asked: Sequence[Question]
) -> dict[str, Any]:
    found = {each["name"]: each["got"] for each in content.get("functions", ())}
    comments = {name: markdown(_words(content, name)) for name in points}
    return {
        "sha256": content["identity"]["sha256"],
        "scores": {f"check-{name}": {"got": found.get(name, 0), "possible": worth} for name, worth in points.items()},
        "comments": {name: said for name, said in comments.items() if said},
        "answers": {
            f"answer-{question.key}": {"points": marked.points, "comment": markdown([Paragraph(marked.comment, True)])}
            for question in asked
            if (marked := given.get(question.key)) and marked.points is not None
        },
    }


def _words(content: Content, name: str) -> list[Paragraph]:
    """What a student is told of a function, after the grades are given back."""
    if "unreadable" in content:
        return about(content)
    return [word for line in lines(content) if line.function == name for word in line.words]
