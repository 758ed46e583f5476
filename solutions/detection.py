"""Detecting a collision: where a point stands, when it meets a plane, and what a step may miss (slides 2, 4, 5, 9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive, vector

Array = NDArray[np.float64]


def signed_distance(point: ArrayLike, normal: ArrayLike, offset: ArrayLike) -> Array:
    """Distance of a point from the plane n·p + d = 0, negative behind it (slide 4).

    The slide's a x + b y + c z + d is this distance only when ‖n‖ = 1; dividing by ‖n‖ makes it one for any n.

    Parameters
    ----------
    point : (..., 3), m
    normal : (..., 3), any length but zero
    offset : (...), d in n·p + d = 0; m when the normal has unit length

    Returns
    -------
    (...), m

    Raises
    ------
    ValueError
        If a normal is zero: a plane without a direction has no sides. If a point or a normal has not three components.
    """
    point, normal = vector("point", point), vector("normal", normal)
    length = np.linalg.norm(normal, axis=-1)
    if np.any(length == 0):
        raise ValueError("normal is zero: the plane has no direction")
    return np.asarray((np.vecdot(normal, point) + offset) / length)


def is_colliding(separation: ArrayLike, tolerance: ArrayLike = 0.0) -> NDArray[np.bool_]:
    """Whether a point is on the wrong side of the plane by more than a tolerance (slide 4).

    Parameters
    ----------
    separation : (...), signed distance, m
    tolerance : (...), m, not negative; with 0 a point exactly on the plane is not colliding, as on the slide

    Returns
    -------
    (...), bool

    Raises
    ------
    ValueError
        If a separation is not finite (a NaN would pass for free), or a tolerance is negative.
    """
    return np.asarray(finite("separation", separation) < -not_negative("tolerance", tolerance))


def time_of_impact_interpolated(separation_0: ArrayLike, separation_1: ArrayLike, t: ArrayLike, dt: ArrayLike) -> Array:
    """Time at which the separation reaches zero if it changes at a steady rate over the step (slide 5).

    The slide writes T = t + Δt d1/(d1 + d2) with magnitudes d1, d2. With signed distances d1 = s0 and d2 = −s1:

        T = t + Δt s0/(s0 − s1)

    Under gravity the true path is curved and T is early, by up to g Δt²/(8 v).

    Parameters
    ----------
    separation_0 : (...), m, at the start of the step, not negative; for a body left on the plane that rounding put
        just behind it, pass 0
    separation_1 : (...), m, at its end
    t : (...), s, start of the step
    dt : (...), s, its length

    Returns
    -------
    (...), s; infinity where the step does not end behind the plane. A point that starts on the plane and goes
    through has T = t. One that starts behind it met it in an earlier step: infinity.

    Raises
    ------
    ValueError
        If a separation or t is not finite, or dt is negative.
    """
    s0, s1 = finite("separation_0", separation_0), finite("separation_1", separation_1)
    t, dt = finite("t", t), not_negative("dt", dt)
    crosses = (s0 >= 0) & (s1 < 0)
    fraction = s0 / np.where(crosses, s0 - s1, 1.0)
    return np.where(crosses, t + dt * fraction, np.inf)


def time_of_impact_exact(separation: ArrayLike, normal_velocity: ArrayLike, normal_acceleration: ArrayLike) -> Array:
    """Time until the separation s + u t + a t²/2 next falls through zero, with a constant acceleration.

    The root is written so that no two nearly equal numbers are subtracted:

        t = (u + √(u² − 2 a s))/(−a)   when u ≥ 0 (a < 0: it rises, then falls)
        t = 2 s/(√(u² − 2 a s) − u)    when u < 0

    Parameters
    ----------
    separation : (...), s, m; a body on the plane or by rounding just behind it counts as on it
    normal_velocity : (...), u, m/s, positive when moving away
    normal_acceleration : (...), a, m/s², negative towards the plane

    Returns
    -------
    (...), s from now; infinity where the body never comes down to the plane. A body on the plane that moves away
    gets the time of its return, one that moves in gets 0, and so does one that lies there and is pressed on. One that
    turns round just on the plane touches it; within rounding of that, rounding decides.

    Raises
    ------
    ValueError
        If an argument is not finite.
    """
    s = np.maximum(finite("separation", separation), 0.0)
    u, a = finite("normal_velocity", normal_velocity), finite("normal_acceleration", normal_acceleration)
    discriminant = u * u - 2 * a * s
    root = np.sqrt(np.maximum(discriminant, 0.0))
    rising = u >= 0
    denominator = np.where(rising, -a, root - u)
    arrives = (discriminant >= 0) & (denominator > 0)
    return np.where(arrives, np.where(rising, u + root, 2 * s) / np.where(arrives, denominator, 1.0), np.inf)


def side_of_plane(separation: ArrayLike, tolerance: ArrayLike = 0.0) -> NDArray[np.int64]:
    """On which side of the plane a point stands: +1 in front, 0 on it, −1 behind it (slide 4).

    The slide knows two sides, and its strict < puts a point that touches among those in front.

    Parameters
    ----------
    separation : (...), signed distance, m
    tolerance : (...), m, not negative; up to and with this distance, on either side, a point is on the plane

    Returns
    -------
    (...), 1, 0 or −1

    Raises
    ------
    ValueError
        If a separation is not finite, or a tolerance is negative.
    """
    s, tolerance = finite("separation", separation), not_negative("tolerance", tolerance)
    return np.asarray((s > tolerance).astype(np.int64) - (s < -tolerance))


def overlap_interval(
    distance: ArrayLike, normal_velocity: ArrayLike, radius: ArrayLike, thickness: ArrayLike, dt: ArrayLike
) -> tuple[Array, Array]:
    """When within a step a ball overlaps a slab: the continuous test of slide 2, at constant velocity.

    The centre x + u t of the ball meets the slab while it is between r before its front face and r behind its back:

        −(w + r) ≤ x + u t ≤ r,  0 ≤ t ≤ Δt

    A test at the ends of the step sees two instants of this interval, or none. Touching counts: the interval is closed.

    Parameters
    ----------
    distance : (...), x, of the centre from the slab's front face, m, positive before it
    normal_velocity : (...), u, of the ball relative to the slab, m/s, along the normal of the front face
    radius : (...), r, m; 0 for a point
    thickness : (...), w, m; infinity for the half-space behind a plane, 0 for a sheet
    dt : (...), s, length of the step

    Returns
    -------
    start, end : (...), s from now, 0 ≤ start ≤ end ≤ Δt; infinity and −infinity, an empty interval, where they do not
    meet. A ball that overlaps already starts at 0. At equal velocities, or along the slab, it is all of the step or
    nothing. One that only touches, at the step's first or last instant, has start = end.

    Raises
    ------
    ValueError
        If distance or normal_velocity is not finite, or radius, thickness or dt is negative.
    """
    x, u = finite("distance", distance), finite("normal_velocity", normal_velocity)
    r, w, dt = not_negative("radius", radius), not_negative("thickness", thickness), not_negative("dt", dt)
    moves = u != 0
    with np.errstate(over="ignore"):  # at a crawl it gets there after any number of seconds: infinity will do
        at_front, at_back = (r - x) / np.where(moves, u, 1.0), (-(w + r) - x) / np.where(moves, u, 1.0)
    inside = (-(w + r) <= x) & (x <= r)
    first = np.where(moves, np.minimum(at_front, at_back), 0.0)
    last = np.where(moves, np.maximum(at_front, at_back), np.where(inside, np.inf, -np.inf))
    start, end = np.maximum(first, 0.0), np.minimum(last, dt)
    meets = start <= end
    return np.where(meets, start, np.inf), np.where(meets, end, -np.inf)


def missing_probability(speed: ArrayLike, thickness: ArrayLike, radius: ArrayLike, dt: ArrayLike) -> Array:
    """Share of the balls that a test at each step misses: temporal aliasing (slide 9).

    A ball overlaps the wall on a way of w + 2r and moves v Δt between two tests. With the phase left to chance

        P = max(0, 1 − (w + 2r)/(v Δt))

    This is what a test for overlap does not notice. How much of what it notices an engine turns back is another matter.

    Parameters
    ----------
    speed : (...), v, along the normal of the wall, m/s
    thickness, radius : (...), w and r, m
    dt : (...), s, between two tests

    Returns
    -------
    (...), 0 to 1; 0 for a ball that does not move: it cannot pass. 1 for a moving point against a sheet.

    Raises
    ------
    ValueError
        If an argument is negative, or speed or dt is not finite.
    """
    way = finite("speed", not_negative("speed", speed)) * finite("dt", not_negative("dt", dt))
    caught = not_negative("thickness", thickness) + 2 * not_negative("radius", radius)
    return np.asarray(np.where(way > caught, 1 - caught / np.where(way > 0, way, 1.0), 0.0))


def substeps_needed(speed: ArrayLike, thickness: ArrayLike, radius: ArrayLike, dt: ArrayLike) -> NDArray[np.int64]:
    """Into how many equal parts to cut a step so that no part can carry a ball past a wall unnoticed (slide 9).

    The smallest n with v Δt/n < w + 2r: so some part ends while they overlap, and by more than a touch.

    Parameters
    ----------
    speed : (...), v, along the normal of the wall, m/s
    thickness, radius : (...), w and r, m
    dt : (...), s, length of the whole step

    Returns
    -------
    (...), at least 1

    Raises
    ------
    ValueError
        If an argument is negative, speed or dt is not finite, or w + 2r is zero: no number of tests catches a point on
        a sheet.
    """
    way = finite("speed", not_negative("speed", speed)) * finite("dt", not_negative("dt", dt))
    caught = not_negative("thickness", thickness) + 2 * not_negative("radius", radius)
    return np.asarray(np.floor(way / positive("thickness + 2 radius", caught)) + 1).astype(np.int64)
