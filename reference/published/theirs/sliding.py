"""Published cases of boxes that slide or hold: on the flat, on a ramp, and under a load of balls."""

from __future__ import annotations

import math

from reference.published.case import Published

_FRICTIONS, _SLOPES = (0.1, 0.3, 0.5, 0.7, 1.0), (3.0, 10.0, 20.0, 30.0, 40.0)
"""The coefficients and the slopes, in degrees, of P10: every pair of them is one number of the case."""

CASES = (
    Published(
        number=2,
        title="A plate is pushed from under twenty-five balls",
        statement=24,
        kind="verification",
        source="SimBenchmark (leggedrobotics), test rolling: its closed form, and the score of a friction pyramid",
        setup={
            "box_mass": 10.0,
            "box_size": (20.0, 20.0, 1.0),
            "push": 150.0,
            "push_angle": 60.0,
            "balls": 25.0,
            "ball_mass": 1.0,
            "ball_radius": 0.5,
            "ground_friction": 0.4,
            "ball_friction": 0.8,
            "gravity": 9.81,
            "duration": 4.0,
            "timestep": 1e-3,
        },
        expected={
            "box_acceleration": 0.7385,
            "ball_acceleration": 0.2110,
            "box_speed": 2.954,
            "ball_speed": 0.844,
            "square_cone_error": 3.14497,
        },
        tolerance={
            "box_acceleration": 5e-5,
            "ball_acceleration": 5e-5,
            "box_speed": 5e-4,
            "ball_speed": 5e-4,
            "square_cone_error": 5e-6,
        },
        reason="half of the last digit printed",
        note="The balls roll: 2/7 of the plate's acceleration. A friction cone that is a square along the axes holds "
        "the plate, 129.9 N against 137.3 N along y, although 150 N are more than that; its error, the mean of both "
        "squared errors of speed before each of 4000 steps, is that of an engine which does nothing.",
        units={
            "box_acceleration": "m/s²",
            "ball_acceleration": "m/s²",
            "box_speed": "m/s",
            "ball_speed": "m/s",
            "square_cone_error": "m²/s²",
        },
    ),
    Published(
        number=7,
        title="A sliding box stops",
        statement=24,
        kind="verification",
        source="Newton (physics engine), verification and validation of friction",
        setup={"half_edge": 0.25, "speed": 2.0, "friction": (0.2, 0.4, 0.7), "gravity": 9.81, "timestep": 1 / 1800},
        expected={"distance": (1.01937, 0.50968, 0.29125)},
        tolerance={"distance": (0.0101937, 0.0050968, 0.0029125)},
        reason="their own 1 %; ours is exact",
        note="v²/(2μg). A method that responds at the step stops v dt/2 = 0.56 mm short.",
        units={"distance": "m"},
        labels={"distance": ("μ = 0.2", "μ = 0.4", "μ = 0.7")},
    ),
    Published(
        number=8,
        title="A fast sliding cube stops",
        statement=24,
        kind="verification",
        source="Project Chrono, tests of smooth contact: sliding friction",
        setup={"edge": 0.5, "speed": 5.0, "friction": 0.5, "gravity": 9.81},
        expected={"distance": 2.54842},
        tolerance={"distance": 0.0127421},
        reason="their own 0.5 %; ours is exact",
        note="v²/(2μg) for a body that does not tip; a cube does not while μ is below 1.",
        units={"distance": "m"},
    ),
    Published(
        number=10,
        title="A box on a ramp holds or slides",
        statement=24,
        kind="verification",
        source="Newton (physics engine), verification and validation of static friction",
        setup={"friction": _FRICTIONS, "slope": _SLOPES, "gravity": 9.81, "dead_band": 2.0},
        expected={"rests": tuple(float(angle < math.degrees(math.atan(mu))) for mu in _FRICTIONS for angle in _SLOPES)},
        tolerance={"rests": 0.0},
        reason="yes or no: it rests if and only if θ < atan μ; no slope lies in their dead band of 2° about that",
        note="1 for a box that rests, 0 for one that slides.",
        labels={"rests": tuple(f"μ = {mu:g}, {angle:g}°" for mu in _FRICTIONS for angle in _SLOPES)},
    ),
)
