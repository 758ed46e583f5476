"""Notes whether a function gives the same answer to every question of a test.

Most tests ask for a limiting case, where zero is right, or for a property, which zeros may have as well: twice nothing
is nothing. A function that always returns the same has not computed anything, so it earns none of these points.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.words import shown

GIST = "the function gives the same answer in every call"
"""What is said of a hidden test."""


class SameAnswers:
    """The answers of one function to the questions of one test, as far as it takes to see that two of them differ.

    An answer that repeats one number, or one row of numbers, is the same however often it repeats them. An answer
    without numbers differs from no other.
    """

    def __init__(self) -> None:
        self._calls = 0
        self._first: Any = None
        self._seen: Any = None
        self._differ = False

    def note(self, answer: Any) -> None:
        """Note an answer."""
        if self._differ:
            return
        self._first = answer if not self._calls else self._first
        self._calls += 1
        content = _content(answer)
        if content is not None:
            self._differ = self._seen not in (None, content)
            self._seen = content

    def note_error(self) -> None:
        """Note that a call had no answer: what the function does depends on the question."""
        self._differ = True

    def found(self) -> str:
        """What is wrong, in words; empty where two answers differ, or where there are not two."""
        if self._differ or self._calls < 2:
            return ""
        return f"gives {_words(self._first)} in every call of this test"


def _content(answer: Any) -> Any:
    """What an answer says, in a form that can be compared; None if it holds no number."""
    try:
        array = np.asarray(answer, dtype=float)
    except (TypeError, ValueError):  # several things of different shapes, or no numbers
        parts = tuple(map(_content, answer)) if isinstance(answer, tuple | list) else (repr(answer),)
        return parts if any(part is not None for part in parts) else None
    if not array.size:
        return None
    rows = array.reshape(-1, array.shape[-1]) if array.ndim else array.reshape(1, 1)
    if np.array_equal(rows, np.broadcast_to(rows[:1, :1], rows.shape), equal_nan=True):
        return str(rows[0, 0])
    if np.array_equal(rows, np.broadcast_to(rows[:1], rows.shape), equal_nan=True):
        return str(rows[0].tolist())
    return str(array.tolist())


def _words(answer: Any) -> str:
    return shown(answer) if not isinstance(answer, tuple | list) else f"({', '.join(map(_words, answer))})"
