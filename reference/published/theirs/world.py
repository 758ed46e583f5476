"""Published cases of several contacts at once: discs that are struck together, complementarity problems, a ladder."""

from __future__ import annotations

import math

from reference.published.case import Published

_SPREADS, _SQUARES = (1.0, 1.2, math.sqrt(2), 1.7), (1.0, 1.44, 2.0, 2.89)
"""How far the two discs of P37 are apart, in diameters, and the squares of that."""

CASES = (
    Published(
        number=37,
        title="A disc strikes two others at once",
        statement=22,
        kind="verification",
        source="I. E. Irodov, Problems in General Physics (1981), problem 1.176: u = −v (2 − η²)/(6 − η²)",
        setup={"radius": 0.05, "mass": 0.3, "speed": 1.0, "spread": _SPREADS},
        expected={"velocity": tuple((square - 2) / (6 - square) for square in _SQUARES)},
        tolerance={"velocity": 1e-12},
        reason="a closed form, and rounding",
        note="Three equal discs, elastic and without friction; the centres of the two at rest are η diameters apart."
        " The disc recoils for η < √2, stops at √2 and moves on above that. Radius, mass and speed were chosen by us.",
        units={"velocity": "m/s"},
        labels={"velocity": ("η = 1", "η = 1.2", "η = √2", "η = 1.7")},
    ),
    Published(
        number=38,
        title="Complementarity problems of a handbook",
        statement=22,
        kind="verification",
        source="C. A. Floudas et al., Handbook of Test Problems in Local and Global Optimization (1999), examples "
        "10.2.1, 10.2.3 and 10.2.9, as in Drake (RobotLocomotion/drake), "
        "solvers/test/unrevised_lemke_solver_test.cc, testProblem1, testProblem3 and testProblem6",
        setup={
            "triangular_order": 16.0,
            "cottle_matrix": (0.0, -1.0, 2.0, 2.0, 0.0, -2.0, -1.0, 1.0, 0.0),
            "cottle_offset": (-3.0, 6.0, -1.0),
            "market_matrix": (11.0, 0.0, 10.0, -1.0, 0.0, 11.0, 10.0, -1.0, 10.0, 10.0, 21.0, -1.0, 1.0, 1.0, 1.0, 0.0),
            "market_offset": (50.0, 50.0, -6.0),
            "market_cost": (1.0, 16.0, 100.0),
        },
        expected={
            "triangular": 15 * (0.0,) + (1.0,),
            "cottle": (0.0, 1.0, 3.0),
            "market_1": (17 / 13, 17 / 13, 44 / 13, 1277 / 13),
            "market_16": (32 / 13, 32 / 13, 14 / 13, 1142 / 13),
            "market_100": (3.0, 3.0, 0.0, 83.0),
        },
        tolerance=dict.fromkeys(("triangular", "cottle", "market_1", "market_16", "market_100"), 1e-6),
        reason="the tolerance of Drake's test",
        note="Find f ≥ 0 with A f + b ≥ 0 and f·(A f + b) = 0. In the first problem, A has 1 on its diagonal, 2 above"
        " and 0 below, and b is −1. In the third, b is (50, 50, l, −6). Drake notes that the handbook prints 1 for the"
        " last entry A₄₄, where 0 is right: with the 1, the printed solutions do not solve the problem.",
    ),
    Published(
        number=41,
        title="A ladder leans against a slippery wall",
        statement=22,
        kind="verification",
        source="OpenStax University Physics, volume 1, section 12.2, example 12.5 A Ladder Resting Against a Wall",
        setup={"length": 5.0, "weight": 400.0, "angle": 53.0, "tried_friction": (0.37, 0.38)},
        expected={
            "floor_normal": 400.0,
            "wall": 150.7,
            "friction": 150.7,
            "floor": 427.4,
            "direction": 69.3,
            "coefficient": 0.377,
            "holds": (0.0, 1.0),
        },
        tolerance={
            "floor_normal": 0.05,
            "wall": 0.05,
            "friction": 0.05,
            "floor": 0.068,
            "direction": 0.1,
            "coefficient": 5e-4,
            "holds": 0.0,
        },
        reason="half of the last digit printed; for the floor's force also what rounding the wall's force adds to it;"
        " for the direction the whole last digit, because it was cut off; whether the ladder holds is yes or no",
        note="The angle is that of the ladder with the floor; the direction is that of the floor's whole force. The"
        " wall has no friction. The coefficient is the smallest with which the ladder does not slip, cot β/2. The two"
        " coefficients that are tried were chosen by us. The direction is 69.35°, or 69.36° with the rounded forces;"
        " the book prints 69.3°.",
        units={"floor_normal": "N", "wall": "N", "friction": "N", "floor": "N", "direction": "°"},
        labels={"holds": ("μ = 0.37", "μ = 0.38")},
    ),
)
