"""What the published cases share in an engine: a ball above a floor, tuned settings, and an answer's tolerance."""

from __future__ import annotations

import numpy as np

from reference.engines.base import Engine
from reference.published import Answer, Figure, Published
from reference.scenario import Body, HalfSpace, Pair, Scenario, Sphere
from reference.settings import Settings

FINE = 1e-4
"""Timestep where the case gives none, s."""


def ball_over_floor(
    case: Published, drop: float, duration: float, restitution: float, radius: float = 0.1, mass: float = 1.0
) -> Scenario:
    """A ball let go above a floor; drop is the gap, m. Gravity is the case's, or that of all scenarios."""
    ball = Body("ball", Sphere(radius), mass, (0.0, 0.0, radius + drop))
    pair = Pair("ball", "floor", restitution)
    return Scenario(case.name, (Body("floor", HalfSpace()), ball), (pair,), duration, (0.0, 0.0, -gravity_of(case)))


def gravity_of(case: Published) -> float:
    """The case's gravity, m/s², 9.81 where its figures do not hang on it."""
    return case.value("gravity") if "gravity" in case.setup else 9.81


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
