"""Motion of one body relative to the other (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, in_space, not_negative, unit, vector


def extent(name: str, value: ArrayLike) -> Array:
    """Return lengths.

    Raises
    ------
    ValueError
        If one is negative or not finite.
    """
    return finite(name, not_negative(name, value))


def within(time: Array, dt: ArrayLike) -> Array:
    """Return the time, or infinity where it is later than dt, the step's end.

    The step may be infinitely long.
    """
    return np.where(time <= not_negative("dt", dt), time, np.inf)


def relative_motion(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
) -> tuple[Array, Array]:
    """Motion of A as seen from B (slide 10).

    The slide says: "compute the motion of one object relative to the other".

    Parameters
    ----------
    position_a, position_b : (..., 3), m
    velocity_a, velocity_b : (..., 3), m/s

    Returns
    -------
    position : (..., 3), x, from B to A, m
    velocity : (..., 3), u, of A relative to B, m/s

    Raises
    ------
    ValueError
        If a vector is not finite or not of three components.

    Notes
    -----
    The motion of A minus the motion of B is

        x = p_A − p_B,    u = ṗ_A − ṗ_B

    Someone who rides on B without turning sees B at rest at the origin, and
    sees only A move. Only the difference of the velocities matters. So a wind
    that carries both bodies changes no time of impact.
    """
    p_a = in_space("position_a", position_a)
    p_b = in_space("position_b", position_b)
    v_a = in_space("velocity_a", velocity_a)
    v_b = in_space("velocity_b", velocity_b)
    return p_a - p_b, v_a - v_b


def rotated(point: ArrayLike, rotation: ArrayLike) -> Array:
    """Turn a vector about an axis through the origin (Rodrigues).

    Parameters
    ----------
    point : (..., 3), p
    rotation : (..., 3), w, along the axis and as long as the angle in rad
        After a time t at the angular velocity ω it is ω t.

    Returns
    -------
    (..., 3)
        A rotation of 0 leaves the vector as it is.

    Raises
    ------
    ValueError
        If a vector is not finite or not of three components.

    Notes
    -----
    With the angle θ = ‖w‖, the result is

        p' = p cos θ + (w × p) sin θ/θ + w (w·p) (1 − cos θ)/θ²

    Split p into a part along the axis, w (w·p)/θ², and a part across it. The
    part along the axis stays as it is. The part across it turns in a plane, in
    which (w × p)/θ is the same part turned by a right angle. After a turn by θ
    it is cos θ times itself plus sin θ times that. The sum of the two parts is
    the formula. As θ goes to 0, the two quotients go to 1 and ½, and the
    function uses these limits.
    """
    p, w = in_space("point", point), in_space("rotation", rotation)
    angle = np.linalg.norm(w, axis=-1)[..., None]
    sine = np.sinc(angle / np.pi)  # sin θ/θ, 1 at 0
    rest = np.sinc(angle / (2 * np.pi)) ** 2 / 2  # (1 − cos θ)/θ², ½ at 0
    return np.asarray(
        p * np.cos(angle)
        + np.cross(w, p) * sine
        + w * np.vecdot(w, p)[..., None] * rest
    )


def motion_bound(
    velocity: ArrayLike,
    angular_velocity: ArrayLike,
    reach: ArrayLike,
    normal: ArrayLike,
) -> Array:
    """Fastest that any point of a body can ever move along a fixed direction.

    Parameters
    ----------
    velocity : (..., 3), v, of the point about which the body turns, m/s
    angular_velocity : (..., 3), ω, rad/s
    reach : (...), r_max, from that point to the body's farthest one, m
    normal : (..., 3), n, the direction, of unit length

    Returns
    -------
    (...), m/s
        The smallest number that no point within the reach exceeds at any
        time, as long as v and ω are constant. It is negative for a body all
        of whose points move backwards.

    Raises
    ------
    ValueError
        If reach is negative, a normal does not have length 1, or a vector is
        not finite or not of three components.

    Notes
    -----
    A point at r from the point about which the body turns has the velocity v +
    ω × r. Its part along n is

        n·(v + ω × r) = n·v + (n × ω)·r ≤ n·v + ‖n × ω‖ r_max

    The equality swaps the factors of a triple product. The inequality holds
    because a dot product is at most the product of the two lengths. While the
    body turns, r changes its direction but not its length, and so the bound
    holds at all times.

    This bound is what is left of the swept volume of a body that turns. The
    true shape of that volume is known only for simple motion.
    """
    v = in_space("velocity", velocity)
    w = in_space("angular_velocity", angular_velocity)
    n = unit("normal", vector("normal", normal))
    across = np.linalg.norm(np.cross(n, w), axis=-1)
    turning = across * not_negative("reach", reach)
    return np.asarray(np.vecdot(n, v) + turning)
