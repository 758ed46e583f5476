"""Tests a function again with the lab's own functions in place of wrong ones that it calls.

A mistake costs points where it is made, and nowhere else. So where a function loses a part, and one that it calls is
wrong, the test runs again, and the parts that pass then are earned. Only functions that come before it in the lab are
lent: a function that is found from a later one has not been written.

Threat: the text of the lent functions is in the worker's process while such a test runs, beside the submission. So of
all that the submission says there, nothing is kept except whether a part passes.
"""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from labs.grading.calling.remote import Remote
from labs.grading.errors import GraderFailed
from labs.grading.judging.case_by_case import CaseByCase
from labs.grading.judging.score_sheet import Outcome, Part, Sheet
from labs.grading.judging.submitted_functions import Functions
from labs.grading.submission.excerpts import TopicExcerpts, imports_of, text_of
from labs.grading.submission.reading import Submission
from reference import lecture
from reference.errors import InvalidInput

_LENDING = """

_lent = {{"__name__": __name__}}
exec(compile({text!r}, "lent", "exec", dont_inherit=True), _lent)
{names}
"""
"""Behind the text of a submission: the functions are made in a place of their own, so that no helper of the lab takes
the name of one of the student's."""


@dataclass(frozen=True)
class LostTest:
    """A test that lost points. place: of its outcome on the sheet. again: runs it and returns its parts."""

    place: int
    again: Callable[[Functions], list[Part]]


def lend(sheet: Sheet, lost: Iterable[LostTest], submission: Submission, remote: Remote) -> None:
    """Give back what functions lost because of others that they call, in the order of the lab."""
    by_function: dict[str, list[LostTest]] = {}
    for test in lost:
        by_function.setdefault(sheet.outcomes[test.place].function, []).append(test)
    for name in (name for name in lecture.FUNCTIONS if name in by_function):
        for test in by_function[name]:
            outcome = sheet.outcomes[test.place]
            if (names := _to_lend(sheet, outcome, submission)) and remote.budget.left:
                with contextlib.suppress(GraderFailed, InvalidInput):  # no process, no time, or no solutions here
                    found = _again(test, _with_lent(submission, lecture.function(name).topic, names), remote, sheet)
                    sheet.outcomes[test.place] = _with_returned(outcome, found, names)
        if name not in sheet.lost:
            sheet.diagnoses.pop(name, None)


def _to_lend(sheet: Sheet, outcome: Outcome, submission: Submission) -> tuple[str, ...]:
    """The wrong or suspect functions before this one that it calls, or that a scenario of a lost part called."""
    before = [entry.name for entry in lecture.functions_of(lecture.function(outcome.function).topic)]
    before = before[: before.index(outcome.function)]
    asked = {outcome.function, *(name for part in outcome.parts for name in part.others)}
    called = asked.union(*map(submission.reached, asked))
    wrong = {*sheet.lost, *sheet.suspects}
    return tuple(name for name in before if name in called and name in wrong)


def _again(test: LostTest, submission: Submission, remote: Remote, sheet: Sheet) -> list[Part]:
    paid = sheet.case_by_case.paid  # and not the failures: what an exception says here may be the text that was lent
    with Remote(submission, remote.grader, remote.budget) as other:
        return test.again(Functions(other, Sheet(case_by_case=CaseByCase(paid=paid))))


def _with_returned(outcome: Outcome, found: list[Part], names: tuple[str, ...]) -> Outcome:
    """The outcome with the lost parts that pass with the lent functions."""
    before: list[Part | None] = [*outcome.parts, *(None for _ in found[len(outcome.parts) :])]
    after = [*found, *(part for part in outcome.parts[len(found) :])]
    parts = tuple(
        old if old and (old.passed or not new.passed) else replace(new, lent=names if new.passed else ())
        for old, new in zip(before, after, strict=True)
    )
    passed = bool(parts) and all(part.passed for part in parts)
    return replace(outcome, parts=parts, passed=passed, said="" if parts else outcome.said)


def _with_lent(submission: Submission, topic: str, names: tuple[str, ...]) -> Submission:
    lines = "\n".join(f'{name} = _lent["{name}"]' for name in names)
    return replace(submission, text=submission.text + _LENDING.format(text=_text(topic, names), names=lines))


@functools.lru_cache(maxsize=256)
def _text(topic: str, names: tuple[str, ...]) -> str:
    """The lab's own functions, with all that they need; raises `InvalidInput` where there are no solutions."""
    found = _excerpts(topic).needed(names)
    return f"from __future__ import annotations\n{imports_of(found)}\n{text_of(found)}\n"


@functools.cache
def _excerpts(topic: str) -> TopicExcerpts:
    return TopicExcerpts.of(topic)
