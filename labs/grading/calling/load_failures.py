"""Statements of a submission that failed on loading: which names each would have defined, and why it failed.

Threat: the list comes from the submission, may have thousands of entries, and is consulted for every error. So it is
sorted by name once.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any, TypeGuard

from labs.grading.submission.cells import CODE_LIMIT
from labs.grading.worker.loading import Failure

_QUOTED = re.compile(r"'(\w+)'")
_NAMED = 200  # characters at the start of a NameError's message that contain the name


class Failures:
    """The statements that failed. said: entries as the worker sends them; odd ones are left out.

    within: entries for statements in loops and branches, which went on. every: all that are well formed.
    """

    def __init__(self, said: Iterable[Any] = (), within: Iterable[Any] = ()) -> None:
        self._by_name: dict[str, Failure] = {}  # "" is every name
        inner = [failure for failure in within if _is_failure(failure)]
        outer = [failure for failure in said if _is_failure(failure)]
        self.every = (*inner, *outer)
        for failure in outer:
            for name in failure[0]:
                self._by_name.setdefault(name, failure)
        for failure in inner:
            for name in failure[0]:
                self._by_name.setdefault(name, failure)

    def of(self, name: str) -> Failure | None:
        """Why a name could not be defined; None if nothing is known of it."""
        return self._by_name.get(name) or self._by_name.get("")

    def behind(self, message: str) -> Failure | None:
        """Why the name in a NameError's message could not be defined; None if nothing is known of it."""
        found = _QUOTED.search(message, 0, _NAMED)
        return self._by_name.get(found[1]) if found else None


def is_line(found: object) -> TypeGuard[int]:
    """Whether it can be the number of a line."""
    return isinstance(found, int) and 0 < found <= CODE_LIMIT


def _is_failure(found: object) -> TypeGuard[Failure]:
    """Whether it is the worker's entry for a statement that failed: names, type, message, line."""
    match found:
        case (list(names), str(), str(), line):
            return all(isinstance(name, str) for name in names) and (line is None or is_line(line))
    return False
