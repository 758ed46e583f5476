"""`lab.check()`: the visible tests of functions in the cells that were run, in words."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from labs.grading import running, saying
from labs.grading.errors import UnreadableSubmission
from labs.grading.remote import Grader
from reference import lecture
from reference.errors import InvalidInput

_REWRITTEN = re.compile(r"defined \d+ times")
"""In a kernel that is what writing a function is: the cell is run again."""


def report(notebook: Path, topic: str, names: Sequence[str], grader: Grader) -> str:
    """What the visible tests say of some functions, or of all that the lab has written.

    Raises
    ------
    InvalidInput
        If there is nothing to check: no test of that function, or no code yet.
    """
    topics = tuple(dict.fromkeys(lecture.function(name).topic for name in names)) or (topic,)
    untested = [name for name in names if lecture.function(name).role != "written"]
    if untested:
        raise InvalidInput(f"{', '.join(untested)} is given: there is nothing of it to check")
    try:
        sheet = running.run(notebook, topics, (running.VISIBLE,), grader, names)
    except UnreadableSubmission as error:
        raise InvalidInput(f"nothing can be checked yet: {error}") from None
    sheet.complaints = [each for each in sheet.complaints if not _REWRITTEN.search(each)]
    silent = all(each.endswith("missing") for each in sheet.complaints)
    if len(names) == 1 and silent and saying.all_right(sheet):
        return f"{saying.RIGHT} {names[0]} is right, as far as this tries it: {saying.HIDDEN}."
    return "\n".join(saying.report(sheet, topics)).strip("\n")
