"""Three laws of an impact with friction, none of which adds energy (slides 12 and 16).

`friction_impulse` reverses the normal velocity by Newton's rule and lets
friction oppose the slip that is left. That may add energy. Each law here gives
up one of the two.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import (
    finite,
    in_unit_interval,
    matrix,
    not_negative,
    unit,
    vector,
)
from solutions.friction.impact import positive_definite
from solutions.friction.impact_course import Course, follow

AGAIN = 1e-9
"""A speed of approach at the end below this share of the speed before is rounding."""
BETWEEN, SEARCHES = np.arange(1, 16) / 16, 15
"""Where a search looks between two directions, and how often; 16¹⁵ is 2⁶⁰."""


def dissipative_impulse(
    velocity: ArrayLike,
    normal: ArrayLike,
    inverse_mass: ArrayLike,
    restitution: ArrayLike,
    friction: ArrayLike,
) -> Array:
    """Impulse that takes the most energy and rebounds as Newton's rule says.

    Along the normal the points part at e times the speed of their approach.
    Friction is the impulse within the cone that leaves the least energy. No
    friction at all lies in the cone too, so that the impact never keeps more
    energy than one without friction.

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
        The impulse on A; zero where the bodies do not approach.

    Raises
    ------
    ValueError
        As friction_impulse.

    Notes
    -----
    Write the velocity after the impact as u⁺ = u + K J. A small change dJ of
    the impulse changes the energy by u⁺·dJ. Newton's rule holds n·u⁺ fixed at
    −e u_n, so that every change of J_t changes J_n as well:

        J_n = c − a·J_t,  with c = −(1 + e) u_n/K_nn and a = K_nt/K_nn

    1. Along these changes the slope of the energy is u_t⁺ − a u_n⁺. The energy
       is least where the slope is zero. If that impulse lies in the cone, it
       is the answer.
    2. Otherwise the answer lies on the edge of the cone. Look from the impulse
       without friction in the direction d, along the surface. The edge is R d
       away, where R = μ (c − R a·d), which is R = μ c/(1 + μ a·d); there is no
       edge that way if the denominator is not positive. Let m be the least
       energy along this ray. The energy is convex and the cone is convex, so
       that m falls and then rises as d turns through the directions that lead
       downhill. Halving the angle between a direction where m falls and one
       where m rises finds the least.

    With e > 0 and a K that couples the directions, a full grip does not take
    the most energy. The first step ends with u_t⁺ = a u_n⁺, a slip that the
    rebound makes. So this law does not stop the slip even with very much
    friction, and friction need not oppose the slip that is left. Where K does
    not couple the normal with the surface, as for a sphere, a = 0 and this is
    `friction_impulse`.
    """
    return _where_approaching(
        _most_dissipation,
        velocity,
        normal,
        inverse_mass,
        restitution,
        friction,
    )


def poisson_impulse(
    velocity: ArrayLike,
    normal: ArrayLike,
    inverse_mass: ArrayLike,
    restitution: ArrayLike,
    friction: ArrayLike,
) -> Array:
    """Impulse of an impact that is followed through, with Poisson's restitution.

    Until the approach ends the normal impulse grows to p_c. While the bodies
    part it grows by e p_c more. Friction opposes the slip of each moment.

    Parameters
    ----------
    velocity : (..., 3), u = ṗ_A − ṗ_B, of the two points before the impact,
    m/s
    normal : (..., 3), unit, from B to A
    inverse_mass : (..., 3, 3), K, symmetric and positive definite, 1/kg
    restitution : (...), e, 0 to 1, the ratio of the two normal impulses
    friction : (...), μ

    Returns
    -------
    (..., 3), N s
        The impulse on A; zero where the bodies do not approach.

    Raises
    ------
    ValueError
        As friction_impulse.

    Notes
    -----
    This is Routh's construction; `follow` says how the impact is followed.
    With e = 0 it gives the impulse of the approach alone.

    Rarely the bodies approach again at the end: friction has turned the slip
    into a direction in which it pulls them together. Then the impact goes on,
    and this second approach is answered like the first.
    """
    return _where_approaching(
        _routh_poisson, velocity, normal, inverse_mass, restitution, friction
    )


def stronge_impulse(
    velocity: ArrayLike,
    normal: ArrayLike,
    inverse_mass: ArrayLike,
    restitution: ArrayLike,
    friction: ArrayLike,
) -> Array:
    """Impulse of an impact that is followed through, with Stronge's restitution.

    Until the approach ends the normal force takes the work W_c. While the
    bodies part it gives back e² W_c. Friction opposes the slip of each moment.
    Neither can add energy.

    Parameters
    ----------
    velocity : (..., 3), u = ṗ_A − ṗ_B, of the two points before the impact,
    m/s
    normal : (..., 3), unit, from B to A
    inverse_mass : (..., 3, 3), K, symmetric and positive definite, 1/kg
    restitution : (...), e, 0 to 1, the root of the ratio of the two works
    friction : (...), μ

    Returns
    -------
    (..., 3), N s
        The impulse on A; zero where the bodies do not approach.

    Raises
    ------
    ValueError
        As friction_impulse.

    Notes
    -----
    This is Routh's construction with another end; `follow` says how the impact
    is followed. The work of the normal force is the integral of u_n over the
    normal impulse, which is negative until the approach first ends. The impact
    is over when all the work so far is (1 − e²) times that of the first
    approach.

    Rounding adds energy where K is badly conditioned: 10⁻⁹ of the contact's at
    a condition of 10⁶, and 10⁻⁵ at 10⁹. So it does in `poisson_impulse`.
    """

    def routh(u: Array, k: Array, e: Array, mu: Array) -> Array:
        course = Course(u, k, mu)
        follow(course, "speed", np.zeros(len(u)))
        follow(course, "work", (1 - e**2) * course.work)
        return course.impulse

    return _where_approaching(
        routh, velocity, normal, inverse_mass, restitution, friction
    )


def _routh_poisson(u: Array, k: Array, e: Array, mu: Array) -> Array:
    """Impulse of `poisson_impulse` along the axes of the contact, (n, 3)."""
    course = Course(u, k, mu)
    follow(course, "speed", np.zeros(len(u)))
    follow(course, "impulse", (1 + e) * course.impulse[:, 2])
    after = course.velocity(np.arange(len(u)), course.impulse)
    again = after[:, 2] < -AGAIN * np.linalg.norm(u, axis=-1)
    if np.any(again):
        course.impulse[again] += _routh_poisson(
            after[again], k[again], e[again], mu[again]
        )
    return course.impulse


def _where_approaching(
    law: Callable[[Array, Array, Array, Array], Array],
    velocity: ArrayLike,
    normal: ArrayLike,
    inverse_mass: ArrayLike,
    restitution: ArrayLike,
    friction: ArrayLike,
) -> Array:
    """Impulses of a law that takes u, K, e and μ of approaching contacts.

    The law sees vectors along the axes of the contact, and returns J along
    them.
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
    if np.any(np.linalg.eigvalsh((k + np.swapaxes(k, -1, -2)) / 2) <= 0):
        raise ValueError(
            "inverse_mass must be positive definite: an impact with this"
            " matrix need not end"
        )
    shape = np.broadcast_shapes(
        u.shape[:-1], n.shape[:-1], k.shape[:-2], e.shape, mu.shape
    )
    u, n = (np.broadcast_to(x, (*shape, 3)).reshape(-1, 3) for x in (u, n))
    k = np.broadcast_to(k, (*shape, 3, 3)).reshape(-1, 3, 3)
    e, mu = (np.broadcast_to(x, shape).ravel() for x in (e, mu))
    struck = np.vecdot(u, n) < 0
    axes = _contact_axes(n[struck])
    impulse = np.zeros((len(u), 3))
    along = law(
        np.matvec(axes, u[struck]),
        axes @ k[struck] @ np.swapaxes(axes, -1, -2),
        e[struck],
        mu[struck],
    )
    impulse[struck] = np.vecmat(along, axes)
    return impulse.reshape(*shape, 3)


def _contact_axes(normal: Array) -> Array:
    """Two directions along the surface and the normal, as rows, (n, 3, 3)."""
    least = np.eye(3)[np.argmin(np.abs(normal), axis=-1)]
    second = np.cross(normal, least)
    second /= np.linalg.norm(second, axis=-1, keepdims=True)
    return np.stack([np.cross(second, normal), second, normal], axis=-2)


def _most_dissipation(u: Array, k: Array, e: Array, mu: Array) -> Array:
    """Impulse of `dissipative_impulse` along a contact's axes, (n, 3)."""
    smooth, a = -(1 + e) * u[:, 2] / k[:, 2, 2], k[:, :2, 2] / k[:, 2, 2, None]
    downhill = a * u[:, 2, None] - u[:, :2]
    curvature = k[:, :2, :2] - a[:, :, None] * k[:, 2, None, :2]
    along = np.linalg.solve(curvature, downhill[..., None])[..., 0]
    outside = np.linalg.norm(along, axis=-1) > mu * (
        smooth - np.vecdot(a, along)
    )
    edge = (
        x[outside] for x in (mu * smooth, mu[:, None] * a, downhill, curvature)
    )
    along[outside] = _least_energy_on_the_edge(*edge)
    return np.concatenate(
        [along, (smooth - np.vecdot(a, along))[:, None]], axis=-1
    )


def _least_energy_on_the_edge(
    reach: Array, lean: Array, downhill: Array, curvature: Array
) -> Array:
    """J_t of least energy where the cone ends before the energy does, (n, 2).

    It lies between two directions. Each search looks at directions between
    them, and goes on from the last to which the energy still falls.

    reach: μ c. lean: μ a, (n, 2). downhill: −slope of the energy without
    friction.
    """
    if not len(reach):
        return downhill
    cone = [x[:, None] for x in (reach, lean, downhill, curvature)]
    low, width = np.arctan2(downhill[:, 1], downhill[:, 0]) - np.pi / 2, np.pi
    for _ in range(SEARCHES):
        _, falls = _on_the_edge(low[:, None] + width * BETWEEN, *cone)
        passed = np.sum(np.logical_and.accumulate(falls, axis=-1), axis=-1)
        width /= len(BETWEEN) + 1
        low = low + width * passed
    along, _ = _on_the_edge(low[:, None] + width / 2, *cone)
    return along[:, 0]


def _on_the_edge(
    angle: Array, reach: Array, lean: Array, downhill: Array, curvature: Array
) -> tuple[Array, Array]:
    """J_t of least energy in a direction, and whether a turn lowers it more.

    (..., 2) and (...). A turn to the left, along the edge of the cone.
    """
    d = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    turned = np.stack([-d[..., 1], d[..., 0]], axis=-1)
    bottom = np.vecdot(downhill, d) / np.vecdot(d, np.matvec(curvature, d))
    opening = 1 + np.vecdot(lean, d)
    edge = np.where(
        opening > 0, reach / np.where(opening > 0, opening, 1.0), np.inf
    )
    along = np.minimum(edge, bottom)[..., None] * d
    slope = np.matvec(curvature, along) - downhill
    grows = np.where(edge < bottom, np.vecdot(lean, turned) / opening, 0.0)
    way = turned - grows[..., None] * d
    return along, np.vecdot(slope, way) < 0
