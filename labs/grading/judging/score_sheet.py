"""The score sheet of a submission: what it earned test by test, in whole points, and words that a student may read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, field
from typing import Literal

from labs.grading.diagnosis.findings import Diagnosis, Verdict
from labs.grading.judging.case_by_case import CaseByCase
from labs.grading.submission.cells import Complaint

_UNTRIED: frozenset[Verdict] = frozenset({"not tried"})
"""Verdicts that say nothing about a function."""
Cause = Literal["", "time", "several cases", "missing"]
"""What was lost alone for want of time, alone because a call had several cases, or for want of a function that is not
written; empty for everything else."""


@dataclass(frozen=True)
class Part:
    """A part of a test that has points of its own.

    said: why it failed; None if it passed. others: functions besides the tested one that a scenario of a failed part
    called. cause: of the failure. through: the submission's functions that an exception passed through. lent: wrong
    functions that it calls, if it passed only with the lab's own in their place.
    """

    points: int
    reason: str
    said: str | None = None
    others: tuple[str, ...] = ()
    cause: Cause = ""
    through: tuple[str, ...] = ()
    lent: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether its points are earned."""
        return self.said is None


@dataclass(frozen=True)
class Outcome:
    """One test. said: what happened, fit to be shown; for a hidden test without inputs or expected values.

    rationale: why the test is right to ask. help: what to look at. parts: those that have points of their own.
    function: which one it is about; empty if it is about several. cause, through: of the failure of a test without
    parts.
    """

    test: str
    points: int
    passed: bool
    hidden: bool = False
    said: str = ""
    rationale: str = ""
    help: str = ""
    parts: tuple[Part, ...] = ()
    function: str = ""
    cause: Cause = ""
    through: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """The test's name as the statement that it is."""
        return self.test.removeprefix("test_").replace("_", " ")

    @property
    def earned(self) -> int:
        """All points if it passed, otherwise those of the parts that did."""
        return self.points if self.passed else min(self.points, sum(part.points for part in self.parts if part.passed))

    def lines(self) -> Iterator[str]:
        """For a student: what is missing and why, with the parts if some are right; nothing if it passed."""
        if self.passed:
            return
        yield f"{self.title}: {self.earned} of {self.points}"
        yield from (line for line in (self.said, self.rationale, self.help) if line)
        for part in self.parts if any(part.passed for part in self.parts) else ():
            yield f"{part.points if part.passed else 0} of {part.points} for {part.reason}"

    @property
    def failures(self) -> tuple[tuple[str, str], ...]:
        """Each part that was lost, and what was said of it, equal words once; of a test without parts, the test."""
        lost = [(part.reason, part.said) for part in self.parts if part.said is not None]
        said = [words for _, words in lost]
        found = tuple((reason, "" if words in said[:at] else words) for at, (reason, words) in enumerate(lost))
        return found or (() if self.passed else ((self.title, self.said),))

    def raised_in(self, functions: Collection[str]) -> set[str]:
        """What was said of exceptions that passed through one of some functions."""
        found = {
            part.said for part in self.parts if part.said is not None and not {*functions}.isdisjoint(part.through)
        }
        return found | ({self.said} if not {*functions}.isdisjoint(self.through) else set())

    @property
    def causes(self) -> set[Cause]:
        """The causes of all that was lost."""
        return {part.cause for part in self.parts if not part.passed} or (set() if self.passed else {self.cause})


@dataclass
class Sheet:
    """All outcomes of one submission.

    complaints: about the file. unread: functions in text that Python cannot read. tier: how far its processes were shut
    in. missing: a line for each measure of the sandbox that they lacked. skipped: why tests were left out. diagnoses:
    of the functions that lost points. suspects: diagnoses of functions that pass all their tests and give wrong answers
    to open probes. uses: which of the submission's functions each of all these calls, and each that these call.
    beneath: outcomes, without points, of functions that were not asked for but that wrong ones call. given: names that
    the lab's own cells define, if it is a notebook. borrows: variables of other cells that a wrong function reads, with
    the cell. case_by_case: functions that were asked for one case at a time.
    """

    submission: str = ""
    complaints: list[Complaint] = field(default_factory=list)
    unread: tuple[str, ...] = ()
    tier: str = ""
    missing: tuple[str, ...] = ()
    outcomes: list[Outcome] = field(default_factory=list)
    skipped: list[str] = field(default_factory=list)
    diagnoses: dict[str, Diagnosis] = field(default_factory=dict)
    suspects: dict[str, Diagnosis] = field(default_factory=dict)
    uses: dict[str, list[str]] = field(default_factory=dict)
    beneath: list[Outcome] = field(default_factory=list)
    given: frozenset[str] = frozenset()
    borrows: dict[str, dict[str, str]] = field(default_factory=dict)
    case_by_case: CaseByCase = field(default_factory=CaseByCase)

    def about(self, function: str) -> list[Outcome]:
        """The outcomes of a function's tests, asked for or beneath."""
        return [outcome for outcome in (*self.outcomes, *self.beneath) if outcome.function == function]

    def lent(self, function: str) -> list[str]:
        """The wrong functions that a function calls and whose mistakes have cost it nothing."""
        parts = (part for outcome in self.about(function) for part in outcome.parts)
        return list(dict.fromkeys(name for part in parts for name in part.lent))

    def causes(self, function: str) -> set[Cause]:
        """The causes of all that a function lost."""
        return {cause for outcome in self.about(function) for cause in outcome.causes}

    def add_beneath(self, other: Sheet) -> None:
        """Add the sheet of functions that wrong ones call."""
        self.beneath += other.outcomes
        self.diagnoses |= other.diagnoses
        self.suspects |= other.suspects
        self.uses |= other.uses
        self.borrows |= other.borrows
        self.case_by_case.functions |= other.case_by_case.functions
        self._clear_callers()

    def note_uses(self, uses: Callable[[str], list[str]]) -> None:
        """Note what wrong and suspect functions call. `uses` says it of any function of the submission."""
        waiting = [*self.lost, *self.suspects]
        while waiting:
            name = waiting.pop()
            if name not in self.uses:
                self.uses[name] = uses(name)
                waiting += self.uses[name]
        self._clear_callers()

    def _clear_callers(self) -> None:
        """Clear functions of suspicion that call a wrong or suspect one: they may be right themselves."""
        self.suspects = {name: found for name, found in self.suspects.items() if not self._excuse(name, found)}

    def _excuse(self, name: str, found: Diagnosis) -> list[str]:
        """The functions that may have given a suspect its wrong numbers.

        A function that is right for each single case makes no single case wrong.
        """
        single = found.counterexample is not None and found.counterexample.probe.group != "many"
        return self.wrong_uses(name, _UNTRIED | {"one at a time"} if single else _UNTRIED)

    def wrong_uses(self, name: str, harmless: Collection[Verdict] = _UNTRIED) -> list[str]:
        """The wrong or suspect functions that a function calls, directly or through others that seem right.

        harmless: verdicts on functions that count as right here.
        """
        waiting, seen = [name], {name}
        found: list[str] = []
        while waiting:
            for other in self.uses.get(waiting.pop(0), ()):
                if other not in seen:
                    seen.add(other)
                    known = self.diagnosis(other)
                    (found if known and known.verdict not in harmless else waiting).append(other)
        return found

    def diagnosis(self, name: str) -> Diagnosis | None:
        """What is known of a function that is wrong or suspect."""
        return self.diagnoses.get(name) or self.suspects.get(name)

    @property
    def passed(self) -> list[str]:
        """The functions that passed all their tests, in the order of the tests."""
        lost = set(self.lost)
        names = dict.fromkeys(outcome.function for outcome in self.outcomes)
        return [name for name in names if name and name not in lost]

    @property
    def lost(self) -> list[str]:
        """The functions that failed a test, in the order of the tests."""
        return list(
            dict.fromkeys(outcome.function for outcome in self.outcomes if outcome.function and not outcome.passed)
        )

    @property
    def left_out(self) -> dict[str, int]:
        """How many tests were skipped, by the reason."""
        return dict(Counter(self.skipped))

    @property
    def earned(self) -> int:
        """The points of all tests together."""
        return sum(outcome.earned for outcome in self.outcomes)

    @property
    def points(self) -> int:
        """What could be earned."""
        return sum(outcome.points for outcome in self.outcomes)
