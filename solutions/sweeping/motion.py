"""Motion of one body relative to the other (slide 10)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Unit, Vector, domain


@domain
def relative_motion(
    position_a: Vector,
    velocity_a: Vector,
    position_b: Vector,
    velocity_b: Vector,
) -> tuple[Array, Array]:
    """Motion of A as seen from B (slide 10).

    The slide says: "Compute motion of one relative to other".

    Parameters
    ----------
    position_a, position_b : (..., 3), m
    velocity_a, velocity_b : (..., 3), m/s

    Returns
    -------
    position : (..., 3), x, from B to A, m
    velocity : (..., 3), u, of A relative to B, m/s

    Notes
    -----
    The motion of A minus the motion of B is

        x = p_A − p_B
        u = ṗ_A − ṗ_B

    Someone who rides on B without turning sees B at rest at the origin, and
    sees only A move. Only the difference of the velocities matters. So a wind
    that carries both bodies changes no time of impact.
    """
    return position_a - position_b, velocity_a - velocity_b


@domain
def rotated(point: Vector, rotation: Vector) -> Array:
    """Turn a vector about an axis through the origin (Rodrigues).

    Parameters
    ----------
    point : (..., 3), p, the vector, in any unit
    rotation : (..., 3), w, along the axis and as long as the angle in rad
        After a time t at the angular velocity ω it is ω t.

    Returns
    -------
    (..., 3), in the same unit
        A rotation of 0 leaves the vector as it is.

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
    p, w = point, rotation
    angle = np.linalg.norm(w, axis=-1)[..., None]
    # The quotients are 1 and ½ at 0: sinc(x) is sin(πx)/(πx), and 1 at 0.
    sine_share = np.sinc(angle / np.pi)  # sin θ/θ
    cosine_share = np.sinc(angle / (2 * np.pi)) ** 2 / 2  # (1 − cos θ)/θ²
    axis_part = w * np.vecdot(w, p)[..., None]  # times θ²
    turned = p * np.cos(angle) + np.cross(w, p) * sine_share
    return turned + axis_part * cosine_share


@domain
def motion_bound(
    velocity: Vector,
    angular_velocity: Vector,
    reach: NotNegative,
    normal: Unit,
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

    Notes
    -----
    A point at r from the point about which the body turns has the velocity
    v + ω × r. Its part along n is

        n·(v + ω × r) = n·v + (n × ω)·r
                      ≤ n·v + ‖n × ω‖ r_max

    The equality swaps the factors of a triple product. The inequality holds
    because a dot product is at most the product of the two lengths. While the
    body turns, r changes its direction but not its length, and so the bound
    holds at all times.

    This bound is what is left of the swept volume of a body that turns. The
    true shape of that volume is known only for simple motion.
    """
    across = np.linalg.norm(np.cross(normal, angular_velocity), axis=-1)
    return np.vecdot(normal, velocity) + across * reach
