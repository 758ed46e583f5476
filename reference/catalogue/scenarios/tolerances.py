"""Tolerances that several families share, each with its reason."""

from __future__ import annotations

import math

from reference import truth
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Expectation
from reference.engines.base import EXACT, Method
from reference.scene.settings import Settings

MILLIMETRE = 1e-3
ROUNDING = 1e-9
"""What rounding leaves at most of a run that solves for every instant, as a share or in m."""
DEGREE = math.radians(1)


def within_a_millimetre(case: Case, settings: Settings, method: Method) -> Expectation:
    """Expect a length of zero, as nearly as one can see; to rounding of a method that solves for every instant."""
    if method.kind == EXACT:
        return Expectation(0.0, ROUNDING, "rounding only")
    return Expectation(0.0, MILLIMETRE, "1 mm: nobody sees it in a scene of metres")


def at_rest(case: Case, settings: Settings, method: Method) -> Expectation:
    """Expect a speed of zero, as nearly as what counts as rest."""
    return Expectation(0.0, measure.REST_SPEED, "1 mm/s: what counts as rest")


def from_rest(acceleration: float, duration: float, settings: Settings, share: float, reason: str) -> Expectation:
    """Expect the way of a body that sets out from rest with a constant acceleration, m/s², in a step method."""
    exact = acceleration * duration**2 / 2
    shift = truth.semi_implicit_sliding_shift(acceleration, settings.timestep, duration)
    why = "+a t dt/2: a step moves with the velocity that it has just gained"
    return Expectation(exact, share * exact, reason, shift, why, acceleration * settings.timestep**2)
