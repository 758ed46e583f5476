"""Friction during an impact, which the slides leave out (slides 16 and 24)."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from solutions.arrays import Array
from solutions.checks import matrix
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    Matrix,
    Share,
    Triple,
    Unit,
    Vector,
    domain,
    require,
)
from solutions.vectors import part_across, quotient

SINGULAR = 1e-12
"""Share of the product of its rows' lengths below which det K counts as zero.

A smaller determinant would leave an impulse few digits.
"""


@domain
def point_inverse_mass(
    inverse_mass: FiniteNotNegative,
    inverse_inertia: Matrix,
    arm: Vector,
) -> Array:
    """Matrix K that turns an impulse at a point into its change of velocity.

    For two bodies the changes of u = ṗ_A − ṗ_B add up: K = K_A + K_B.

    Parameters
    ----------
    inverse_mass : (...), 1/m, 1/kg, not negative
    inverse_inertia : (..., 3, 3), I⁻¹ in the world frame, 1/(kg m²)
    arm : (..., 3), r, from the centre of mass to the point, m

    Returns
    -------
    (..., 3, 3), K, 1/kg
        0 for an immovable body.

    Notes
    -----
    An impulse J changes v by J/m and ω by I⁻¹(r × J). The velocity v + ω × r
    of the point therefore changes by

        J/m + (I⁻¹(r × J)) × r

    Write r × as the matrix [r×], whose transpose is −[r×]. The last product is
    −[r×] I⁻¹ [r×] J, and the whole change is K J with

        K = (1/m) 1 − [r×] I⁻¹ [r×]
          = (1/m) 1 + [r×] I⁻¹ [r×]ᵀ

    where the single 1 is the unit matrix.

    Along the normal alone, n·K n is `inverse_effective_mass`, which the
    lecture derives term by term. The two functions are independent so that
    they can be compared.
    """
    transposed = np.cross(arm[..., None, :], np.eye(3))  # [r×]ᵀ
    turning = np.swapaxes(transposed, -1, -2) @ inverse_inertia @ transposed
    return inverse_mass[..., None, None] * np.eye(3) + turning


@domain
def friction_impulse(
    velocity: Vector,
    normal: Unit,
    inverse_mass: InverseMass,
    restitution: Share,
    friction: FiniteNotNegative,
) -> Array:
    """Impulse on body A at a contact with friction; −J acts on body B.

    Along the normal the points rebound by Newton's rule. The contact grips if
    friction can stop the slip; otherwise it slips.

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
        Zero where the bodies do not approach.

    Raises
    ------
    ValueError
        If K cannot be inverted: the K of two immovable bodies, or of one that
        only turns about a pivot and one that is immovable.

    Notes
    -----
    Let u_n = u·n be the velocity along the normal, below zero while the points
    approach.

    1. Grip: try the impulse that stops the slip and reverses the approach as
       Newton's rule says. The velocity after it is −e u_n n, so that

           K J = −u − e u_n n

    2. If this impulse lies within the cone of friction, it is the answer:

           ‖J_t‖ ≤ μ J·n

    3. Slip: otherwise the impulse lies on the cone, in the direction d of the
       grip's J_t, and Newton's rule along the normal gives its size j:

           J = j (n + μ d)
           j n·K(n + μ d) = −(1 + e) u_n

       There is always an answer, because the grip's J has one, and so has n
       alone.

    For a sphere, d is opposed to the slip. In the plane, d is always opposed
    to the slip that is left. In space, with a K that couples the directions,
    it is only near that: for bodies of random shape it is 6° off in the median
    and 68° at worst.

    The impact is one instant, and a slip that stops and turns round within it
    is not followed. The energy may therefore rise, as it may wherever Newton's
    restitution meets Coulomb's friction (see `impact_energy`). It does so in
    about one of a thousand random impacts of two bodies of random shape, at
    worst by more energy than the contact had. In exchange the points always
    part at e times the speed of their approach, and friction opposes the slip
    that is left, as nearly as said above. `dissipative_impulse` gives up the
    second, and `poisson_impulse` and `stronge_impulse` give up the first: none
    of the three adds energy.
    """
    k = inverse_mass  # the matrix K
    n, e, mu = normal, restitution, friction
    approach = np.vecdot(velocity, n)
    grip_change = -velocity - (e * approach)[..., None] * n
    grip = np.linalg.solve(k, grip_change[..., None])[..., 0]
    grip_tangent = part_across(grip, n)  # J_t
    tangent_size = np.linalg.norm(grip_tangent, axis=-1)
    grips = tangent_size <= mu * np.vecdot(grip, n)
    # n + μ d, an impulse on the cone
    on_cone = n + quotient(
        mu[..., None] * grip_tangent, tangent_size[..., None]
    )
    gain = np.vecdot(n, np.matvec(k, on_cone))
    j = quotient(-(1 + e) * approach, gain)  # gain > 0 where it slips
    impulse = np.where(grips[..., None], grip, j[..., None] * on_cone)
    return np.where((approach < 0)[..., None], impulse, 0.0)


@domain
def impact_energy(
    velocity: Triple,
    impulse: Triple,
    inverse_mass: Matrix,
) -> Array:
    """Energy that an impulse adds to two bodies.

    It is never above zero in an honest impact.

    Parameters
    ----------
    velocity : (..., 3), u, of the two points before the impact, m/s
    impulse : (..., 3), J, N s
    inverse_mass : (..., 3, 3), K, 1/kg

    Returns
    -------
    (...), J

    Notes
    -----
    The work of an impulse is the impulse times the mean of the velocities
    before and after it, which are u and u + K J:

        J·(u + K J/2)
    """
    mean_velocity = velocity + np.matvec(inverse_mass, impulse) / 2
    return np.vecdot(impulse, mean_velocity)


@domain
def sphere_impact(
    velocity: Vector,
    angular_velocity: Vector,
    normal: Unit,
    radius: FinitePositive,
    restitution: Share,
    friction: FiniteNotNegative,
    inertia_share: FinitePositive = 0.4,
) -> tuple[Array, Array]:
    """Velocities of a sphere after it has struck a plane with friction.

    The plane is immovable. Friction turns spin into motion along the plane and
    back.

    Parameters
    ----------
    velocity, angular_velocity : (..., 3), v and ω, m/s and rad/s
    normal : (..., 3), n, unit, out of the plane
    radius : (...), R, m, positive
    restitution, friction : (...), e, 0 to 1, and μ, not negative
    inertia_share : (...), I/(m R²), positive
        2/5 for a solid sphere, 2/3 for a hollow one.

    Returns
    -------
    velocity, angular_velocity : (..., 3), m/s and rad/s

    Notes
    -----
    The arm from the centre to the contact is r = −R n. The impulse and the
    inertia are both proportional to the mass, so that the mass drops out.
    """
    arm = -radius[..., None] * normal
    inertia = (inertia_share * radius**2)[..., None]  # per mass
    k = point_inverse_mass(1.0, np.eye(3) / inertia[..., None], arm)
    u = velocity + np.cross(angular_velocity, arm)
    impulse = friction_impulse(u, normal, k, restitution, friction)
    spin = angular_velocity + np.cross(arm, impulse) / inertia
    return velocity + impulse, spin


def positive_definite(name: str, value: Array) -> Array:
    """Return matrices K; refuse one with which no impulse stops the bodies."""
    lengths = np.linalg.norm(value, axis=-1).prod(axis=-1)
    singular = np.linalg.det(value) <= SINGULAR * lengths
    pulls = np.any(np.diagonal(value, axis1=-2, axis2=-1) <= 0, axis=-1)
    rule = "must be positive definite: no impulse stops two immovable bodies"
    require(~(singular | pulls), f"{name} {rule}")
    return value


InverseMass = Annotated[Array, matrix, positive_definite]
"""K, (..., 3, 3), positive definite, so that an impulse can be solved for."""
