"""Advice on messages of Python and NumPy, for students who write a function of the lab; given only where it is sure.

Students read the messages themselves as well. The advice adds what they leave out, and corrects NumPy's own advice if
it does not fit the lab: `a.any()` is wrong if each case has to be decided by itself.
"""

from __future__ import annotations

import re
from collections.abc import Collection

_NUMBER_OR_MANY = (
    "It is called with one number, or with an array of many: np.where and NumPy's functions take both, a loop does not;"
    " components stand along the last axis, a[..., 0]."
)
_ADVICE = (
    (r"name 'np' is not defined", "`import numpy as np` is missing."),
    (r"name '(numpy|math)' is not defined", r"`import \1` is missing."),
    (r"module 'numpy' has no attribute 'trapz'", "NumPy 2 calls it np.trapezoid."),
    (r"No module named", "Here are NumPy and plain Python: no other packages, and no files."),
    (r"maximum recursion depth", "It calls itself again and again."),
    (r"positional arguments? but \d+ (was|were) given", "Its arguments have to be those of the stub, in their order."),
    (
        r"truth value of an array",
        "An `if` decides once for all cases, and so do and, or, min and max; np.where, &, |, np.minimum and np.maximum"
        " decide for each of them.",
    ),
    (
        r"remapped shapes.*\((\d+),3,3\)->.* \(3,3,\1\)->",
        "R.T turns all axes round; np.swapaxes(R, -1, -2) only the last two.",
    ),
    (
        r"not aligned|mismatch in its core dimension",
        "np.dot and @ go by rows and columns. Of many vectors, np.sum(a * b, axis=-1) is the dot product of each pair,"
        " and (matrix @ a[..., None])[..., 0] the product with each matrix; np.swapaxes(matrix, -1, -2) turns each.",
    ),
    (
        r"could not be broadcast together .*\((\d+),\) \(\1,3\)|could not be broadcast together .*\((\d+),3\) \(\2,\)",
        "A number for each case stands beside its vectors as a column: number[..., None] * vector.",
    ),
    (
        r"only (0-dimensional|length-1|size-1) arrays can be converted|doesn't define __(round|ceil|floor)__",
        "Functions of Python's own take one number; those of NumPy take arrays: np.sqrt, np.ceil, np.maximum.",
    ),
    (
        r"iteration over a 0-d array|has no len\(\)|of unsized object|too many indices for array"
        r"|is not (iter|subscript)able|does not support item assignment|invalid index to scalar variable",
        _NUMBER_OR_MANY,
    ),
    (r"index \d+ is out of bounds for axis", "Components stand along the last axis: a[..., 0], not a[0]."),
    (r"gave no answer within", "Does every loop in it come to an end, whatever it is given?"),
    (r"values to unpack", "Numbers of many cases are taken out along the last axis: x = a[..., 0]."),
    (r"cannot reshape array", "Leave the leading axes as they are: there is one entry for each case."),
    (r"float division by zero", "What should come out where the divisor is zero?"),
    (
        r"^ *gives +(?=[^\n]*\b(nan|inf)\b)(?![^\n]* instead of )[^\n]*\n *physics (?![^\n]*\binf\b)",
        "inf comes of a division by zero, nan of 0/0, of inf · 0 or of the root of a negative number: what should come"
        " out here?",
    ),
)
"""Patterns that a message is searched for, each with its advice."""
_UNKNOWN_NAME = re.compile(r"NameError: name '(\w+)' is not defined")


def advice(message: str, given: Collection[str] = ()) -> str:
    """What to do about an error; empty if nothing is sure. given: names that a notebook's given cells define."""
    if (unknown := _UNKNOWN_NAME.search(message)) and unknown[1] in given:
        return f"{unknown[1]} comes from a cell of the lab that was not run, or is gone: Run ▸ Run All Above."
    for pattern, words in _ADVICE:
        if found := re.search(pattern, message, re.MULTILINE):
            return found.expand(words)
    return ""


class Advice:
    """Advice to one reader, who gets no piece of it twice. given: as in `advice`."""

    def __init__(self, given: Collection[str] = ()) -> None:
        self._given, self._told = frozenset(given), set[str]()

    def known(self, message: str) -> bool:
        """Whether there is advice on a message."""
        return bool(advice(message, self._given))

    def new(self, message: str) -> str:
        """Advice that this reader has not had yet; empty if there is none."""
        words = advice(message, self._given)
        return words if self.is_new(words) else ""

    def is_new(self, words: str) -> bool:
        """Whether this reader has not been told these words yet; from now on the reader has been."""
        known = words in self._told
        self._told.add(words)
        return not known
