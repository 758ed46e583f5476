"""Reciprocal avoidance by hand."""

from __future__ import annotations

from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.case import Published

ANY_STEP = 0.1
"""Timestep, s. It counts only where two discs overlap already, and these do not."""


def half_plane(case: Published, code: Implementation) -> Answers:
    """P23: the border of the permitted velocities, a point on it and its direction."""
    point, normal = code.function("orca_half_plane")(**case.setup, dt=ANY_STEP)
    return as_answers(point=tuple(point.tolist()), direction=(float(normal[1]), -float(normal[0])))
