"""Published cases of reciprocal avoidance."""

from __future__ import annotations

import math

from reference.published.case import Published

CASES = (
    Published(
        number=23,
        title="The ORCA line of one disc that meets another a little off head-on",
        statement=1,
        kind="cross-engine",
        source="RVO2 (van den Berg, Guy, Snape, Lin, Manocha; gamma.cs.unc.edu/RVO2), its algorithm; navground 0.7, "
        "which runs it, gives the same line",
        setup={
            "position_a": (0.0, 0.0),
            "velocity_a": (1.0, 0.0),
            "radius_a": 0.5,
            "position_b": (5.0, 0.2),
            "velocity_b": (-1.0, 0.0),
            "radius_b": 0.5,
            "horizon": 5.0,
        },
        expected={"point": (0.97423, -0.15844), "direction": (-0.98703, 0.16052)},
        tolerance={"point": 5e-6, "direction": 5e-6},
        reason="five decimals were printed",
        note="The line's left side is permitted: its normal is the direction turned by a quarter to the left.",
        units={"point": "m/s"},
        labels=dict.fromkeys(("point", "direction"), ("x", "y")),
    ),
    Published(
        number=32,
        title="ORCA lines of a port of RVO2, also where no collision threatens",
        statement=1,
        kind="cross-engine",
        source="dodgy_2d (andriyDev/dodgy), crates/dodgy_2d/src/lib_test.rs, get_line_for_neighbour_tests",
        setup={
            "velocity": (0.0, 0.0, 1.0, 3.0, 10.0, -1.0, 0.0, 0.0, 0.0, 0.0),
            "neighbour": (1.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0),
            "radius": (1.0, 1.0, 1.0, 2.0, 1.0),
            "horizon": (1.0, 1.0, 1.0, 1.0, 2.0),
            "timestep": (1.0, 1.0, 1.0, 0.5, 0.5),
        },
        expected={
            "point": (
                *(share * (1 - 2 / math.sqrt(5)) for share in (1, 2)),
                *(0.5, 3.0),
                *(10.0, 0.0),
                *2 * (2 - 4 / math.sqrt(2),),
                *2 * (1 - 1 / math.sqrt(2),),
            ),
            "direction": (
                *(-2 / math.sqrt(5), 1 / math.sqrt(5)),
                *(0.0, 1.0),
                *(-1.0, 0.0),
                *2 * (-math.sqrt(0.5), math.sqrt(0.5)),
            ),
        },
        tolerance={"point": 3.2e-3, "direction": 3.2e-3},
        reason="the tests accept a squared distance of 1e-5",
        note="A disc at the origin meets a neighbour of the same radius at rest. Where the present velocity leads to a"
        " collision, dodgy puts the line halfway to the border of the collisions, as RVO2 does. Where it does not,"
        " dodgy puts the line at that border and so permits every velocity that is free. RVO2 and the paper (van den"
        " Berg, Guy, Lin, Manocha, Reciprocal n-body collision avoidance, 2011, section 4) put it halfway there too."
        " Both rules avoid the collision.",
        units={"point": "m/s"},
        labels=dict.fromkeys(
            ("point", "direction"),
            tuple(
                f"{where}, {axis}"
                for where in ("at rest", "beside", "past", "overlapping", "at rest, 2 s")
                for axis in "xy"
            ),
        ),
    ),
    Published(
        number=33,
        title="The permitted velocity nearest to the preferred one, and the least bad where no velocity is permitted",
        statement=1,
        kind="cross-engine",
        source="dodgy_2d (andriyDev/dodgy), crates/dodgy_2d/src/linear_programming_test.rs, "
        "solve_linear_program_tests: satisfies_constraints and "
        "infeasible_program_minimally_penetrates_constraints",
        setup={
            "max_speed": 1.0,
            "points": (0.5, 0.0, -0.5, -0.25),
            "directions": (0.0, 1.0, 1.0, 0.0),
            "preferred": (-0.1, 0.3, -2.0, 2.0, 2.0, 0.5, 0.0, -0.5, 1.0, -0.5),
            "blocked_max_speed": 2.0,
            "blocked_points": (-100.0, 0.0, 0.0, 0.0, 0.0, -1.0),
            "blocked_directions": (1.0, 0.0, 0.0, -1.0, -math.sqrt(0.5), math.sqrt(0.5)),
            "blocked_preferred": (1.0, 1.0),
        },
        expected={
            "velocity": (-0.1, 0.3, -math.sqrt(0.5), math.sqrt(0.5), 0.5, 0.5, 0.0, -0.25, 0.5, -0.25),
            "least_bad": 2 * (-1 / (2 + math.sqrt(2)),),
        },
        tolerance={"velocity": 1.2e-7, "least_bad": 3.2e-3},
        reason="numbers in single precision that are equal to the last digit; where nothing is permitted, the test "
        "accepts a squared distance of 1e-5",
        note="A velocity on the left side of each line is permitted. The least bad velocity is equally far beyond all"
        " three lines.",
        units={"velocity": "m/s", "least_bad": "m/s"},
        labels={
            "velocity": tuple(
                f"{which}, {axis}"
                for which in ("free", "too fast", "first line", "second line", "both lines")
                for axis in "xy"
            ),
            "least_bad": ("x", "y"),
        },
    ),
)
