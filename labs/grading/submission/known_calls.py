"""Which calls and methods of Python and NumPy are sure to change nothing that they are given."""

from __future__ import annotations

import collections
import inspect
import sys
import types
from functools import lru_cache

import numpy as np

from labs.grading.submission.effects import CHANGING_METHODS

AT_HAND = {*sys.stdlib_module_names, "numpy"}
"""Packages that a submission can import where it is graded."""
CHANGING_BUILTINS = {"setattr", "delattr", "next"}
SHOWING, LAZY = "print", {"map", "filter", "iter"}
IN_PLACE = {"out", "copy", "overwrite_input", "op_flags"}
"""Keywords by which functions of NumPy change what they are given."""
_CONTAINERS = (list, dict, set, str, tuple, collections.deque, collections.Counter, collections.OrderedDict, np.ndarray)
READING_METHODS = {name for each in _CONTAINERS for name in dir(each)} - CHANGING_METHODS
"""What reads a list, a set, a table, a queue or an array and leaves it as it is."""


@lru_cache(maxsize=1000)
def gives_a_value(path: tuple[str, ...]) -> bool:
    """Whether a function of NumPy gives a value, by its documentation, and so changes nothing that it is given."""
    names = [*path[0].split("."), *path[1:]]
    found: object = np
    if names[0] == "math":
        return True
    if names[0] != "numpy":
        return False
    for name in names[1:]:
        if not isinstance(found, types.ModuleType) or name.startswith("_"):
            return False
        found = vars(found).get(name)
    return callable(found) and "Returns\n-------\n" in (inspect.getdoc(found) or "").replace(
        "Returns\n-------\nNone", ""
    )
