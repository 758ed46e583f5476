"""What the drivers in the engines share: a ball above a floor, the case's gravity, settings with another timestep."""

from __future__ import annotations

from dataclasses import replace

from reference.catalogue.scenarios.bouncing_ball import falling_ball
from reference.engines.base import Engine
from reference.published.case import Published
from reference.scene.scenario import GRAVITY, Scenario
from reference.scene.settings import Settings

FINE = 1e-4
"""Timestep where the case gives none, s."""
AFTER_APEX = 0.05
"""How long a ball is watched beyond its first apex, s, so that samples lie on both sides of it."""


def ball_over_floor(
    case: Published, drop: float, duration: float, restitution: float, radius: float = 0.1, mass: float = 1.0
) -> Scenario:
    """A ball let go above a floor, with the case's gravity; drop is the gap, m."""
    return with_gravity_of(case, falling_ball(case.name, restitution, drop, duration, radius, mass))


def with_gravity_of(case: Published, scenario: Scenario) -> Scenario:
    """The scenario with the case's gravity."""
    return replace(scenario, gravity=(0.0, 0.0, -gravity_of(case)))


def gravity_of(case: Published) -> float:
    """The case's gravity, m/s²; that of all scenarios where the case gives none because its figures need none."""
    return case.value("gravity") if "gravity" in case.setup else GRAVITY


def tuned(engine: Engine, scenario: Scenario, timestep: float = FINE) -> Settings:
    """The engine's tuned settings with another timestep."""
    return engine.settings(scenario, "tuned").change(timestep=timestep)
