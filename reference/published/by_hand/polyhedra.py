"""Signs that decide what lies inside, by hand."""

from __future__ import annotations

import numpy as np

from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.case import Published


def neighbouring_points(case: Published, code: Implementation) -> Answers:
    """P24: how often the plain test in doubles, which the case is about, differs from the exact sign."""
    i, j = np.meshgrid(*2 * [np.arange(int(case.value("count")))], indexing="ij")
    p = np.array(case.numbers("first")) + np.stack([i, j], axis=-1) * case.value("unit")
    q, r = np.array(case.numbers("q")), np.array(case.numbers("r"))
    u, v = q - p, r - p
    plain = np.sign(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])
    exact = code.function("orient2d")(p, q, r)
    return as_answers(points=float(plain.size), wrong_signs=float(np.sum(plain != exact)))
