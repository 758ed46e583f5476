"""Penalty response: a spring and a damper at every contact (slide 8)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.response import (
    penalty_damping,
    penalty_force,
    tangential_spring,
)
from solutions.world.rows import Rows, after_impulses


def solve_with_springs(
    rows: Rows,
    velocity: Array,
    angular_velocity: Array,
    separation: Array,
    approach: Array,
    restitution: Array,
    friction: Array,
    start: Array,
    stiffness: float,
    dt: float,
) -> tuple[Array, Array, Array]:
    """Velocities after the forces of all contacts have acted over a step.

    Parameters
    ----------
    rows : of m contacts, with the tangents themselves, not decoupled
    velocity, angular_velocity : (n, 3), of all bodies, m/s and rad/s
        With what all other forces add in this step.
    separation : (m,), m; negative in overlap
    approach : (m, 3), speeds along normal and tangents before the step, m/s
        The first is negative where the points approach.
    restitution, friction : (m,), e and the kinetic μ
    start : (m, 3), what the last step returned as its springs' impulses, N s
    stiffness : k along the normal, N/m
    dt : s

    Returns
    -------
    velocity, angular_velocity : (n, 3)
    springs : (m, 3), Δt times the force of each spring along the surface, N s
        It tells the next step how far that spring is stretched.

    Notes
    -----
    **Along the normal** the force is `penalty_force`. Its damping c follows
    from e with the contact's own effective mass m = 1/K_nn, but c is at most
    critical, 2 √(k m). A contact that cannot pull then still has e = .135: a
    smaller e acts like this one. The restitution is right for one contact.
    A box on four springs is four times as stiff, and its steps must be half as
    long: see `penalty_step_limit`.

    **Along the surface** friction is the `tangential_spring` of Cundall and
    Strack, which slides at Coulomb's limit μ N. A box on a slope holds,
    because the spring is stretched until it carries the box; friction in
    proportion to the slip would let it creep. The spring swings as fast as
    that along the normal: k_t = k m_t/m, which is 2/7 k for a solid sphere.
    Its damping is half the critical one. Friction has one coefficient here,
    the kinetic one.

    The force depends on the positions and velocities at the beginning of the
    step. Nothing is corrected: the overlap is what makes the force.
    """
    normal, mass = rows.direction[:, 0], 1 / rows.softness[:, 0, 0]
    critical = 2 * np.sqrt(stiffness * mass)
    damping = penalty_damping(restitution, mass, stiffness)
    damping = np.minimum(damping, critical)
    press = penalty_force(
        separation, approach[:, 0], normal, stiffness, damping
    )
    across = 1 / np.linalg.eigvalsh(rows.softness[:, 1:, 1:])[:, 1]
    along = stiffness * across / mass
    slip = np.vecmat(approach[:, 1:], rows.direction[:, 1:])
    stretch = -np.vecmat(start, rows.direction) / (along * dt)[:, None]
    size = np.vecdot(press, normal)
    friction_force, stretch = tangential_spring(
        stretch,
        slip,
        normal,
        size,
        friction,
        along,
        np.sqrt(along * across),
        dt,
    )
    spring_force = -along[:, None] * stretch
    impulse = dt * np.matvec(rows.direction, press + friction_force)
    springs = dt * np.matvec(rows.direction, spring_force)
    return *after_impulses(rows, velocity, angular_velocity, impulse), springs
