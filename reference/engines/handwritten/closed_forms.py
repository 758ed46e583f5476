"""Decides which motions of balls that meet nothing have a closed form among the lecture's functions."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum

from reference.scene.forces import Force
from reference.scene.scenario import Scenario
from reference.scene.straight_spring import drive_of, ends_of


class Form(Enum):
    """The closed forms.

    THROW: forces are constant. DRAG: constant forces, and a fluid that slows each ball by Stokes' law. SPRING: constant
    forces, and one spring with a damper, along which alone its two ends move as seen from each other. If one end is
    fixed, a force that oscillates along the spring may drive it.
    """

    THROW = "throw"
    DRAG = "drag"
    SPRING = "spring"


def form_of(scenario: Scenario) -> Form | None:
    """The closed form of a scenario; None where the lecture has none for it."""
    if not scenario.in_flight or scenario.attractions:
        return None
    if not all(isinstance(push, Force) for push in scenario.forces) and drive_of(scenario) is None:
        return None
    slowed = bool(scenario.fluid and scenario.fluid.viscosity)
    if scenario.springs:
        return None if slowed or ends_of(scenario) is None else Form.SPRING
    if slowed:
        return None if any(any(body.angular_velocity) for body in scenario.bodies) else Form.DRAG
    return Form.THROW


def with_constant_forces(scenario: Scenario) -> Scenario:
    """The scenario with its constant forces alone."""
    return replace(scenario, springs=(), forces=tuple(push for push in scenario.forces if isinstance(push, Force)))
