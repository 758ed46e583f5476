"""Friction of a penalty contact: a spring that slides at Coulomb's limit.

This goes beyond slide 8. The spring lies along the surface. It is that of Cundall and
Strack (1979), who founded the discrete element method on it, and it remembers how far
the contact has been dragged.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive, unit, vector
from solutions.friction.support import less_normal_part


def tangential_spring(
    stretch: ArrayLike,
    slip_velocity: ArrayLike,
    normal: ArrayLike,
    normal_force: ArrayLike,
    friction: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """Friction force after a step, and the stretch to hand to the next step.

    Parameters
    ----------
    stretch : (..., 3), ξ, m, what the last step returned; 0 at the first touch
    slip_velocity : (..., 3), u, of the body's point relative to the other's, m/s
        Only its part along the surface counts.
    normal : (..., 3), unit, out of the other body
    normal_force : (...), N, not negative
    friction : (...), μ
    stiffness : (...), k_t, N/m, positive
    damping : (...), c_t, N s/m
    dt : (...), length of the step, s

    Returns
    -------
    force : (..., 3), N, on the body, along the surface
    stretch : (..., 3), m
        Both are 0 where N = 0: a contact that has opened forgets its history.

    Raises
    ------
    ValueError
        If N, μ, c_t or dt is negative, k_t is not positive, something is not finite, or
        a normal does not have length 1.

    Notes
    -----
    1. The stretch of the last step is turned into the surface of now: its part along
       the normal is dropped, and its length is kept. Nothing can be kept where the
       stretch lies along the new normal, because no direction in the surface is left:
       it then becomes 0.
    2. The slip of this step stretches the spring: ξ + u_t dt.
    3. The spring and the dashpot ask for the force −k_t ξ − c_t u_t. Up to μ N the
       contact sticks, and this is the force.
    4. Beyond, it slides. The force keeps its direction and has the length μ N, and the
       spring gives way: ξ = −(F + c_t u_t)/k_t, so that it asks for just this force.

    While it sticks, the contact is elastic, so that a body on a slope comes to rest.
    Friction that depends on the velocity alone would let it creep.
    """
    n, press = (
        unit("normal", vector("normal", normal)),
        finite("normal_force", not_negative("normal_force", normal_force)),
    )
    mu, k = (
        finite("friction", not_negative("friction", friction)),
        finite("stiffness", positive("stiffness", stiffness)),
    )
    c, dt = (
        finite("damping", not_negative("damping", damping)),
        finite("dt", not_negative("dt", dt)),
    )
    slip = less_normal_part(
        finite("slip_velocity", vector("slip_velocity", slip_velocity)), n
    )
    xi = (
        _into_new_surface(finite("stretch", vector("stretch", stretch)), n)
        + slip * dt[..., None]
    )
    asked, dashpot = (
        -k[..., None] * xi - c[..., None] * slip,
        c[..., None] * slip,
    )
    size, most = np.linalg.norm(asked, axis=-1), mu * press
    slides = size > most
    force = (
        asked
        * np.where(slides, most / np.where(slides, size, 1.0), 1.0)[..., None]
    )
    xi = np.where(slides[..., None], -(force + dashpot) / k[..., None], xi)
    touches = (press > 0)[..., None]
    return np.where(touches, force, 0.0), np.where(touches, xi, 0.0)


def _into_new_surface(stretch: Array, n: Array) -> Array:
    """The stretch in the surface of the new normal, as long as before."""
    along = less_normal_part(stretch, n)
    before = np.linalg.norm(stretch, axis=-1, keepdims=True)
    after = np.linalg.norm(along, axis=-1, keepdims=True)
    return np.asarray(
        along
        * np.where(after > 0, before / np.where(after > 0, after, 1.0), 0.0)
    )
