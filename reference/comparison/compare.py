"""Measured against expected: rows with a verdict, each with the reason for its tolerance."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from reference import checks
from reference.catalogue.case import Case
from reference.catalogue.family import Expectation, Family, Quantity
from reference.engines.base import Engine, Method
from reference.engines.profiles import TUNED
from reference.errors import (
    CannotExpress,
    EngineNotInstalled,
    NeedsFunction,
    RunFailed,
    Unforeseen,
    WorkerCrashed,
    WorkerTimeout,
    as_failed_run,
)
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

ALL_CASES = "all"
"""What a row says as its case when it speaks of a whole run."""
NOTHING_FINITE = "no finite number: what is asked for did not happen before the run ended"


class Verdict(StrEnum):
    """How a measured number stands to what is expected of it."""

    PASS = "pass"
    KNOWN_DEVIATION = "known deviation"
    FAIL = "fail"
    CANNOT_EXPRESS = "cannot express"
    NEEDS = "needs"
    NOT_AVAILABLE = "not available"
    CRASHED = "crashed"
    SHOWN = "shown"


@dataclass(frozen=True)
class Row:
    """One number of one case in one implementation and profile.

    expected, shift, tolerance and scale as in `Expectation` and `Quantity`; spread: standard deviation over an
    ensemble; note: why there is no number, or why it deviates. Numbers in `unit` and finite, None where there is none.
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
    settings: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        for name in ("measured", "spread", "expected", "tolerance", "shift", "scale"):
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


def why(verdict: Verdict, note: str) -> str:
    """A verdict with its note; a note that opens with the same word stands alone: `needs …`."""
    return note if note.startswith(verdict) else f"{verdict}: {note}"


def judge(measured: float, expectation: Expectation) -> Verdict:
    """Say how a number stands: within tolerance of theory, or of what the method is known to make of theory."""
    if not math.isfinite(measured):
        return Verdict.FAIL
    if abs(measured - expectation.value) <= expectation.tolerance:
        return Verdict.PASS
    deviation = abs(measured - expectation.value - expectation.shift)
    if expectation.shift and deviation <= expectation.shift_tolerance:
        return Verdict.KNOWN_DEVIATION
    return Verdict.FAIL


def compare_case(
    family: Family, case: Case, engine: Engine, profile: str, settings: Settings
) -> tuple[list[Row], list[Trajectory]]:
    """Run one case in one engine; return its rows, and the trajectories for whoever wants to plot them.

    Whatever an engine or hand-written code raises becomes a row, but for `InvalidInput`: that is the caller's mistake.
    """
    try:
        with as_failed_run():
            trajectories = engine.run_many(case.scenarios, settings)
            method = engine.method(case.scenarios[0], settings)
    except (NeedsFunction, CannotExpress, EngineNotInstalled, RunFailed) as error:
        blank = Row(family.name, case.name, engine.name, profile, "", "", verdict_of(error))
        return [replace(blank, note=str(error), settings=settings.describe())], []
    numbers = {quantity.name: measured(quantity, trajectories) for quantity in family.quantities}
    return judged(family, case, engine.name, profile, settings, method, numbers), trajectories


@dataclass(frozen=True)
class Number:
    """What was measured of one quantity: its mean and standard deviation over an ensemble, or why there is none."""

    mean: float | None = None
    spread: float | None = None
    note: str = ""
    crashed: bool = False


def measured(quantity: Quantity, trajectories: Sequence[Trajectory]) -> Number:
    """Measure a quantity of each trajectory, and take the mean."""
    try:
        with as_failed_run():
            values = [float(quantity.measure(trajectory)) for trajectory in trajectories]
    except Unforeseen as error:
        return Number(note=str(error), crashed=True)
    except RunFailed as error:  # the run is there, but it has no such number: a body that still moves has not stopped
        return Number(note=str(error))
    mean, spread = _mean_and_spread(values)
    return Number(mean, spread) if mean is not None else Number(note=NOTHING_FINITE)


def judged(
    family: Family,
    case: Case,
    engine: str,
    profile: str,
    settings: Settings,
    method: Method,
    numbers: Mapping[str, Number],
) -> list[Row]:
    """One row a quantity: its number, what theory says with these settings, and how the two stand."""
    blank = Row(family.name, case.name, engine, profile, "", "", Verdict.SHOWN, settings=settings.describe())
    rows = []
    for quantity in family.quantities:
        expectation = quantity.expect(case, settings, method) if quantity.expect else None
        scale = quantity.scale(case) if quantity.scale else None
        row = replace(blank, quantity=quantity.name, unit=quantity.unit, scale=scale)
        if expectation is not None:
            row = replace(
                row,
                expected=expectation.value,
                tolerance=expectation.tolerance,
                reason=expectation.reason,
                shift=expectation.shift,
            )
        rows.append(_with_number(row, numbers[quantity.name], expectation))
    return rows


def _with_number(row: Row, number: Number, expectation: Expectation | None) -> Row:
    if number.crashed:
        return replace(row, verdict=Verdict.CRASHED, note=number.note)
    if number.mean is None:
        return replace(row, verdict=Verdict.FAIL if expectation else Verdict.SHOWN, note=number.note)
    row = replace(row, measured=number.mean, spread=number.spread)
    if expectation is None:
        return row
    verdict = judge(number.mean, expectation)
    note = expectation.shift_reason if verdict is Verdict.KNOWN_DEVIATION else ""
    return replace(row, verdict=verdict, note=note)


def _mean_and_spread(values: Sequence[float]) -> tuple[float | None, float | None]:
    """Mean and standard deviation, None for one that is not finite; a single value has no spread."""
    with np.errstate(over="ignore", invalid="ignore"):  # of ∞ − ∞, or of numbers whose squares are none
        mean, spread = float(np.mean(values)), float(np.std(values))
    return mean if math.isfinite(mean) else None, spread if len(values) > 1 and math.isfinite(spread) else None


def verdict_of(error: Exception) -> Verdict:
    """The verdict that stands for a run that gave no trajectory."""
    kinds: tuple[tuple[type[Exception], Verdict], ...] = (
        (NeedsFunction, Verdict.NEEDS),
        (CannotExpress, Verdict.CANNOT_EXPRESS),
        (EngineNotInstalled, Verdict.NOT_AVAILABLE),
        (WorkerTimeout, Verdict.CRASHED),
        (WorkerCrashed, Verdict.CRASHED),
        (RunFailed, Verdict.CRASHED),
    )
    return next(verdict for kind, verdict in kinds if isinstance(error, kind))


def failures(rows: Sequence[Row]) -> list[Row]:
    """The rows that count against a comparison: tuned ones that failed."""
    return [row for row in rows if row.profile == TUNED and row.verdict is Verdict.FAIL]


def without_answer(rows: Sequence[Row]) -> list[Row]:
    """The rows whose run crashed, hung or gave no usable state."""
    return [row for row in rows if row.verdict is Verdict.CRASHED]
