"""The error of one quantity in one engine for any settings; each settings are run once, and the errors remembered."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Family, Quantity
from reference.engines.base import Engine
from reference.errors import CollisionsError, as_failed_run
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory


@dataclass(frozen=True)
class Question:
    """The quantity that a family studies, in one engine. It is run once with each settings, and the errors are kept.

    every_step: as in `Convergence`.
    """

    engine: Engine
    case: Case
    quantity: Quantity
    every_step: bool
    _kept: dict[Settings, Array | None] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def of(cls, family: Family, engine: Engine) -> Question:
        """The question of a family's convergence study."""
        study = family.convergence
        return cls(engine, family.case(study.case), family.quantity(study.quantity), study.every_step)

    def mean_error(self, settings: Settings) -> float | None:
        """Mean error over the case's scenarios; None where there is no such number."""
        return self._finite(settings, np.mean)

    def rms_error(self, settings: Settings) -> float | None:
        """Root mean square error over the case's scenarios; None where there is no such number."""
        return self._finite(settings, lambda errors: np.sqrt(np.mean(errors**2)))

    def remember(self, settings: Settings, trajectories: Sequence[Trajectory]) -> None:
        """Take the errors from trajectories of the case that have been run with these settings already."""
        if trajectories and settings == self._sampled(settings):
            self._kept[settings] = self._measured(trajectories)

    def _finite(self, settings: Settings, summary: Callable[[Array], Any]) -> float | None:
        errors = self._errors(self._sampled(settings))
        if errors is None:
            return None
        with np.errstate(over="ignore", invalid="ignore"):  # numbers whose squares are too large
            error = float(summary(errors))
        return error if math.isfinite(error) else None

    def _errors(self, settings: Settings) -> Array | None:
        if settings not in self._kept:
            try:
                with as_failed_run():
                    trajectories = self.engine.run_many(self.case.scenarios, settings)
            except CollisionsError:
                trajectories = []
            self._kept[settings] = self._measured(trajectories) if trajectories else None
        return self._kept[settings]

    def _measured(self, trajectories: Sequence[Trajectory]) -> Array | None:
        try:
            with as_failed_run():
                measured = np.array([self.quantity.measure(trajectory) for trajectory in trajectories])
                return np.asarray(measured - self.quantity.expected_value(self.case))
        except CollisionsError:
            return None

    def _sampled(self, settings: Settings) -> Settings:
        return replace(settings, sample_every=1) if self.every_step else settings
