"""Published cases of impulses: what a floor gives to a ball, and two balls to each other."""

from __future__ import annotations

from reference.published.case import Published

CASES = (
    Published(
        number=21,
        title="Impulse and mean force of a ball's bounce",
        statement=13,
        kind="verification",
        source="Textbook problem: a ball of 50 g dropped from 1.5 m rebounds to 1.0 m; contact of 15 ms, g = 9.8 m/s²",
        setup={"mass": 0.05, "height": 1.5, "rebound": 1.0, "contact_time": 0.015, "gravity": 9.8},
        expected={
            "impulse": 0.4925,
            "net_force": 32.83,
            "contact_force": 33.32,
            "energy_change": -0.245,
            "restitution": 0.8165,
        },
        tolerance={
            "impulse": 5e-5,
            "net_force": 5e-3,
            "contact_force": 5e-3,
            "energy_change": 5e-4,
            "restitution": 5e-5,
        },
        reason="half of the last digit printed",
        note="The impulse is the change of momentum, so that J/Δt is the mean net force; the floor's own force is "
        "larger by the weight, 0.49 N.",
        units={"impulse": "N s", "net_force": "N", "contact_force": "N", "energy_change": "J"},
    ),
    Published(
        number=22,
        title="Change of momentum in an elastic bounce",
        statement=20,
        kind="verification",
        source="OpenStax University Physics, volume 1, section 9.3",
        setup={"mass": 0.25, "height": 1.5, "gravity": 9.81},
        expected={"impulse": 2.71},
        tolerance={"impulse": 5e-3},
        reason="half of the last digit printed",
        note="The value of g is not printed: 9.8 and 9.81 m/s² both give 2.71.",
        units={"impulse": "kg m/s"},
    ),
    Published(
        number=27,
        title="Two balls that meet head-on part with the restitution that was set",
        statement=20,
        kind="verification",
        source="Project Chrono, tests of smooth contact: coefficient of restitution",
        setup={
            "radius": 0.5,
            "speed": 1.0,
            "mass": 1.0,
            "young_modulus": 2e5,
            "poisson_ratio": 0.3,
            "restitution": (0.0, 0.25, 0.5, 0.75, 1.0),
            "timestep": 3e-5,
        },
        expected={"restitution": (0.0, 0.25, 0.5, 0.75, 1.0)},
        tolerance={"restitution": 1e-3},
        reason="the tolerance of the test itself",
        note="Chrono's contact yields, and its damping is chosen to give this restitution; an impulse gives it "
        "exactly. The mass is ours: the result depends on it in neither method.",
        labels={"restitution": ("e = 0", "e = 0.25", "e = 0.5", "e = 0.75", "e = 1")},
    ),
)
