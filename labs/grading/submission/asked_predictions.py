"""Which predictions a notebook asks for, and which of them a student has made. Cells are read and never run.

A prediction counts as made if its answer is no longer the dots of the cell. Whether it is right is not asked here.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable
from pathlib import Path

from labs.grading.submission.calls_in_cells import calls_in
from labs.grading.submission.cells import read_cells

_PLACE = 2
"""Where `lab.predict(key, question, answer)` has the answer if it is not named."""


def predictions_of(path: Path | str) -> dict[str, bool]:
    """The key of each prediction in a notebook, in order, and whether it was made.

    Raises
    ------
    UnreadableSubmission
        If the file holds no code at all.
    """
    cells, _ = read_cells(Path(path))
    return predictions_in(cell.source for cell in cells if cell.code)


def predictions_in(sources: Iterable[str]) -> dict[str, bool]:
    """The same for the sources of cells. Of two predictions with one key the last one counts."""
    found: dict[str, bool] = {}
    for source in sources:
        for call in calls_in(source, "predict"):
            key = call.args[0] if call.args else _named(call, "key")
            if isinstance(key, ast.Constant) and isinstance(key.value, str):
                answer = call.args[_PLACE] if len(call.args) > _PLACE else _named(call, "answer")
                found[key.value] = answer is not None and not _is_open(answer)
    return found


def in_words(predictions: dict[str, bool]) -> str:
    """How many predictions were made, in a line; empty if none is asked for."""
    if not predictions:
        return ""
    return f"Predictions: {sum(predictions.values())} of {len(predictions)} made."


def _named(call: ast.Call, name: str) -> ast.expr | None:
    return next((each.value for each in call.keywords if each.arg == name), None)


def _is_open(answer: ast.expr) -> bool:
    """Whether an answer is the dots, as Python writes them or as a text, or nothing."""
    if not isinstance(answer, ast.Constant):
        return False
    return answer.value in (None, ...) or (isinstance(answer.value, str) and not answer.value.strip(" .…?"))
