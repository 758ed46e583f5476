"""Advice on messages of Python and NumPy, for students who write a function of the lab; given only where it is sure.

Students read the messages themselves as well. The advice adds what they leave out, and corrects NumPy's own advice if
it does not fit the lab: `a.any()` is wrong if each case has to be decided by itself.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from reference import lecture

_NUMBER_OR_MANY = (
    "It is called with one number, or with an array of many: np.where and NumPy's functions take both, a loop does not;"
    " components stand along the last axis, a[..., 0]."
)
_COLUMN = (
    "A number for each case stands beside its vectors as a column: number[..., None] * vector. Likewise the condition"
    " of np.where: np.where(condition[..., None], b, c)."
)
_TABLE = (
    "A row of numbers times a column of them is a table. Each number for a case stands beside the vectors as a column,"
    " also one that is given: np.asarray(number)[..., None]."
)
_ADVICE = (
    (r"name 'np' is not defined", "`import numpy as np` is missing."),
    (r"name '(numpy|math)' is not defined", r"`import \1` is missing."),
    (r"module 'numpy' has no attribute 'trapz'", "NumPy 2 calls it np.trapezoid."),
    (
        r"No module named|name 'scipy' is not defined",
        "The lab is written with NumPy and Python's standard library: no other package, such as SciPy, is there when it"
        " is checked and graded, and no file.",
    ),
    (
        r"complex numbers instead of|an object of type (numpy\.)?complex",
        "The square root of a negative number is complex in (-1) ** 0.5, cmath and np.emath. Which case is that, and"
        " what should come out of it?",
    ),
    (r"for \^: |ufunc 'bitwise_xor' not supported", "A power is a ** b in Python; a ^ b compares bits of integers."),
    (
        r"'Body' object has no attribute",
        "The parts of a body of the lab are velocity, angular_velocity, arm, inverse_mass and inverse_inertia.",
    ),
    (
        r"Cannot cast ufunc '\w+' output from dtype\('float64'\) to dtype\('int",
        "An array of whole numbers can hold no others: np.array(p, dtype=float) makes your own of them.",
    ),
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
        r"einstein sum subscripts string contains too many subscripts|operand has more dimensions than subscripts",
        "With dots for the leading axes it takes one case and many: np.einsum('...i,...i->...', a, b).",
    ),
    (
        r"inhomogeneous shape",
        "Vectors of many cases and of one do not fit into one array: np.stack(np.broadcast_arrays(x, y, z), axis=-1).",
    ),
    (
        r"does not have enough dimensions",
        "@ is a product of vectors and matrices: a number times something is a * b.",
    ),
    (
        r"could not be broadcast together .*(\(\d+,\) \((\d+,)*3,?\)|\((\d+,)*3,?\) \(\d+,\))",
        _COLUMN,
    ),
    (
        r"could not be broadcast together .*(\((\d+),\2\) \((\d+,)*3,?\)|\((\d+,)*3,?\) \((\d+),\5\))",
        _TABLE,
    ),
    (
        r"of shape \((\d+), \1\) instead of \(\1,\)",
        "np.dot and @ of two rows of vectors combine every vector with every other one: np.sum(a * b, axis=-1) is the"
        " dot product of each pair.",
    ),
    (
        r"of shape (\(3,\)|\(\)) instead of \(\d",
        "A sum over the wrong axis adds up the cases. Components stand along the last axis: np.sum(a * b, axis=-1), and"
        " np.linalg.norm(a, axis=-1) likewise.",
    ),
    (
        r"axis \d+ is out of bounds for array of dimension",
        "axis=-1 is the last axis, that of the components, for one case as well as for many.",
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
)
"""Patterns that a message is searched for, each with its advice."""
MAY_BE_INFINITE = (
    "time_of_impact_interpolated", "time_of_impact_exact", "overlap_interval", "sliding_motion", "break_away_time",
    "segment_triangle", "ray_sphere", "sweep_sphere_sphere", "ray_box", "ray_capsule", "advance", "timestep_bound",
)  # fmt: skip
"""Functions that students write and that return infinity on purpose in some cases: no division by zero gave it."""
MAY_BE_NO_NUMBER = ("segment_triangle", "advance")
"""Those that return NaN on purpose, most of them beside infinity: such an answer says that nothing was found."""
NO_NUMBER_ALONE = ("advance",)
"""Those whose NaN stands alone: it says that all looks were used up."""
_NOT_FINITE = re.compile(
    r"^ *gives +(?=[^\n]*\b(nan|inf)\b)(?![^\n]* instead of )([^\n]*)\n *physics (?![^\n]*\binf\b)", re.MULTILINE
)
_CALLED = re.compile(r"^ *(\w+)\(", re.MULTILINE)
_INF = "inf comes from a division by zero, unless it is in your code; "
_NAN = "nan comes from 0/0, inf · 0 or the root of a negative number. What should come out here?"
_UNKNOWN_NAME = re.compile(r"NameError: name '(\w+)' is not defined")


def advice(message: str, given: Collection[str] = ()) -> str:
    """What to do about an error; empty if nothing is sure. given: names that a notebook's given cells define."""
    if (unknown := _UNKNOWN_NAME.search(message)) and unknown[1] in given:
        return f"{unknown[1]} comes from a cell of the lab that was not run, or is gone: Run ▸ Run All Above."
    if unknown and unknown[1] in lecture.FUNCTIONS:
        return f"{unknown[1]} is a function of a lab: write it, and run its cell before this one."
    for pattern, words in _ADVICE:
        if found := re.search(pattern, message, re.MULTILINE):
            return found.expand(words)
    if found := _NOT_FINITE.search(message):
        called = _CALLED.search(message)
        if called is None or called[1] not in MAY_BE_INFINITE:
            return _INF + _NAN
        beside = called[1] in MAY_BE_NO_NUMBER and "inf" in found[2]
        on_purpose = beside or called[1] in NO_NUMBER_ALONE
        return _NAN if "nan" in found[2] and not on_purpose else ""
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
