"""How a module of a platform runs there: it writes a result that has the platform's shape, or none at all."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from labs.gradebook.platforms.shapes import Check
from labs.grading.errors import GraderFailed
from labs.grading.judging.grade import as_json, write_private
from labs.grading.safe_text import one_line
from reference.errors import CollisionsError

FAILED = 1


def written(result: Mapping[str, Any], check: Check, path: Path) -> None:
    """Write a result that has the platform's shape.

    Raises
    ------
    GraderFailed
        If it has not: then no result is better than one that the platform misreads.
    """
    if wrong := list(check(result, "")):
        raise GraderFailed(f"the result has not the shape that the platform takes: {'; '.join(wrong[:5])}")
    write_private(path, as_json(result))


def run(grade: Callable[[], None]) -> int:
    """Grade on a platform, and return the exit code.

    If grading fails for no fault of the submission, no result is written and the code is not 0. The platform then says
    that the autograder failed, and takes no points from anybody.
    """
    try:
        grade()
    except CollisionsError as error:
        print(f"Error: {one_line(str(error))}", file=sys.stderr)
        return FAILED
    return 0
