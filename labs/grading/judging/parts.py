"""The parts of a test that runs, each with points of its own."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from labs.grading.errors import GraderFailed, StudentError
from labs.grading.judging import case_by_case, same_answers
from labs.grading.judging.outcomes import NOTHING_COMPUTED, cause_of, said, through
from labs.grading.judging.score_sheet import Part
from labs.grading.judging.submitted_functions import Functions


@dataclass
class Parts:
    """Notes the parts of one test: `with part(2, "the normal direction"): assert …` may fail without ending the test.

    test, function: the test's name, and the function that it is about. found: the parts so far, in their order.
    """

    functions: Functions
    test: str
    function: str
    hidden: bool
    found: list[Part] = field(default_factory=list)

    @contextlib.contextmanager
    def __call__(self, points: int, reason: str) -> Iterator[None]:
        """A part of the test."""
        functions = self.functions
        functions.begin_part()
        try:
            yield
        except (AssertionError, StudentError, *NOTHING_COMPUTED) as error:
            others = tuple(sorted(functions.asked - {self.function}))
            words = said(error, self.hidden)
            self.found.append(Part(points, reason, words, others, cause_of(error), through(error)))
        else:
            require_evidence(f"{self.test}, {reason!r}", functions)
            failure = functions.case_by_case.charge()
            charged = None if failure is None else case_by_case.GIST if self.hidden else said(failure, self.hidden)
            self.found.append(Part(points, reason, charged, cause="several cases"))

    def take_back(self) -> None:
        """At the end of the test: take all parts back if its function has given the same answer to every question."""
        if words := self.functions.same_answers[self.function].found():
            told = same_answers.GIST if self.hidden else f"{self.function} {words}"
            self.found[:] = [replace(each, said=told, cause="") if each.passed else each for each in self.found]


def require_evidence(what: str, functions: Functions) -> None:
    """Stop the grading where a test, or a part of one, passes although no function of the submission has answered."""
    if not functions.answered:
        raise GraderFailed(f"{what}: it passes, but has called no function of the submission")
