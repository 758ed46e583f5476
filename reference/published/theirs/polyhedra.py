"""Published cases of signs that decide what lies inside."""

from __future__ import annotations

import math

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
    Published(
        number=34,
        title="How often the regular star polyhedra wind round their centre",
        statement=9,
        kind="verification",
        source="H. S. M. Coxeter, Regular Polytopes (1948), section 6.4 and table I: densities of the Kepler-Poinsot "
        "polyhedra {5, 5/2}, {5/2, 5}, {3, 5/2} and {5/2, 3}, after A. Cayley (1859)",
        setup={"golden_ratio": (1 + math.sqrt(5)) / 2, "point": (0.013, 0.02, 0.007)},
        expected={
            "great_dodecahedron": 3.0,
            "small_stellated_dodecahedron": 3.0,
            "great_icosahedron": 7.0,
            "great_stellated_dodecahedron": 7.0,
        },
        tolerance=dict.fromkeys(
            (
                "great_dodecahedron",
                "small_stellated_dodecahedron",
                "great_icosahedron",
                "great_stellated_dodecahedron",
            ),
            1e-12,
        ),
        reason="whole numbers, from a sum of angles",
        note="The faces of these polyhedra pass through each other. At the centre every density is odd, so that parity"
        " also finds the centre inside. In a tip of a star the number is smaller. The point that is tried lies"
        " slightly beside the centre, so that no ray meets an edge.",
    ),
)
