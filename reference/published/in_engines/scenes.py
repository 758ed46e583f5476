"""What the published cases share in an engine: a ball above a floor, gravity, settings, an answer's tolerance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.catalogue.scenarios.response import falling_ball
from reference.engines.base import Engine
from reference.published import Answer, Figure, Published
from reference.scene.scenario import GRAVITY, Scenario
from reference.scene.settings import Settings

FINE = 1e-4
"""Timestep where the case gives none, s."""


def ball_over_floor(
    case: Published, drop: float, duration: float, restitution: float, radius: float = 0.1, mass: float = 1.0
) -> Scenario:
    """A ball let go above a floor; drop is the gap, m."""
    return as_heavy(case, falling_ball(case.name, restitution, drop, duration, radius, mass))


def as_heavy(case: Published, scenario: Scenario) -> Scenario:
    """The scenario with the case's gravity."""
    return replace(scenario, gravity=(0.0, 0.0, -gravity_of(case)))


def gravity_of(case: Published) -> float:
    """The case's gravity, m/s², that of all scenarios where its figures do not hang on it."""
    return case.value("gravity") if "gravity" in case.setup else GRAVITY


def tuned(engine: Engine, scenario: Scenario, timestep: float = FINE) -> Settings:
    """The engine's tuned settings with another timestep."""
    return engine.settings(scenario, "tuned").change(timestep=timestep)


def at_least(case: Published, figure: str, value: Figure, off: Figure, reason: str) -> Answer:
    """An answer that may be off by the case's own tolerance, and by `off` where that is more."""
    own = np.broadcast_to(case.tolerance[figure], np.shape(value))
    if np.all(np.asarray(off) <= own):
        return Answer(value)
    wider = np.maximum(own, off)
    return Answer(value, tuple(wider.tolist()) if isinstance(value, tuple) else float(wider), reason)
