"""One case in one engine: it is run, its quantities are measured, and each number becomes a row with a verdict."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from reference.catalogue.case import Case
from reference.catalogue.family import Expectation, Family, Quantity
from reference.comparison.verdicts import NOTHING_FINITE, Row, Verdict, judge, verdict_of
from reference.engines.base import Engine, Method
from reference.errors import (
    CannotExpress,
    EngineNotInstalled,
    NeedsFunction,
    RunFailed,
    Unforeseen,
    as_failed_run,
)
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory


def compare_case(
    family: Family, case: Case, engine: Engine, profile: str, settings: Settings
) -> tuple[list[Row], list[Trajectory]]:
    """Run one case in one engine; return its rows, and the trajectories for plots and replays.

    Every error that an engine or hand-written code raises becomes a row, except `InvalidInput`: that is the caller's
    mistake.
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
    """What was measured of one quantity: mean and standard deviation over an ensemble, or why there is no number."""

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
    except RunFailed as error:  # the run has no such number: a body that still moves has no stopping distance
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
    """A row for each quantity: its number, what theory says with these settings, and the verdict."""
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
    with np.errstate(over="ignore", invalid="ignore"):  # ∞ − ∞, or numbers whose squares are too large
        mean, spread = float(np.mean(values)), float(np.std(values))
    return mean if math.isfinite(mean) else None, spread if len(values) > 1 and math.isfinite(spread) else None
