"""Signs that decide what is inside, by others."""

from __future__ import annotations

import numpy as np

from reference.engines.implementation import Implementation
from reference.published import Answers, Published, said


def neighbouring_points(case: Published, code: Implementation) -> Answers:
    """P24: how often the plain test in doubles, which is on trial, and the exact sign differ."""
    i, j = np.meshgrid(*2 * [np.arange(int(case.value("count")))], indexing="ij")
    p = np.array(case.values("first")) + np.stack([i, j], axis=-1) * case.value("unit")
    q, r = np.array(case.values("q")), np.array(case.values("r"))
    u, v = q - p, r - p
    plain = np.sign(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])
    exact = code.function("orient2d")(p, q, r)
    return said(points=float(plain.size), wrong_signs=float(np.sum(plain != exact)))


CASES = (
    Published(
        number=24,
        title="Which side of a line, for 256 × 256 neighbouring points close to it",
        statement=9,
        kind="verification",
        source="L. Kettner, K. Mehlhorn, S. Pion, S. Schirra, C. Yap, Classroom Examples of Robustness Problems in "
        "Geometric Computations, Computational Geometry 40 (2008) 61-78, section 3",
        setup={"first": (0.5, 0.5), "unit": 2.0**-53, "count": 256.0, "q": (12.0, 12.0), "r": (24.0, 24.0)},
        expected={"points": 65536.0, "wrong_signs": 11972.0},
        tolerance={"points": 0.0, "wrong_signs": 0.0},
        reason="a count; every operation of a double is prescribed by IEEE 754",
        note="The points are p = first + (i, j) unit, neighbouring doubles, and the plain test is the sign of "
        "(q - p)×(r - p) in doubles. In exact arithmetic it is the sign of j - i. Written with q or r in place of p as "
        "the corner that is subtracted, the same test has another count of wrong signs.",
        by_hand=neighbouring_points,
        why_not={"engines": "no engine says on which side of a line a point lies"},
    ),
)
