"""What a function is worth: the points of all its tests, read from their source.

The tests are parsed, not imported: `labs` runs tests by path and imports none of them.
"""

from __future__ import annotations

import ast
from functools import cache

from labs.grading.judging.pytest_run import HIDDEN, VISIBLE
from labs.project_folders import AUTOGRADER
from reference import lecture

_MARKER = "asks"
"""The decorator that says which function a test is about and what it is worth (`labs.grading.judging.markers`)."""


def points_of(function: str) -> int:
    """The points of a function's visible and hidden tests; 0 if it has none yet."""
    return _points(lecture.function(function).topic).get(function, 0)


@cache
def _points(topic: str) -> dict[str, int]:
    found: dict[str, int] = {}
    for folder in (VISIBLE, HIDDEN):
        path = AUTOGRADER / folder / f"test_{topic}.py"
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if path.is_file() else ():
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == _MARKER:
                name, points = (ast.literal_eval(argument) for argument in node.args[:2])
                found[name] = found.get(name, 0) + points
    return found
