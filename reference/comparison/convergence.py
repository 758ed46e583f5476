"""Error against timestep: the errors of one quantity at several timesteps, and the order of convergence they show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reference.comparison.errors_by_settings import Question
from reference.scene.settings import Settings

ROUNDING = 1e-9
"""Errors below this share of the value are rounding, and no order can be read from them."""


@dataclass(frozen=True)
class Errors:
    """Error against timestep, s. order: slope of the log–log line, None where every error is rounding."""

    timesteps: tuple[float, ...]
    errors: tuple[float, ...]
    order: float | None


def errors_against_timestep(asked: Question, settings: Settings, factors: Sequence[float]) -> Errors | None:
    """Root mean square error at multiples of the settings' timestep; None where no run gave a number."""
    found = [settings.change(timestep=settings.timestep * factor) for factor in factors]
    errors = {each.timestep: asked.rms_error(each) for each in found}
    known = {timestep: error for timestep, error in errors.items() if error is not None}
    if not known:
        return None
    value = asked.quantity.expected_value(asked.case)
    return Errors(tuple(known), tuple(known.values()), order_of(list(known), list(known.values()), value))


def order_of(timesteps: Sequence[float], errors: Sequence[float], value: float) -> float | None:
    """Slope of log error against log timestep, over the errors larger than rounding; None with fewer than two."""
    pairs = [(dt, error) for dt, error in zip(timesteps, errors, strict=True) if error > ROUNDING * abs(value)]
    if len(pairs) < 2:
        return None
    steps, sizes = np.log(np.array(pairs)).T
    return float(np.polyfit(steps, sizes, 1)[0])
