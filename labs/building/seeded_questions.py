"""The numbers that a student has in the questions of a lab, and what follows from them, for the person who marks.

A lesson asks for numbers with `lab.numbers("key", e=(0.3, 0.5))`. The model answer with the same key may hold a block
with the language `result`, a line for each result, such as `share = g * dt / ((1 + e) * v)`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from labs.assessment.seeded import drawn
from labs.building import lessons
from labs.guidance.expressions import expression

_RESULT = re.compile(r"^```result\n(.*?)^```", re.MULTILINE | re.DOTALL)
_HEAD = re.compile(r"^```result$", re.MULTILINE)


@dataclass(frozen=True)
class Question:
    """One question's numbers for one student. results: what follows from them, by name."""

    key: str
    numbers: SimpleNamespace
    results: dict[str, float]


def questions(topic: str, student: str) -> list[Question]:
    """All questions of a lab that have numbers of their own.

    Raises
    ------
    InvalidInput
        If a line of results cannot be read, or uses a name that is neither a number of the question nor a result above.
    """
    lesson = lessons.read(topic)
    found = []
    for key, choices in _asked(cell.text for cell in lesson.cells if cell.code and "lab.numbers" in cell.text):
        numbers = drawn(student, topic, key, choices)
        text = "\n".join(model.text for model in lesson.models(key))
        found.append(Question(key, numbers, _results(text, numbers)))
    return found


def as_python(text: str) -> str:
    """A model answer with its results as lines of Python: a page would print a language that it does not know."""
    return _HEAD.sub("```python", text)


def _asked(cells: Iterator[str]) -> Iterator[tuple[str, dict[str, tuple[float, ...]]]]:
    for node in (node for text in cells for node in ast.walk(ast.parse(text))):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "numbers":
            yield ast.literal_eval(node.args[0]), {str(at.arg): ast.literal_eval(at.value) for at in node.keywords}


def _results(text: str, numbers: SimpleNamespace) -> dict[str, float]:
    values = {name: np.asarray(float(value)) for name, value in vars(numbers).items()}
    results: dict[str, float] = {}
    for line in (line for block in _RESULT.findall(text) for line in block.splitlines() if line.strip()):
        name, _, right = line.partition("=")
        results[name.strip()] = float(expression(right, values).at(values))
        values[name.strip()] = np.asarray(results[name.strip()])
    return results
