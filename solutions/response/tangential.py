"""Friction of a penalty contact: a spring that slides at Coulomb's limit.

This goes beyond slide 8. The spring lies along the surface. It is that of
Cundall and Strack (1979), who founded the discrete element method on it, and
it remembers how far the contact has been dragged.
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    Unit,
    Vector,
    domain,
)
from solutions.friction import clamp_to_circle
from solutions.vectors import part_across, quotient


@domain
def tangential_spring(
    stretch: Vector,
    slip_velocity: Vector,
    normal: Unit,
    normal_force: FiniteNotNegative,
    friction: FiniteNotNegative,
    stiffness: FinitePositive,
    damping: FiniteNotNegative,
    dt: FiniteNotNegative,
) -> tuple[Array, Array]:
    """Friction force after a step, and the stretch to hand to the next step.

    Parameters
    ----------
    stretch : (..., 3), ξ, m
        What the last step returned; 0 at the first touch.
    slip_velocity : (..., 3), u, m/s
        Of the body's point relative to the other's. Only its part along the
        surface counts.
    normal : (..., 3), unit, out of the other body
    normal_force : (...), N, in newtons, not negative
    friction : (...), μ, not negative
    stiffness : (...), k_t, N/m, positive
    damping : (...), c_t, N s/m, not negative
    dt : (...), s, length of the step, not negative

    Returns
    -------
    force : (..., 3), N, on the body, along the surface
    stretch : (..., 3), m
        Both are 0 where N = 0: a contact that has opened forgets its history.

    Notes
    -----
    1. The stretch of the last step is turned into the surface of now: its part
       along the normal is dropped, and its length is kept. Nothing can be kept
       where the stretch lies along the new normal, because no direction in the
       surface is left: it then becomes 0.
    2. The slip of this step, along the surface, stretches the spring further:

           ξ + u_t dt

    3. The spring and the dashpot together ask for the force

           −k_t ξ − c_t u_t

       Up to μ N the contact sticks, and this is the force F.
    4. Beyond μ N the contact slides. The force keeps its direction and has the
       length μ N, and the spring gives way until it asks for just this force:

           ξ = −(F + c_t u_t)/k_t

    While it sticks, the contact is elastic, so that a body on a slope comes to
    rest. Friction that depends on the velocity alone would let it creep.
    """
    k = stiffness[..., None]
    slip = part_across(slip_velocity, normal)
    xi = _into_new_surface(stretch, normal) + slip * dt[..., None]
    dashpot = damping[..., None] * slip
    holding = -k * xi - dashpot
    limit = friction * normal_force
    force = clamp_to_circle(holding, limit)
    slides = (np.linalg.norm(holding, axis=-1) > limit)[..., None]
    xi = np.where(slides, -(force + dashpot) / k, xi)
    touches = (normal_force > 0)[..., None]
    return np.where(touches, force, 0.0), np.where(touches, xi, 0.0)


def _into_new_surface(stretch: Array, normal: Array) -> Array:
    """The stretch in the surface of the new normal, as long as before."""
    in_surface = part_across(stretch, normal)
    before = np.linalg.norm(stretch, axis=-1, keepdims=True)
    after = np.linalg.norm(in_surface, axis=-1, keepdims=True)
    return in_surface * quotient(before, after)
