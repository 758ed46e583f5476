"""The motion of one body relative to the other: the first of the slide's three tasks (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, unit, vector

Array = NDArray[np.float64]


def in_space(name: str, value: ArrayLike) -> Array:
    """Return vectors (..., 3); refuse what is not finite or has not three components."""
    return finite(name, vector(name, value))


def extent(name: str, value: ArrayLike) -> Array:
    """Return lengths; refuse negative and infinite ones."""
    return finite(name, not_negative(name, value))


def within(time: Array, dt: ArrayLike) -> Array:
    """Return the time, or infinity where it is later than the step's end dt, which may be infinity."""
    return np.where(time <= not_negative("dt", dt), time, np.inf)


def relative_motion(
    position_a: ArrayLike, velocity_a: ArrayLike, position_b: ArrayLike, velocity_b: ArrayLike
) -> tuple[Array, Array]:
    """Motion of A as seen from B: "compute the motion of one object relative to the other" (slide 10).

        x = p_A − p_B,  u = ṗ_A − ṗ_B

    Whoever rides on B without turning sees B at rest in the origin and A move alone. Only the difference of the
    velocities matters: a wind that carries both changes no time of impact.

    Parameters
    ----------
    position_a, position_b : (..., 3), m
    velocity_a, velocity_b : (..., 3), m/s

    Returns
    -------
    position : (..., 3), x, m
    velocity : (..., 3), u, m/s

    Raises
    ------
    ValueError
        If a vector is not finite or not in space.
    """
    position = in_space("position_a", position_a) - in_space("position_b", position_b)
    velocity = in_space("velocity_a", velocity_a) - in_space("velocity_b", velocity_b)
    return position, velocity


def rotated(point: ArrayLike, rotation: ArrayLike) -> Array:
    """Turn a vector about an axis through the origin (Rodrigues).

        p' = p cos θ + (w × p) sin θ/θ + w (w·p) (1 − cos θ)/θ²,  θ = ‖w‖

    Parameters
    ----------
    point : (..., 3), p
    rotation : (..., 3), w: along the axis, as long as the angle in rad; after a time t it is ω t. 0 turns nothing

    Returns
    -------
    (..., 3)

    Raises
    ------
    ValueError
        If a vector is not finite or not in space.
    """
    p, w = in_space("point", point), in_space("rotation", rotation)
    angle = np.linalg.norm(w, axis=-1, keepdims=True)
    sine = np.sinc(angle / np.pi)  # sin θ/θ, 1 at 0
    rest = np.sinc(angle / (2 * np.pi)) ** 2 / 2  # (1 − cos θ)/θ², ½ at 0
    return np.asarray(p * np.cos(angle) + np.cross(w, p) * sine + w * np.vecdot(w, p)[..., None] * rest)


def motion_bound(velocity: ArrayLike, angular_velocity: ArrayLike, reach: ArrayLike, normal: ArrayLike) -> Array:
    """Fastest that any point of a body can ever move along a fixed direction.

        n·(v + ω × r) ≤ n·v + ‖n × ω‖ r_max

    While the body turns, ‖r‖ stays as it is: so the bound holds for all times, as long as v and ω are constant. This
    is what is left of the swept volume of a body that turns: its true shape is known for simple motion alone.

    Parameters
    ----------
    velocity : (..., 3), v, of the point about which it turns, m/s
    angular_velocity : (..., 3), ω, rad/s
    reach : (...), r_max, from that point to the body's farthest one, m
    normal : (..., 3), n, of unit length

    Returns
    -------
    (...), m/s; negative for a body of which all points move backwards

    Raises
    ------
    ValueError
        If reach is negative, a normal has not length 1, or a vector is not finite or not in space.
    """
    v, w = in_space("velocity", velocity), in_space("angular_velocity", angular_velocity)
    n = unit("normal", vector("normal", normal))
    turning = np.linalg.norm(np.cross(n, w), axis=-1) * not_negative("reach", reach)
    return np.asarray(np.vecdot(n, v) + turning)
