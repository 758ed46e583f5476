"""Asks a function that fails for several cases in one call for one case at a time, and notes it.

Broadcasting is no physics: a function right for each single case costs at most one part of a lab for it, as
`CaseByCase.charge` decides. How arguments with different leading axes combine is left open, and costs nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

from labs.grading.diagnosis.probes.one_case import one_case
from labs.grading.errors import GraderFailed, StudentError
from reference import lecture

GIST = "the function is right for one case, not for several in one call"
"""What is said of a hidden test."""


@dataclass
class CaseByCase:
    """Which functions of a submission were asked for one case at a time.

    functions: each with the first failure for several cases. paid: of each topic, the function that lost a part.
    """

    functions: dict[str, Exception] = field(default_factory=dict)
    paid: dict[str, str] = field(default_factory=dict)
    _in_this_part: dict[str, Exception] = field(default_factory=dict, repr=False)

    def note(self, function: str, failure: Exception) -> None:
        """Note that a function is right for each case of a call, and failed for all of them together."""
        self.functions.setdefault(function, failure)
        self._in_this_part.setdefault(function, failure)

    def begin_part(self) -> None:
        """Begin a part of a test."""
        self._in_this_part.clear()

    def charge(self) -> Exception | None:
        """The failure that costs this part its points; None if there is none, or if its topic has lost a part already.

        A part of which something else fails is lost for that, and its topic is not charged.
        """
        for function, failure in self._in_this_part.items():
            topic = lecture.function(function).topic
            if topic not in self.paid:
                self.paid[topic] = function
                return failure
        return None


class Asked(Protocol):
    """A function of a submission, and where it is noted."""

    name: str
    functions: Any

    def __call__(self, *arguments: Any) -> Any:
        """Call it in the test's process."""


def right_alone(
    function: Asked, arguments: tuple[Any, ...], is_right: Callable[[Any], bool], failure: Exception
) -> bool:
    """Whether a function that failed for several cases is right for each of them.

    is_right: of an answer for all cases. failure: what it did with all of them in one call, which is noted. The
    arguments that single calls write to count as changed.
    """
    case = one_case(function.name)
    try:
        if case is None or not case.leading(arguments):
            return False
        if _holds(lambda: case.in_rows(function, arguments), is_right):
            return True
        changed: set[int] = set()

        def watched(*single: Any) -> Any:
            value = function(*single)
            changed.update(function.functions.process().changed)
            return value

        if not _holds(lambda: case.one_by_one(watched, arguments), is_right):
            return False
    except ValueError:  # arguments that do not fit together
        return False
    function.functions.process().changed = tuple(sorted(changed))
    function.functions.case_by_case.note(function.name, failure)
    return True


def _holds(asked: Callable[[], Any], is_right: Callable[[Any], bool]) -> bool:
    try:
        return is_right(asked())
    except GraderFailed:
        raise
    except (StudentError, AssertionError, ValueError, TypeError):  # no answer, or answers that do not fit together
        return False
