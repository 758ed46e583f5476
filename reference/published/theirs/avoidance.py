"""Published cases of reciprocal avoidance."""

from __future__ import annotations

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
)
