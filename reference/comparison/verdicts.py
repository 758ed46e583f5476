"""Verdicts: whether a measured number agrees with what is expected of it, and the row that says so."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from enum import StrEnum

from reference import checks
from reference.catalogue.family import Expectation
from reference.errors import (
    CannotExpress,
    EngineNotInstalled,
    NeedsFunction,
    NoWords,
    RunFailed,
    RunLost,
    StillRunning,
)

ALL_CASES = "all"
"""The case that a row names when it speaks of a whole run."""
NOTHING_FINITE = "no finite number: the event to be measured did not happen before the run ended"


class Verdict(StrEnum):
    """Whether a measured number agrees with what is expected of it, or why there is no number.

    Two questions are kept apart: does the implementation do what its method must do, and how far is that from theory?
    A number passes if it is as predicted and near theory; it is a known deviation if it is as predicted and away from
    theory, and it disagrees if it is as predicted but wrong by as much as the number itself. Anything else fails.
    """

    PASS = "pass"
    KNOWN_DEVIATION = "known deviation"
    DISAGREES = "disagrees"
    FAIL = "fail"
    CANNOT_EXPRESS = "cannot express"
    NO_WORDS = "no words"
    NEEDS = "needs"
    NOT_AVAILABLE = "not available"
    CRASHED = "crashed"
    LOST = "lost"
    SHOWN = "shown"
    RUNNING = "running"


AS_IT_MUST = (Verdict.PASS, Verdict.KNOWN_DEVIATION, Verdict.DISAGREES)
"""Verdicts of numbers that theory and the method account for."""


@dataclass(frozen=True)
class Row:
    """One number of one case in one implementation and profile.

    expected, shift, tolerance, reason: as in `Expectation`. scale: as in `Quantity`. spread: standard deviation over an
    ensemble, and values each of its numbers. predicted: what the recurrence of the method gives; band: how near each
    number must be to it; off: the largest difference from it, measured less predicted, of any one of an ensemble; None
    where no recurrence is written. note: why there is no number, or why it deviates. All numbers are finite and in
    `unit`, or None. evidence: whether bodies that never leave their start would have another verdict, so that this one
    says something.
    engine_version, adapter_version: the version of the engine that gave the number, or should have, and that of the lab
    which told it the scenario; of a recording the second is not known. recorded_on: on which day the number was
    recorded (ISO 8601); empty where the engine ran here.
    """

    family: str
    case: str
    engine: str
    profile: str
    quantity: str
    unit: str
    verdict: Verdict
    measured: float | None = None
    spread: float | None = None
    expected: float | None = None
    tolerance: float | None = None
    reason: str = ""
    shift: float = 0.0
    note: str = ""
    scale: float | None = None
    predicted: float | None = None
    band: float | None = None
    off: float | None = None
    values: tuple[float, ...] = ()
    evidence: bool = True
    settings: str = field(default="", compare=False)
    engine_version: str = field(default="", compare=False)
    adapter_version: str = field(default="", compare=False)
    recorded_on: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        numbers = ("measured", "spread", "expected", "tolerance", "shift", "scale", "predicted", "band", "off")
        for name in numbers:
            if (value := getattr(self, name)) is not None:
                checks.finite(f"{self.family}/{self.case}, {self.quantity}: {name}", value)

    @property
    def why(self) -> str:
        """The verdict with its note."""
        return why(self.verdict, self.note)

    @property
    def error(self) -> float | None:
        """Measured minus expected, in the row's unit; None where either is missing."""
        if self.measured is None or self.expected is None:
            return None
        return self.measured - self.expected

    @property
    def relative_error(self) -> float | None:
        """The error as a share of the scale; None where the quantity has none, or it is zero."""
        if self.error is None or not self.scale:
            return None
        return self.error / self.scale


_WHAT_CANNOT = re.compile(rf"^.*? {Verdict.CANNOT_EXPRESS} .*?: ")


def why(verdict: Verdict, note: str) -> str:
    """A verdict with its note; a note that opens with the verdict's own word needs no more: `needs …`.

    Of `PyBullet cannot express corner/e=0.5: …` only the reason is left, which is the same for many cases.
    """
    if verdict is Verdict.CANNOT_EXPRESS:
        note = _WHAT_CANNOT.sub("", note)
    return note if note.startswith(verdict) else f"{verdict}: {note}"


def judge(measured: float, expectation: Expectation, as_predicted: bool | None = None) -> Verdict:
    """Judge a number by what theory says, and by whether it is as its method's recurrence predicts.

    as_predicted: None where no recurrence is written. Then what the method must give is theory + the known shift,
    within a derived bound.
    """
    if not math.isfinite(measured):
        return Verdict.FAIL
    error = abs(measured - expectation.value)
    near = error <= expectation.tolerance
    if as_predicted is None:
        off = abs(measured - expectation.value - expectation.shift)
        as_predicted = near or bool(expectation.shift and off <= expectation.shift_tolerance)
    if not as_predicted:
        return Verdict.FAIL
    if near:
        return Verdict.PASS
    size = expectation.size or abs(expectation.value)
    return Verdict.DISAGREES if 0 < size <= error + expectation.tolerance else Verdict.KNOWN_DEVIATION


def verdict_of(error: Exception) -> Verdict:
    """The verdict on a run that gave no trajectory because of this error."""
    kinds: tuple[tuple[type[Exception], Verdict], ...] = (
        (NeedsFunction, Verdict.NEEDS),
        (CannotExpress, Verdict.CANNOT_EXPRESS),
        (NoWords, Verdict.NO_WORDS),
        (EngineNotInstalled, Verdict.NOT_AVAILABLE),
        (StillRunning, Verdict.RUNNING),
        (RunLost, Verdict.LOST),
        (RunFailed, Verdict.CRASHED),
    )
    return next(verdict for kind, verdict in kinds if isinstance(error, kind))
