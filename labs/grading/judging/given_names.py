"""The names that a lab's own cells define, such as checks of arguments, the type of a body, and `np`."""

from __future__ import annotations

import contextlib
import functools
import json
from collections.abc import Collection
from pathlib import Path

from labs.grading.submission.statements import groups
from labs.project_folders import STUDENT_NOTEBOOKS

TAG = "given"


def given_names(topics: Collection[str]) -> frozenset[str]:
    """The names that the cells of some labs define; none for a lab that has no notebook here."""
    return frozenset(name for topic in topics for name in _names(STUDENT_NOTEBOOKS / f"{topic}.ipynb"))


@functools.cache
def _names(path: Path) -> frozenset[str]:
    found: set[str] = set()
    with contextlib.suppress(OSError, ValueError, KeyError, TypeError, SyntaxError):  # a student may work in it
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            if TAG in cell["metadata"].get("tags", ()):
                found |= {name for group in groups("".join(cell["source"])) for name in group.defines}
    return frozenset(found)
