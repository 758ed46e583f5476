"""What Python's and NumPy's messages mean to who writes a function of the lab: a word on what to do, where it is sure.

The messages are the student's own reading as well; a hint beside them says what they leave out, and what NumPy's own
advice gets wrong here, such as `a.any()` where each contact is to be decided by itself.
"""

from __future__ import annotations

import re

_ADVICE = (
    (r"name 'np' is not defined", "`import numpy as np` is missing."),
    (r"name '(numpy|math)' is not defined", r"`import \1` is missing."),
    (r"module 'numpy' has no attribute 'trapz'", "NumPy 2 calls it np.trapezoid."),
    (r"No module named", "Here are NumPy and plain Python: no other packages, and no files."),
    (r"maximum recursion depth", "It calls itself again and again."),
    (r"positional arguments? but \d+ (was|were) given", "Its arguments have to be those of the stub, in their order."),
    (r"truth value of an array", "An `if` decides once for all contacts; np.where decides for each of them."),
    (
        r"not aligned|mismatch in its core dimension",
        "np.dot and @ go by rows and columns. Of many vectors, np.sum(a * b, axis=-1) is the dot product of each pair,"
        " and (matrix @ a[..., None])[..., 0] the product with each matrix.",
    ),
    (
        r"could not be broadcast together .*\((\d+),\) \(\1,3\)|could not be broadcast together .*\((\d+),3\) \(\2,\)",
        "A number for each contact stands beside its vectors as a column: number[..., None] * vector.",
    ),
    (
        r"only (0-dimensional|length-1|size-1) arrays can be converted|doesn't define __(round|ceil|floor)__",
        "Functions of Python's own take one number; those of NumPy take arrays: np.sqrt, np.ceil, np.maximum.",
    ),
    (r"gave no answer within", "Does every loop in it come to an end, whatever it is given?"),
    (r"values to unpack", "Numbers of many contacts are taken out along the last axis: x = a[..., 0]."),
    (r"cannot reshape array", "Leave the leading axes as they are: there is one entry for each contact."),
    (r"float division by zero", "What should come out where the divisor is zero?"),
)
"""A pattern that a message is searched for, and what is said of it."""


def advice(message: str) -> str:
    """What to do about an error, empty where nothing is sure."""
    for pattern, words in _ADVICE:
        if found := re.search(pattern, message):
            return found.expand(words)
    return ""
