"""Published cases of a collision that is detected: when a point meets a plane, and how deep a box is below one."""

from __future__ import annotations

import math

from reference.published.case import Published

_UPRIGHT, _UPSIDE_DOWN = (1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0)
_ON_ITS_SIDE = (math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0)
"""No turn, half a turn and a quarter turn about x, as quaternions wxyz: the three orientations of P29."""

CASES = (
    Published(
        number=28,
        title="A rock thrown out of a volcano strikes 20 m below",
        statement=5,
        kind="verification",
        source="OpenStax College Physics (Urone, Hinrichs), section 3.4 Projectile Motion, example Hot Rock Projectile "
        "(Kilauea)",
        setup={"speed": 25.0, "angle": 35.0, "below": 20.0, "gravity": 9.8},
        expected={"time": 3.96, "along": 20.5, "upwards": -24.5, "speed": 31.9, "angle": -50.1},
        tolerance={"time": 5e-3, "along": 0.05, "upwards": 0.149, "speed": 0.05, "angle": 0.22},
        reason="half of the last digit printed. The book computes with rounded numbers, 14.3 m/s and 3.96 s. They"
        " change the vertical velocity by up to 0.05 + 9.8 × 0.005 m/s more, and so the angle by up to 0.17°",
        note="With all digits the vertical velocity is −24.4 m/s and the angle −50.0°: the last digits printed, "
        "−24.5 m/s and −50.1°, are those of the rounded time.",
        units={"time": "s", "along": "m/s", "upwards": "m/s", "speed": "m/s", "angle": "°"},
    ),
    Published(
        number=29,
        title="How deep a box is below a plane, upright, upside down and on its side",
        statement=4,
        kind="cross-engine",
        source="FCL (flexible-collision-library/fcl), test/test_fcl_box_half_space.cpp, test_collision_box_half_space",
        setup={
            "size": (0.1, 0.1, 0.2),
            "height": (0.049, 0.049, 0.051),
            "orientation": (*_UPRIGHT, *_UPSIDE_DOWN, *_ON_ITS_SIDE),
        },
        expected={"distance": (-0.051, -0.051, 0.001)},
        tolerance={"distance": 20 * 2.0**-52},
        reason="the tolerance of the test itself, 20 roundings of a number near 1",
        note="The solid is below z = 0; the height is that of the centre. The distance is that of the lowest corner, "
        "negative where it is below the plane. FCL returns the first two as depths of a contact.",
        units={"distance": "m"},
        labels={"distance": ("upright", "upside down", "on its side")},
    ),
)
