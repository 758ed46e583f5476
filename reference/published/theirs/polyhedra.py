"""Published cases of signs that decide what lies inside."""

from __future__ import annotations

from reference.published.case import Published

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
    ),
)
