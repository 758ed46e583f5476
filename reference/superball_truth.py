"""A ball that strikes a rough wall in space: the impact in closed form, and the impact of a superball."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array

SOLID = 2 / 5
"""Moment of inertia of a solid ball, as a share of m r²."""


def ball_after_impact(
    velocity: Array,
    surface: Array,
    normal: Array,
    restitution: float,
    friction: float,
    turned_back: float = 0.0,
) -> tuple[Array, Array]:
    """Velocity and r ω of a solid ball after an impact on a fixed wall, (3,) each, m/s.

    velocity: before, (3,), m/s. surface: r ω before, (3,), m/s. normal: unit, from the wall to the ball. turned_back:
    share of the slip that comes back reversed; 0 with Coulomb's friction, which ends it at most.

    The arm from the centre to the wall is −r n, so the slip is w = v_t + n × (−r ω) = v_t − (r ω) × n up to its sign
    along n; an impulse J along the wall changes v by J/m and r ω by −n × J/(2/5 m). So the slip changes by
    (1 + 5/2) J/m, whatever the direction: J = −2/7 (1 + e_t) m w ends it, or turns it back. Coulomb allows no more than
    μ (1 + e) m v_n, and then J opposes the slip, whose direction stays.
    """
    closing = -float(velocity @ normal)
    slip = velocity + closing * normal - np.cross(surface, normal)
    wanted = -(1 + turned_back) / (1 + 1 / SOLID) * slip
    size, most = float(np.linalg.norm(wanted)), friction * (1 + restitution) * closing
    along = wanted * (most / size) if size > most else wanted
    after = velocity + (1 + restitution) * closing * normal + along
    return after, surface - np.cross(normal, along) / SOLID


def between_walls(
    velocity: Array,
    surface: Array,
    normals: tuple[Array, ...],
    restitutions: tuple[float, ...],
    friction: float,
    turned_back: float = 0.0,
) -> list[tuple[Array, Array]]:
    """Velocity and r ω after each of some impacts on walls with these normals, without weight between them."""
    found = []
    for normal, restitution in zip(normals, restitutions, strict=True):
        velocity, surface = ball_after_impact(velocity, surface, normal, restitution, friction, turned_back)
        found.append((velocity, surface))
    return found
