"""The calls of a method of the desk that the text of a cell holds, such as `lab.predict(…)`. No cell is ever run."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterator

from labs.grading.submission.magics import without_magics


def calls_in(source: str, method: str) -> Iterator[ast.Call]:
    """The calls in the order of the text; none if Python cannot read the cell."""
    if method not in source and source.isascii():  # Python reads some other letters as those of the name
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about a backslash in a text: the student sees that elsewhere
        try:
            tree = ast.parse(without_magics(source))
        except (SyntaxError, ValueError, RecursionError, MemoryError):  # the last two: text that no person writes
            return
    calls = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == method
    ]
    yield from sorted(calls, key=lambda call: (call.lineno, call.col_offset))
