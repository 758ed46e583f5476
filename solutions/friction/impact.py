"""Friction during an impact, which the slides leave out (slides 16 and 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import (
    finite,
    in_unit_interval,
    matrix,
    not_negative,
    positive,
    unit,
    vector,
)
from solutions.friction.support import less_normal_part

SINGULAR = 1e-12
"""Share of the product of its rows' lengths below which det K counts as zero.

A smaller determinant would leave an impulse few digits.
"""


def point_inverse_mass(
    inverse_mass: ArrayLike,
    inverse_inertia: ArrayLike,
    arm: ArrayLike,
) -> Array:
    """Matrix K that turns an impulse at a point into its change of velocity.

    For two bodies the changes of u = ṗ_A − ṗ_B add up: K = K_A + K_B.

    Parameters
    ----------
    inverse_mass : (...), 1/m, 1/kg
    inverse_inertia : (..., 3, 3), I⁻¹ in the world frame, 1/(kg m²)
    arm : (..., 3), r, from the centre of mass to the point, m

    Returns
    -------
    (..., 3, 3), 1/kg
        0 for an immovable body.

    Raises
    ------
    ValueError
        If 1/m is negative, something is not finite, or shapes do not fit.

    Notes
    -----
    An impulse J changes v by J/m and ω by I⁻¹(r × J). The velocity v + ω × r
    of the point therefore changes by J/m + (I⁻¹(r × J)) × r. Write r × as the
    matrix [r×]; the last product is −[r×] I⁻¹ [r×] J, and the whole change is
    K J with

        K = 1/m − [r×] I⁻¹ [r×]

    Along the normal alone, n·K n is `inverse_effective_mass`, which the
    lecture derives term by term. The two functions are independent so that
    they can be compared.
    """
    # This is [r×]ᵀ = −[r×].
    across = np.cross(
        finite("arm", vector("arm", arm))[..., None, :], np.eye(3)
    )
    shares = finite(
        "inverse_mass", not_negative("inverse_mass", inverse_mass)
    )[..., None, None] * np.eye(3)
    return np.asarray(
        shares
        + np.swapaxes(across, -1, -2)
        @ matrix("inverse_inertia", inverse_inertia)
        @ across
    )


def positive_definite(inverse_mass: Array) -> Array:
    """Return matrices K; refuse one with which no impulse stops the bodies."""
    singular = np.linalg.det(inverse_mass) <= SINGULAR * np.linalg.norm(
        inverse_mass, axis=-1
    ).prod(axis=-1)
    if np.any(singular) or np.any(
        np.diagonal(inverse_mass, axis1=-2, axis2=-1) <= 0
    ):
        raise ValueError(
            "inverse_mass must be positive definite: no impulse stops two"
            " immovable bodies"
        )
    return inverse_mass


def friction_impulse(
    velocity: ArrayLike,
    normal: ArrayLike,
    inverse_mass: ArrayLike,
    restitution: ArrayLike,
    friction: ArrayLike,
) -> Array:
    """Impulse on body A at a contact with friction; −J acts on body B.

    Along the normal the points rebound by Newton's rule. The contact grips if
    friction can stop the slip; otherwise it slips.

    Parameters
    ----------
    velocity : (..., 3), u = ṗ_A − ṗ_B, of the two points before the impact,
    m/s
    normal : (..., 3), unit, from B to A
    inverse_mass : (..., 3, 3), K, symmetric and positive definite, 1/kg
    restitution : (...), e, 0 to 1
    friction : (...), μ

    Returns
    -------
    (..., 3), N s
        Zero where the bodies do not approach.

    Raises
    ------
    ValueError
        If e is not from 0 to 1, μ is negative, a normal does not have length
        1, something is not finite, or K cannot be inverted: the K of two
        immovable bodies, or of one that only turns about a pivot and one that
        is immovable.

    Notes
    -----
    1. Grip: try the impulse that stops the slip and reverses the approach as
       Newton's rule says. The velocity after it is −e u_n n, so that K J = −u
       − e u_n n.
    2. If this impulse lies within the cone ‖J_t‖ ≤ μ J·n, it is the answer.
    3. Slip: otherwise J = j (n + μ d), where d is the direction of the grip's
       J_t. Newton's rule along the normal gives j: j n·K(n + μ d) = −(1 + e)
       u_n. There is always an answer, because the grip's J has one, and so has
       n alone.

    For a sphere, d is opposed to the slip. In the plane, d is always opposed
    to the slip that is left. In space, with a K that couples the directions,
    it is only near that: for odd bodies it is 6° off in the median and 68° at
    worst.

    The impact is one instant, and a slip that stops and turns round within it
    is not followed. The energy may therefore rise, as it may wherever Newton's
    restitution meets Coulomb's friction (see `impact_energy`). It does so in
    about one of a thousand random impacts of two odd bodies, at worst by more
    energy than the contact had. In exchange the points always part at e times
    the speed of their approach, and friction opposes the slip that is left, as
    nearly as said above. `dissipative_impulse` gives up the second, and
    `poisson_impulse` and `stronge_impulse` give up the first: none of the
    three adds energy.
    """
    u, n = (
        finite("velocity", vector("velocity", velocity)),
        unit("normal", vector("normal", normal)),
    )
    e, mu = (
        in_unit_interval("restitution", restitution),
        finite("friction", not_negative("friction", friction)),
    )
    k = positive_definite(matrix("inverse_mass", inverse_mass))
    approach = np.vecdot(u, n)
    grip = np.linalg.solve(k, (-u - (e * approach)[..., None] * n)[..., None])[
        ..., 0
    ]
    across = less_normal_part(grip, n)
    sticks = np.linalg.norm(across, axis=-1) <= mu * np.vecdot(grip, n)
    size = np.linalg.norm(across, axis=-1, keepdims=True)
    edge = n + mu[..., None] * across / np.where(size > 0, size, 1.0)
    gained = np.vecdot(
        n, np.matvec(k, edge)
    )  # above zero wherever the contact slips
    slip = (-(1 + e) * approach / np.where(gained > 0, gained, 1.0))[
        ..., None
    ] * edge
    return np.where(
        (approach < 0)[..., None],
        np.where(sticks[..., None], grip, slip),
        0.0,
    )


def impact_energy(
    velocity: ArrayLike,
    impulse: ArrayLike,
    inverse_mass: ArrayLike,
) -> Array:
    """Energy that an impulse adds to two bodies; never above zero in an honest impact.

    Parameters
    ----------
    velocity : (..., 3), u before the impact, m/s
    impulse : (..., 3), J, N s
    inverse_mass : (..., 3, 3), K, 1/kg

    Returns
    -------
    (...), J

    Raises
    ------
    ValueError
        If the shapes do not fit or K is not finite.

    Notes
    -----
    The work of an impulse is the impulse times the mean of the velocities
    before and after it, which are u and u + K J:

        J·(u + K J/2)
    """
    j, k = vector("impulse", impulse), matrix("inverse_mass", inverse_mass)
    return np.asarray(
        np.vecdot(j, vector("velocity", velocity) + np.matvec(k, j) / 2)
    )


def sphere_impact(
    velocity: ArrayLike,
    angular_velocity: ArrayLike,
    normal: ArrayLike,
    radius: ArrayLike,
    restitution: ArrayLike,
    friction: ArrayLike,
    inertia_share: ArrayLike = 0.4,
) -> tuple[Array, Array]:
    """Velocities of a sphere after it has struck an immovable plane with friction.

    Friction turns spin into motion along the plane and back.

    Parameters
    ----------
    velocity, angular_velocity : (..., 3), m/s and rad/s
    normal : (..., 3), unit, out of the plane
    radius : (...), R, m
    restitution, friction : (...), e, 0 to 1, and μ
    inertia_share : (...), I/(m R²); 2/5 for a solid sphere, 2/3 for a hollow
    one

    Returns
    -------
    velocity, angular_velocity : (..., 3), m/s and rad/s

    Raises
    ------
    ValueError
        As friction_impulse, or if the radius or the inertia is not positive
        and finite.

    Notes
    -----
    The arm from the centre to the contact is r = −R n. The impulse and the
    inertia are both proportional to the mass, so that the mass drops out.
    """
    v, spin, n = (
        vector("velocity", velocity),
        vector("angular_velocity", angular_velocity),
        vector("normal", normal),
    )
    r = finite("radius", positive("radius", radius))[..., None]
    share = finite("inertia_share", positive("inertia_share", inertia_share))[
        ..., None
    ]
    arm, inertia = -r * n, share * r**2
    k = point_inverse_mass(1.0, np.eye(3) / inertia[..., None], arm)
    j = friction_impulse(v + np.cross(spin, arm), n, k, restitution, friction)
    return v + j, spin + np.cross(arm, j) / inertia
