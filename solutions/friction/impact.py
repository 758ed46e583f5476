"""Friction during an impact, which the slides leave out (slides 16 and 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, in_unit_interval, matrix, not_negative, positive, unit, vector
from solutions.friction.support import along_surface

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
SINGULAR = 1e-12
"""Below this share of the product of its rows' lengths det K counts as zero: it would leave an impulse few digits."""


def point_inverse_mass(inverse_mass: ArrayLike, inverse_inertia: ArrayLike, arm: ArrayLike) -> Array:
    """Velocity that a unit impulse gives to a point of a body: K = 1/m − [r×] I⁻¹ [r×], (..., 3, 3), 1/kg.

    For two bodies the changes of u = ṗ_A − ṗ_B add up: K = K_A + K_B. An immovable body has K = 0. Along the normal
    alone n·K n is `inverse_effective_mass`, which the lecture derives term by term: the two stand apart to be compared.

    Parameters
    ----------
    inverse_mass : (...), 1/m, 1/kg
    inverse_inertia : (..., 3, 3), I⁻¹ in the world frame, 1/(kg m²)
    arm : (..., 3), r, from the centre of mass to the point, m

    Raises
    ------
    ValueError
        If 1/m is negative, something is not finite, or shapes do not fit.
    """
    across = np.cross(finite("arm", vector("arm", arm))[..., None, :], np.eye(3))  # [r×]ᵀ = −[r×]
    shares = finite("inverse_mass", not_negative("inverse_mass", inverse_mass))[..., None, None] * np.eye(3)
    return np.asarray(shares + np.swapaxes(across, -1, -2) @ matrix("inverse_inertia", inverse_inertia) @ across)


def friction_impulse(
    velocity: ArrayLike, normal: ArrayLike, inverse_mass: ArrayLike, restitution: ArrayLike, friction: ArrayLike
) -> Array:
    """Impulse on body A at a contact with friction, (..., 3), N s; −J acts on body B.

    1. Grip: the impulse that stops the slip and turns the approach round as Newton says, K J = −u − e u_n n.
    2. Where it lies within the cone ‖J_t‖ ≤ μ J·n, that is all.
    3. Slip: else J = j (n + μ d), with d the direction of the grip's J_t, and j from Newton's rule again,
       j n·K(n + μ d) = −(1 + e) u_n. This has always an answer: the grip's J has one, and so has n alone.

    For a sphere d is against the slip. In the plane it is always against the slip that is left. In space, with a K that
    couples the directions, it is only near that: for odd bodies 6° off in the median, 68° at worst. And the impact is
    one instant: a slip that stops and turns round within it is not followed, so that the energy may rise, as it may
    wherever Newton's restitution meets Coulomb's friction (see impact_energy).

    Parameters
    ----------
    velocity : (..., 3), u = ṗ_A − ṗ_B, of the two points before the impact, m/s
    normal : (..., 3), unit, from B to A
    inverse_mass : (..., 3, 3), K, symmetric and positive definite, 1/kg
    restitution : (...), e, 0 to 1
    friction : (...), μ

    Returns
    -------
    (..., 3), N s; zero where the bodies do not approach

    Raises
    ------
    ValueError
        If e is not from 0 to 1, μ is negative, a normal has not length 1, something is not finite, or K cannot be
        inverted: of two immovable bodies, or of one that only turns about a pivot and one that is immovable.
    """
    u, n = finite("velocity", vector("velocity", velocity)), unit("normal", vector("normal", normal))
    e, mu = in_unit_interval("restitution", restitution), finite("friction", not_negative("friction", friction))
    k = matrix("inverse_mass", inverse_mass)
    singular = np.linalg.det(k) <= SINGULAR * np.linalg.norm(k, axis=-1).prod(axis=-1)
    if np.any(singular) or np.any(np.diagonal(k, axis1=-2, axis2=-1) <= 0):
        raise ValueError("inverse_mass must be positive definite: no impulse stops two immovable bodies")
    approach = np.vecdot(u, n)
    grip = np.linalg.solve(k, (-u - (e * approach)[..., None] * n)[..., None])[..., 0]
    across = along_surface(grip, n)
    sticks = np.linalg.norm(across, axis=-1) <= mu * np.vecdot(grip, n)
    size = np.linalg.norm(across, axis=-1, keepdims=True)
    edge = n + mu[..., None] * across / np.where(size > 0, size, 1.0)
    gained = np.vecdot(n, np.matvec(k, edge))  # above zero wherever it slips
    slip = (-(1 + e) * approach / np.where(gained > 0, gained, 1.0))[..., None] * edge
    return np.where((approach < 0)[..., None], np.where(sticks[..., None], grip, slip), 0.0)


def impact_energy(velocity: ArrayLike, impulse: ArrayLike, inverse_mass: ArrayLike) -> Array:
    """Energy that an impulse adds to the two bodies: J·(u + K J/2), (...), J; an honest impact has none above zero.

    The impulse times the mean of the velocities before and after, u and u + K J.

    Parameters
    ----------
    velocity : (..., 3), u before the impact, m/s
    impulse : (..., 3), J, N s
    inverse_mass : (..., 3, 3), K, 1/kg

    Raises
    ------
    ValueError
        If the shapes do not fit or K is not finite.
    """
    j, k = vector("impulse", impulse), matrix("inverse_mass", inverse_mass)
    return np.asarray(np.vecdot(j, vector("velocity", velocity) + np.matvec(k, j) / 2))


def sphere_grips(slip: ArrayLike, approach_speed: ArrayLike, restitution: ArrayLike, friction: ArrayLike) -> Bools:
    """Whether a solid sphere grips the floor in an impact: |u_t| ≤ (7/2) μ (1 + e) v_n, (...), bool.

    Its slip changes by J_t/m from its way and 5/2 J_t/m from its spin, and J_t is at most μ m (1 + e) v_n.

    Parameters
    ----------
    slip : (...), |u_t| of the point of contact, m/s
    approach_speed : (...), v_n, m/s
    restitution, friction : (...), e, 0 to 1, and μ

    Raises
    ------
    ValueError
        If e is not from 0 to 1, another number is negative, or μ or v_n is not finite.
    """
    mu = finite("friction", not_negative("friction", friction))
    speed = finite("approach_speed", not_negative("approach_speed", approach_speed))
    most = 3.5 * mu * (1 + in_unit_interval("restitution", restitution)) * speed
    return np.asarray(not_negative("slip", slip) <= most, dtype=bool)


def sphere_impact(
    velocity: ArrayLike,
    angular_velocity: ArrayLike,
    normal: ArrayLike,
    radius: ArrayLike,
    restitution: ArrayLike,
    friction: ArrayLike,
    inertia_share: ArrayLike = 0.4,
) -> tuple[Array, Array]:
    """Velocities of a sphere after it has struck an immovable plane: friction turns spin into way and back.

    The arm is r = −R n, the mass drops out.

    Parameters
    ----------
    velocity, angular_velocity : (..., 3), m/s and rad/s
    normal : (..., 3), unit, out of the plane
    radius : (...), R, m
    restitution, friction : (...), e, 0 to 1, and μ
    inertia_share : (...), I/(m R²); 2/5 for a solid sphere, 2/3 for a hollow one

    Returns
    -------
    velocity, angular_velocity : (..., 3), m/s and rad/s

    Raises
    ------
    ValueError
        As friction_impulse, or if the radius or the inertia is not positive and finite.
    """
    v, spin, n = vector("velocity", velocity), vector("angular_velocity", angular_velocity), vector("normal", normal)
    r = finite("radius", positive("radius", radius))[..., None]
    share = finite("inertia_share", positive("inertia_share", inertia_share))
    inertia = (share[..., None] * r**2)[..., None]
    arm = -r * n
    k = point_inverse_mass(1.0, np.eye(3) / inertia, arm)
    j = friction_impulse(v + np.cross(spin, arm), n, k, restitution, friction)
    return v + j, spin + np.cross(arm, j) / inertia[..., 0]
