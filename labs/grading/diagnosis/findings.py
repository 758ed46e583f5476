"""What is known of one function of a submission: a verdict, the mistakes that explain it, a counterexample."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from labs.grading.diagnosis.deviations import Answer, Right
from labs.grading.diagnosis.fingerprints.reading import Known
from labs.grading.diagnosis.probes import Probe

Verdict = Literal[
    "right", "named", "likely", "several", "another order", "unknown", "one at a time", "crashes", "shape", "unwritten",
    "too slow", "wrong", "not tried",
]  # fmt: skip
"""right: on every probe. named: one known mistake explains every answer for a single contact. likely: one explains the
usual cases, but not all limiting ones; or it explains all that is wrong, but a few cases are right nonetheless.
several: more than one explains the same answers. another order: it returns the right things in an order of its own.
unknown: no known mistake explains them. one at a time: right for a single contact only. crashes, shape: it gives no
number to compare. unwritten: it is the stub. too slow: it ran out of time in a test and was not called again. wrong: it
failed a test, and its probes do not say why. not tried: the time of the whole submission was used up before, which says
nothing about the function."""


LEAST = 3
"""So many cases must be wrong in just the known way if the other cases give no number, or other numbers."""


@dataclass(frozen=True)
class Counterexample:
    """The simplest probe that a submission fails, its answer, and the right answer."""

    function: str
    probe: Probe
    parameters: tuple[str, ...]
    answer: Answer
    right: Right


@dataclass(frozen=True)
class Unnamed:
    """What a function with an unknown mistake returned on its probes with a single case (`diagnosis.unnamed`).

    numbers: how far each answer deviates, or a word if it is no number. place: of the simplest probe with a wrong
    number among these. example: that probe with its answer.
    """

    numbers: tuple[float | str, ...]
    place: int
    example: Counterexample


@dataclass(frozen=True)
class Diagnosis:
    """What is known of one function of a submission.

    mistakes: the known ones that explain its numbers. counterexample: the simplest probe that it fails. crashes: the
    errors that it raised on good input. one_alone: whether the mistake explains single contacts only, and calls with
    several go wrong in another way. crash_in_many: whether only calls with several contacts end in an error. accepted:
    cases of bad input that it should have refused. changes_input: whether it writes into its arguments. odd: the
    simplest probe that a likely mistake does not explain. limits_alone: whether all usual cases are right. order: the
    places of what it returns, if only their order is wrong. spares_limits: whether limiting cases are right that a
    likely mistake would get wrong. spares_cases: whether cases of any kind are, and all that is wrong is the mistake's.
    unnamed: what an unknown mistake gives, as far as it can be recognised again.
    """

    function: str
    verdict: Verdict
    mistakes: tuple[Known, ...] = ()
    counterexample: Counterexample | None = None
    crashes: tuple[str, ...] = ()
    one_alone: bool = False
    crash_in_many: bool = False
    accepted: tuple[str, ...] = ()
    changes_input: bool = False
    odd: Counterexample | None = None
    limits_alone: bool = False
    order: tuple[int, ...] = ()
    spares_limits: bool = False
    spares_cases: bool = False
    unnamed: Unnamed | None = None

    def error_is_in(self, *examples: Counterexample | None) -> bool:
        """Whether one of these examples ends in the error that is named first."""
        return any(example.answer.error in self.crashes[:1] for example in examples if example)

    @property
    def right(self) -> bool:
        """Whether every number is right and no input was changed."""
        return self.verdict == "right" and not self.changes_input
