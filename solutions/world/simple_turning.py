"""A body that turns freely: its turn, and then its spin (slide 18)."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, positive, vector, with_shape
from solutions.domain import Number, Quaternion, Vector, domain
from solutions.impulse import rotation_matrix
from solutions.world.rotation import turned

PositiveMoments = Annotated[Array, vector, positive]
"""(..., 3), positive; infinite for a body that nothing turns."""
OneTime = Annotated[Array, with_shape(), finite]
"""One number, finite, s."""


@domain
def inverse_inertias(moments: Number, orientation: ArrayLike) -> Array:
    """I⁻¹ of bodies along the axes of the world, (..., 3, 3), 1/(kg m²).

    Along a body's own axes it has 1/moments, and 0 for an infinite one.
    """
    axes = rotation_matrix(orientation)
    return np.einsum("...ij,...j,...kj->...ik", axes, 1 / moments, axes)


@domain
def rotate_by_momentum(
    orientation: Quaternion,
    angular_velocity: Vector,
    moments: PositiveMoments,
    dt: OneTime,
) -> tuple[Array, Array]:
    """Turn bodies on which no torque acts, over a time dt (slide 18).

    Parameters
    ----------
    orientation : (..., 4), q, unit quaternion w, x, y, z
    angular_velocity : (..., 3), ω in the world frame at the start, rad/s
    moments : (..., 3), about the body's own axes, kg m², positive
        All three are infinite for a body that nothing else turns.
    dt : s

    Returns
    -------
    orientation : (..., 4)
        Turned by the whole ω dt, with ω as it is at the start.
    angular_velocity : (..., 3), in the world frame, rad/s
        The one with which the body, as it now lies, has the angular momentum
        of the start. A body with infinite moments keeps its ω.

    Notes
    -----
    The angular momentum is

        L = I(q) ω
        I(q) = R I_body Rᵀ

    Without a torque L stays. The body turns, so I(q) changes, and ω must
    change too:

        ω⁺ = I⁻¹(q⁺) L

    L stays to rounding, however long the step is. The energy ω·L/2 does not:
    a turn by ω dt leads away from the curve on which it is constant.
    `turn_freely` puts the turn together from parts that can be written down
    exactly, and its energy does not drift.
    """
    q, w = orientation, angular_velocity
    free = np.isfinite(moments)
    r = rotation_matrix(q)
    own_w = np.vecmat(w, r)  # along the body's own axes
    own_momentum = np.where(free, moments, 0.0) * own_w
    momentum = np.matvec(r, own_momentum)
    q_after = turned(q, w * dt)
    w_after = np.matvec(inverse_inertias(moments, q_after), momentum)
    return q_after, np.where(np.all(free, axis=-1, keepdims=True), w_after, w)
