"""What an impact of two rigid bodies does to them, with the implementation's functions, batch first."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.impact_truth import DISSIPATIVE, NEWTON, POISSON, STRONGE
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings

IMPULSE_BY = {
    NEWTON: "friction_impulse",
    DISSIPATIVE: "dissipative_impulse",
    POISSON: "poisson_impulse",
    STRONGE: "stronge_impulse",
}
"""The function that gives the impulse of an impact with friction, by its law."""
NEEDS_A_WORLD = "needs a rigid-body world, which the profile world has"
MEETS_AGAIN = f"{NEEDS_A_WORLD}: the two meet again after their impact, unless the result of the impact is wrong"


def impulse_function(settings: Settings) -> str:
    """Name of the function that gives the impulse of an impact with friction."""
    return IMPULSE_BY[str(settings.options.get("impact_law", NEWTON))]


def after_impact(
    function: Callable[[str], Any],
    law: str,
    scenarios: Sequence[Scenario],
    at_a: tuple[Array, ...],
    at_b: tuple[Array, ...],
    normal: Array,
) -> tuple[Array, ...]:
    """Velocity and angular velocity of A, then those of B, (N, 3) each, after an impact with or without friction.

    function: finds a function by its name. law: the name of the one that gives the impulse. at_a, at_b: what
    `RigidBodies.struck_at` says of the two bodies. normal: from B to A, (N, 3).
    """
    restitution = np.array([scenario.pairs[0].restitution for scenario in scenarios])
    friction = np.array([scenario.pairs[0].kinetic_friction for scenario in scenarios])
    if not friction.any():
        smooth: tuple[Array, ...] = function("collide")(at_a, at_b, normal, restitution)
        return smooth
    normal_velocity, point_inverse_mass = function("normal_velocity"), function("point_inverse_mass")
    # The velocity of A's point of contact as seen from B's, component by component
    slip = np.stack([normal_velocity(at_a, at_b, axis) for axis in np.eye(3)], axis=-1)
    softness = sum(
        point_inverse_mass(inverse_mass, inverse_inertia, arm)
        for _, _, arm, inverse_mass, inverse_inertia in (at_a, at_b)
    )
    impulse = function(law)(slip, normal, softness, restitution, friction)
    rough: tuple[Array, ...] = function("apply_impulse")(at_a, at_b, impulse)
    return rough
