"""One case in one engine: it is run, its quantities are measured, and each number becomes a row with a verdict."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Expectation, Family, Quantity
from reference.comparison.verdicts import AS_IT_MUST, NOTHING_FINITE, Row, Verdict, judge, verdict_of
from reference.engines.base import EXACT, Engine, Method
from reference.errors import (
    CannotExpress,
    EngineNotInstalled,
    NeedsFunction,
    RunFailed,
    RunLost,
    Undecided,
    Unforeseen,
    as_failed_run,
)
from reference.prediction.predicted import Prediction
from reference.scene.settings import Settings
from reference.scene.step_limit import step_limit
from reference.scene.trajectory import Trajectory, held

_OUT_OF_RANGE = functools.partial(np.errstate, over="ignore", invalid="ignore")
"""A run that explodes leaves the range of numbers; its trajectory is refused for that, and needs no warning."""


def compare_case(
    family: Family,
    case: Case,
    engine: Engine,
    profile: str,
    settings: Settings,
    ran: Sequence[Trajectory] | None = None,
) -> tuple[list[Row], list[Trajectory]]:
    """Run one case in one engine; return its rows, and the trajectories for plots and replays.

    ran: its trajectories, if it has been run together with other cases. Every error that an engine or hand-written code
    raises becomes a row, except `InvalidInput`: that is the caller's mistake.
    """
    try:
        with as_failed_run(), _OUT_OF_RANGE():
            trajectories = list(ran) if ran else engine.run_many(case.scenarios, settings)
            for trajectory in trajectories:
                trajectory.check_whole()
            method = engine.method(case.scenarios[0], settings)
        numbers = {quantity.name: measured(quantity, trajectories, engine) for quantity in family.quantities}
    except (NeedsFunction, CannotExpress, EngineNotInstalled, RunFailed) as error:
        blank = Row(family.name, case.name, engine.name, profile, "", "", verdict_of(error))
        note = str(error) + (_too_long(case, settings) if isinstance(error, RunFailed) else "")
        return [replace(blank, note=note, settings=settings.describe())], []
    rows = judged(family, case, engine.name, profile, settings, method, numbers, with_evidence=True)
    if method.kind != EXACT and (too_long := _too_long(case, settings)):  # it may also end with numbers of any size
        rows = [
            replace(row, note=f"{row.note}{too_long}".removeprefix("; ")) if row.verdict is Verdict.FAIL else row
            for row in rows
        ]
    return rows, trajectories


def _too_long(case: Case, settings: Settings) -> str:
    """What to add to a failed run if its timestep is too long for the forces of a scenario; empty if it is not."""
    limit = min(step_limit(scenario) for scenario in case.scenarios)
    if settings.timestep <= limit:
        return ""
    return (
        f"; its springs, dampers or drag need a timestep below {limit:.3g} s, and here it is {settings.timestep:.3g} s"
    )


@dataclass(frozen=True)
class Number:
    """What was measured of one quantity: one value for each scenario of a case, or a note why there is none.

    undecided: whether rounding decides what the number is, so that a prediction has none. rounded: share by which the
    values may be off because a recording keeps fewer digits.
    """

    values: tuple[float, ...] = ()
    note: str = ""
    crashed: bool = False
    undecided: bool = False
    rounded: float = 0.0

    @property
    def mean(self) -> float | None:
        """Mean over an ensemble; None where it is not finite."""
        return _finite(np.mean, self.values) if self.values else None

    @property
    def spread(self) -> float | None:
        """Standard deviation over an ensemble; None for a single value, or where it is not finite."""
        return _finite(np.std, self.values) if len(self.values) > 1 else None


def measured(quantity: Quantity, trajectories: Sequence[Trajectory], engine: Engine | None = None) -> Number:
    """Measure a quantity of each trajectory. engine: which answers the quantity's questions, if it has any.

    Raises
    ------
    CannotExpress, NeedsFunction
        If the engine cannot answer them, or lacks a function for it.
    """
    try:
        with as_failed_run():
            values = tuple(_value(quantity, trajectory, engine) for trajectory in trajectories)
    except Unforeseen as error:
        return Number(note=str(error), crashed=True)
    except Undecided as error:
        return Number(note=str(error), undecided=True)
    except RunLost:
        raise
    except RunFailed as error:  # the run has no such number: a body that still moves has no stopping distance
        return Number(note=str(error))
    return Number(values) if _finite(np.mean, values) is not None else Number(note=NOTHING_FINITE)


def _value(quantity: Quantity, trajectory: Trajectory, engine: Engine | None) -> float:
    if engine is not None and quantity.asked is not None:
        return float(quantity.asked(trajectory, engine.query))
    return float(quantity.measure(trajectory))


def judged(
    family: Family,
    case: Case,
    engine: str,
    profile: str,
    settings: Settings,
    method: Method,
    numbers: Mapping[str, Number],
    with_evidence: bool = False,
) -> list[Row]:
    """A row for each quantity: its number, what theory and the method's recurrence say of it, and the verdict.

    with_evidence: whether each row also says if bodies that never leave their start would pass.
    """
    blank = Row(family.name, case.name, engine, profile, "", "", Verdict.SHOWN, settings=settings.describe())
    predictions = predicted(family, case, settings, method)
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
        size = expectation.size if expectation and expectation.size else 1.0
        slack = quantity.slack(case, settings, method) if quantity.slack else 0.0
        against = _Against.of(quantity, predictions, size, slack)
        if against is not None:
            row = replace(row, shift=0.0)  # the recurrence says it better
        found = _with_number(row, numbers[quantity.name], expectation, against)
        if with_evidence and found.verdict in AS_IT_MUST:
            idle = (_with_number(row, number, expectation, against) for number in _held(quantity, case, settings))
            found = replace(found, evidence=not any(each.verdict in AS_IT_MUST for each in idle))
        rows.append(found)
    return rows


def _held(quantity: Quantity, case: Case, settings: Settings) -> Iterator[Number]:
    """What is measured of runs in which nothing moves: whether the velocities stay what they were, or are zero."""
    for speed in (1.0, 0.0):
        with np.errstate(all="ignore"):  # a share of a way that is zero
            yield measured(quantity, [held(scenario, settings, speed) for scenario in case.scenarios])


def predicted(family: Family, case: Case, settings: Settings, method: Method) -> list[Prediction | None]:
    """What the method's recurrence gives in each scenario of a case; empty where it has none for half of them.

    Of an ensemble, a few may meet at a tie, which rounding decides: they have none. One that leaves the range of
    numbers predicts nothing, and costs no other case its rows.
    """
    if family.predict is None:
        return []
    try:
        with _OUT_OF_RANGE():
            found = [family.predict(scenario, settings, method) for scenario in case.scenarios]
    except RunLost:
        raise
    except RunFailed:
        return []
    return found if 2 * sum(each is None for each in found) < len(found) else []


@dataclass(frozen=True)
class _Against:
    """What is predicted of one quantity, and how near each number has to be: its band.

    chosen: the scenarios that have a prediction.
    """

    chosen: tuple[int, ...]
    number: Number
    bands: tuple[float, ...]

    @classmethod
    def of(
        cls, quantity: Quantity, predictions: Sequence[Prediction | None], size: float, slack: float
    ) -> _Against | None:
        """None where no recurrence predicts the number, and where rounding decides what it is.

        size: as in `Expectation`. slack: as `Quantity.slack` says.
        """
        if not predictions or quantity.cost or quantity.reported:
            return None
        chosen = tuple(place for place, each in enumerate(predictions) if each is not None)
        made = [each for each in predictions if each is not None]
        number = measured(quantity, [each.trajectory for each in made])
        if number.undecided:
            return None
        bands = (each.band(value, size) for each, value in zip(made, number.values, strict=False))
        return cls(chosen, number, tuple(band + slack for band in bands))

    def differences(self, number: Number) -> Array:
        """Measured less predicted, for each scenario that has a prediction."""
        return np.subtract([number.values[each] for each in self.chosen], self.number.values)

    def bands_for(self, number: Number) -> Array:
        """How near each value of a number has to be, wider where a recording has rounded it."""
        return np.add(self.bands, [number.rounded * abs(number.values[each]) for each in self.chosen])

    def hold(self, number: Number) -> bool:
        """Whether every number is as predicted."""
        return bool(np.all(np.abs(self.differences(number)) <= self.bands_for(number)))


def _with_number(row: Row, number: Number, expectation: Expectation | None, against: _Against | None) -> Row:
    if number.crashed:
        return replace(row, verdict=Verdict.CRASHED, note=number.note)
    if number.mean is None:
        as_it_must = against is not None and against.number.mean is None
        missing = Verdict.DISAGREES if as_it_must else Verdict.FAIL
        return replace(row, verdict=missing if expectation else Verdict.SHOWN, note=number.note)
    row = replace(row, measured=number.mean, spread=number.spread, values=number.values)
    holds = None
    if against is not None:
        row, holds = _with_prediction(row, number, against)
    if expectation is None:
        return row if holds is None else replace(row, verdict=Verdict.PASS if holds else Verdict.FAIL)
    verdict = judge(number.mean, expectation, holds)
    deviates = verdict in (Verdict.KNOWN_DEVIATION, Verdict.DISAGREES)
    return replace(row, verdict=verdict, note=expectation.shift_reason if deviates else row.note)


def _with_prediction(row: Row, number: Number, against: _Against) -> tuple[Row, bool]:
    """The row with what is predicted, and whether the number is so; it is not where there is no such number."""
    if against.number.mean is None:
        return replace(row, note=f"predicted: {against.number.note}"), False
    off = against.differences(number)
    worst = int(np.argmax(np.abs(off)))
    whole = np.array(number.values)  # a scenario without a prediction counts as it was measured
    whole[list(against.chosen)] = against.number.values
    row = replace(
        row, predicted=float(np.mean(whole)), band=float(max(against.bands_for(number))), off=float(off[worst])
    )
    if holds := against.hold(number):
        return row, holds
    foreseen = against.number.values[worst]
    return replace(row, note=f"predicted {foreseen:.9g}, measured {number.values[against.chosen[worst]]:.9g}"), holds


def _finite(summary: Callable[..., Any], values: Sequence[float]) -> float | None:
    with np.errstate(over="ignore", invalid="ignore"):  # ∞ − ∞, or numbers whose squares are too large
        found = float(summary(values))
    return found if math.isfinite(found) else None
