"""Tolerances that several families share, each with its reason."""

from __future__ import annotations

import math

from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Expectation
from reference.engines.base import Method
from reference.scene.settings import Settings

MILLIMETRE = 1e-3
DEGREE = math.radians(1)


def within_a_millimetre(case: Case, settings: Settings, method: Method) -> Expectation:
    """Expect a length of zero, as nearly as one can see."""
    return Expectation(0.0, MILLIMETRE, "1 mm: nobody sees it in a scene of metres")


def at_rest(case: Case, settings: Settings, method: Method) -> Expectation:
    """Expect a speed of zero, as nearly as what counts as rest."""
    return Expectation(0.0, measure.REST_SPEED, "1 mm/s: what counts as rest")
