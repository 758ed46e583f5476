"""Three laws of an impact with friction that add no energy (slides 12, 16).

`friction_impulse` reverses the normal velocity by Newton's rule and lets
friction oppose the slip that is left. That may add energy. Each law here gives
up one of the two.
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    Share,
    Unit,
    Vector,
    domain,
    require,
)
from solutions.friction.impact import InverseMass
from solutions.friction.impact_course import NORMAL, Course, follow
from solutions.vectors import quotient

AGAIN = 1e-9
"""A speed of approach at the end is rounding below this share of the first."""
BETWEEN, SEARCHES = np.arange(1, 16) / 16, 15
"""Where a search looks between two directions, and how often; 16¹⁵ is 2⁶⁰."""


@domain
def dissipative_impulse(
    velocity: Vector,
    normal: Unit,
    inverse_mass: InverseMass,
    restitution: Share,
    friction: FiniteNotNegative,
) -> Array:
    """Impulse that takes the most energy and rebounds as Newton's rule says.

    Along the normal the points part at e times the speed of their approach.
    Friction is the impulse within the cone that leaves the least energy. No
    friction at all lies in the cone too, so that the impact never keeps more
    energy than one without friction.

    Parameters
    ----------
    velocity : (..., 3), u = ṗ_A − ṗ_B, m/s
        Of the two points before the impact.
    normal : (..., 3), n, unit, from B to A
    inverse_mass : (..., 3, 3), K, symmetric and positive definite, 1/kg
    restitution : (...), e, 0 to 1
    friction : (...), μ, not negative

    Returns
    -------
    (..., 3), J, N s
        The impulse on A; zero where the bodies do not approach.

    Raises
    ------
    ValueError
        If K is not positive definite, as in friction_impulse.

    Notes
    -----
    Write the velocity after the impact as u⁺ = u + K J. A small change dJ of
    the impulse changes the energy by u⁺·dJ. Newton's rule holds n·u⁺ fixed at
    −e u_n, so that every change of J_t changes J_n as well:

        J_n = c − a·J_t
        c = −(1 + e) u_n/K_nn
        a = K_nt/K_nn

    1. Along these changes the slope of the energy is u_t⁺ − a u_n⁺. The energy
       is least where the slope is zero:

           (K_tt − a K_nt) J_t = a u_n − u_t

       If that impulse lies in the cone, ‖J_t‖ ≤ μ J_n, it is the answer.
    2. Otherwise the answer lies on the edge of the cone. Look from the impulse
       without friction in the direction d, along the surface. The edge is R d
       away, where

           R = μ (c − R a·d) = μ c/(1 + μ a·d)

       There is no edge along d if the denominator is not positive. Let m be
       the least energy along this ray. The energy is convex and the cone is
       convex, so that m falls and then rises as d turns through the directions
       that lead downhill. Dividing the angle between a direction where m falls
       and one where m rises, again and again, finds the least.

    With e > 0 and a K that couples the directions, a full grip does not take
    the most energy. The first step ends with u_t⁺ = a u_n⁺, a slip that the
    rebound makes. So this law does not stop the slip even with very much
    friction, and friction need not oppose the slip that is left. Where K does
    not couple the normal with the surface, as for a sphere, a = 0 and this is
    `friction_impulse`.
    """
    contacts = _Approaching(
        velocity, normal, inverse_mass, restitution, friction
    )
    u, k, mu = contacts.u, contacts.k, contacts.mu
    c = -(1 + contacts.e) * u[:, 2] / k[:, 2, 2]
    a = k[:, :2, 2] / k[:, 2, 2, None]
    downhill = a * u[:, 2, None] - u[:, :2]
    curvature = k[:, :2, :2] - a[:, :, None] * k[:, 2, None, :2]
    tangent = np.linalg.solve(curvature, downhill[..., None])[..., 0]
    largest = mu * (c - np.vecdot(a, tangent))
    outside = np.linalg.norm(tangent, axis=-1) > largest
    tangent[outside] = _least_energy_on_the_edge(
        (mu * c)[outside],
        (mu[:, None] * a)[outside],
        downhill[outside],
        curvature[outside],
    )
    along_normal = c - np.vecdot(a, tangent)
    impulse = np.concatenate([tangent, along_normal[:, None]], axis=-1)
    return contacts.in_space(impulse)


@domain
def poisson_impulse(
    velocity: Vector,
    normal: Unit,
    inverse_mass: InverseMass,
    restitution: Share,
    friction: FiniteNotNegative,
) -> Array:
    """Impulse of an impact followed through, with Poisson's restitution.

    Until the approach ends the normal impulse grows to p_c. While the bodies
    part it grows by e p_c more. Friction opposes the slip of each moment.

    Parameters
    ----------
    velocity : (..., 3), u = ṗ_A − ṗ_B, m/s
        Of the two points before the impact.
    normal : (..., 3), n, unit, from B to A
    inverse_mass : (..., 3, 3), K, symmetric and positive definite, 1/kg
    restitution : (...), e, 0 to 1, the ratio of the two normal impulses
    friction : (...), μ, not negative

    Returns
    -------
    (..., 3), J, N s
        The impulse on A; zero where the bodies do not approach.

    Raises
    ------
    ValueError
        If K is not positive definite, as in friction_impulse.

    Notes
    -----
    This is Routh's construction; `follow` says how the impact is followed.
    With e = 0 it gives the impulse of the approach alone.

    Rarely the bodies approach again at the end: friction has turned the slip
    into a direction in which it pulls them together. Then the impact
    continues, and this second approach is resolved like the first.
    """
    contacts = _Approaching(
        velocity, normal, inverse_mass, restitution, friction
    )
    u, k, e, mu = contacts.u, contacts.k, contacts.e, contacts.mu
    course = Course(u, k, mu)
    follow(course, "speed", np.zeros(len(u)))
    follow(course, "impulse", (1 + e) * course.impulse[:, 2])
    after = course.velocity(np.arange(len(u)), course.impulse)
    again = after[:, 2] < -AGAIN * np.linalg.norm(u, axis=-1)
    if np.any(again):
        course.impulse[again] += poisson_impulse(
            after[again], NORMAL, k[again], e[again], mu[again]
        )
    return contacts.in_space(course.impulse)


@domain
def stronge_impulse(
    velocity: Vector,
    normal: Unit,
    inverse_mass: InverseMass,
    restitution: Share,
    friction: FiniteNotNegative,
) -> Array:
    """Impulse of an impact followed through, with Stronge's restitution.

    Until the approach ends the normal force takes the work W_c. While the
    bodies part it gives back e² W_c. Friction opposes the slip of each moment.
    Neither can add energy.

    Parameters
    ----------
    velocity : (..., 3), u = ṗ_A − ṗ_B, m/s
        Of the two points before the impact.
    normal : (..., 3), n, unit, from B to A
    inverse_mass : (..., 3, 3), K, symmetric and positive definite, 1/kg
    restitution : (...), e, 0 to 1, the root of the ratio of the two works
    friction : (...), μ, not negative

    Returns
    -------
    (..., 3), J, N s
        The impulse on A; zero where the bodies do not approach.

    Raises
    ------
    ValueError
        If K is not positive definite, as in friction_impulse.

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
    contacts = _Approaching(
        velocity, normal, inverse_mass, restitution, friction
    )
    course = Course(contacts.u, contacts.k, contacts.mu)
    follow(course, "speed", np.zeros(len(contacts.u)))
    follow(course, "work", (1 - contacts.e**2) * course.work)
    return contacts.in_space(course.impulse)


class _Approaching:
    """The contacts of a batch whose bodies approach, along their own axes.

    Attributes
    ----------
    u : (n, 3), velocities before the impact, m/s
    k : (n, 3, 3), K, 1/kg
    e, mu : (n,), e and μ
    """

    def __init__(
        self,
        velocity: Array,
        normal: Array,
        inverse_mass: Array,
        restitution: Array,
        friction: Array,
    ) -> None:
        symmetric = (inverse_mass + np.swapaxes(inverse_mass, -1, -2)) / 2
        rule = "inverse_mass must be positive definite for an impact to end"
        require(np.linalg.eigvalsh(symmetric) > 0, rule)
        self.shape = np.broadcast_shapes(
            velocity.shape[:-1],
            normal.shape[:-1],
            inverse_mass.shape[:-2],
            restitution.shape,
            friction.shape,
        )
        triples, matrices = (*self.shape, 3), (*self.shape, 3, 3)
        u = np.broadcast_to(velocity, triples).reshape(-1, 3)
        n = np.broadcast_to(normal, triples).reshape(-1, 3)
        k = np.broadcast_to(inverse_mass, matrices).reshape(-1, 3, 3)
        e = np.broadcast_to(restitution, self.shape).ravel()
        mu = np.broadcast_to(friction, self.shape).ravel()
        self.struck = np.vecdot(u, n) < 0
        self.axes = _contact_axes(n[self.struck])
        turned = np.swapaxes(self.axes, -1, -2)
        self.u = np.matvec(self.axes, u[self.struck])
        self.k = self.axes @ k[self.struck] @ turned
        self.e, self.mu = e[self.struck], mu[self.struck]

    def in_space(self, impulse: Array) -> Array:
        """Impulses (n, 3) along the axes as those of the batch, (..., 3), N s.

        Zero where the bodies do not approach.
        """
        impulses = np.zeros((len(self.struck), 3))
        impulses[self.struck] = np.vecmat(impulse, self.axes)
        return impulses.reshape(*self.shape, 3)


def _contact_axes(normal: Array) -> Array:
    """Two directions along the surface and the normal, as rows, (n, 3, 3)."""
    least = np.eye(3)[np.argmin(np.abs(normal), axis=-1)]
    second = np.cross(normal, least)
    second /= np.linalg.norm(second, axis=-1, keepdims=True)
    return np.stack([np.cross(second, normal), second, normal], axis=-2)


def _least_energy_on_the_edge(
    reach: Array, lean: Array, downhill: Array, curvature: Array
) -> Array:
    """J_t of least energy where the cone ends before the energy does, (n, 2).

    It lies between two directions. Each search looks at directions between
    them, and continues from the last to which the energy still falls.

    Parameters
    ----------
    reach : (n,), μ c
    lean : (n, 2), μ a
    downhill : (n, 2), a u_n − u_t
        Down which the energy falls from the impulse without friction.
    curvature : (n, 2, 2), K_tt − a K_nt
    """
    if not len(reach):
        return downhill
    cone = [x[:, None] for x in (reach, lean, downhill, curvature)]
    low = np.arctan2(downhill[:, 1], downhill[:, 0]) - np.pi / 2
    width = np.pi
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
    edge = np.where(opening > 0, quotient(reach, opening), np.inf)
    along = np.minimum(edge, bottom)[..., None] * d
    slope = np.matvec(curvature, along) - downhill
    grows = np.where(edge < bottom, np.vecdot(lean, turned) / opening, 0.0)
    along_edge = turned - grows[..., None] * d
    return along, np.vecdot(slope, along_edge) < 0
