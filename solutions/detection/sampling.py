"""Detecting a collision with a plane (slides 2, 4, 5 and 9).

These functions say where a point is, when it meets a plane, and what a step may miss.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive, vector

Array = NDArray[np.float64]


def signed_distance(point: ArrayLike, normal: ArrayLike, offset: ArrayLike) -> Array:
    """Distance of a point from the plane n·p + d = 0, negative behind it (slide 4).

    The normal points to the front of the plane. It may have any length: the result is a
    distance in metres in any case.

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
        If a normal is zero: a plane without a direction has no sides. If a point or a
        normal does not have three components.

    Notes
    -----
    From the point, go the distance s against the unit normal n/‖n‖. You arrive on the
    plane if the new point satisfies the plane's equation:

        n·(p − s n/‖n‖) + d = 0

    Because n·n = ‖n‖², this is n·p − s ‖n‖ + d = 0, and so

        s = (n·p + d)/‖n‖

    The slide's a x + b y + c z + d is the numerator. It is the distance only when
    ‖n‖ = 1; the division by ‖n‖ makes it one for every n.
    """
    point, normal = vector("point", point), vector("normal", normal)
    length = np.linalg.norm(normal, axis=-1)
    if np.any(length == 0):
        raise ValueError("normal is zero: the plane has no direction")
    return np.asarray((np.vecdot(normal, point) + offset) / length)


def is_colliding(
    separation: ArrayLike,
    tolerance: ArrayLike = 0.0,
) -> NDArray[np.bool_]:
    """Whether a point is behind the plane by more than a tolerance (slide 4).

    Parameters
    ----------
    separation : (...), signed distance, m
    tolerance : (...), m, not negative
        With 0 a point exactly on the plane is not colliding, as on the slide.

    Returns
    -------
    (...), bool

    Raises
    ------
    ValueError
        If a separation is not finite (a NaN would never collide), or a tolerance is
        negative.
    """
    return np.asarray(finite("separation", separation) < -not_negative("tolerance", tolerance))


def time_of_impact_interpolated(
    separation_0: ArrayLike,
    separation_1: ArrayLike,
    t: ArrayLike,
    dt: ArrayLike,
) -> Array:
    """Time at which a separation that changes at a steady rate is zero (slide 5).

    Parameters
    ----------
    separation_0 : (...), m, at the start of the step, not negative
        For a body that was left on the plane and that rounding put just behind it, pass
        0.
    separation_1 : (...), m, at the end of the step
    t : (...), s, start of the step
    dt : (...), s, length of the step

    Returns
    -------
    (...), s
        Infinity where the step does not end behind the plane. A point that starts on
        the plane and goes through it has T = t. A point that starts behind the plane
        met it in an earlier step and gets infinity.

    Raises
    ------
    ValueError
        If a separation or t is not finite, or dt is negative.

    Notes
    -----
    At a steady rate, the separation at a time τ after the start of the step is
    s0 + (s1 − s0) τ/Δt. It is zero at τ = Δt s0/(s0 − s1), so that

        T = t + Δt s0/(s0 − s1)

    The slide writes T = t + Δt d1/(d1 + d2) with the magnitudes d1 and d2. With signed
    distances, d1 = s0 and d2 = −s1, which gives the same formula.

    Under gravity the true path is a parabola, and the straight line between its two
    ends lies below it by up to g Δt²/8. The line therefore meets the plane too early: T
    is early by up to g Δt²/(8 v), where v is the speed at which the body arrives.
    """
    s0, s1 = finite("separation_0", separation_0), finite("separation_1", separation_1)
    t, dt = finite("t", t), not_negative("dt", dt)
    crosses = (s0 >= 0) & (s1 < 0)
    fraction = s0 / np.where(crosses, s0 - s1, 1.0)
    return np.where(crosses, t + dt * fraction, np.inf)


def time_of_impact_exact(
    separation: ArrayLike,
    normal_velocity: ArrayLike,
    normal_acceleration: ArrayLike,
) -> Array:
    """Time until a separation with constant acceleration next falls through zero.

    The separation is s + u t + a t²/2, with t counted from now.

    Parameters
    ----------
    separation : (...), s, m
        A body on the plane, or by rounding just behind it, counts as on it.
    normal_velocity : (...), u, m/s, positive when moving away
    normal_acceleration : (...), a, m/s², negative towards the plane

    Returns
    -------
    (...), s from now
        Infinity where the body never comes down to the plane. A body on the plane that
        moves away gets the time of its return. A body on the plane that moves in gets
        0, and so does one that lies there and is pressed on. A body that turns round
        exactly on the plane touches it; within rounding of this case, rounding decides.

    Raises
    ------
    ValueError
        If an argument is not finite.

    Notes
    -----
    At each root of s + u t + a t²/2 = 0 the velocity u + a t is +√(u² − 2 a s) or
    −√(u² − 2 a s). A body that falls through zero moves in, so that the minus sign
    holds:

        u + a t = −√(u² − 2 a s)

    When u ≥ 0 the body rises first, and only a < 0 brings it back. Solving for t gives

        t = (u + √(u² − 2 a s))/(−a)

    When u < 0, u and the root have opposite signs, and their sum would lose digits
    where they are nearly equal. Multiply the numerator and the denominator by
    √(u² − 2 a s) − u; the numerator becomes −2 a s, and

        t = 2 s/(√(u² − 2 a s) − u)

    In both forms no two nearly equal numbers are subtracted outside the root.
    """
    s = np.maximum(finite("separation", separation), 0.0)
    u, a = finite("normal_velocity", normal_velocity), finite("normal_acceleration", normal_acceleration)
    discriminant = u * u - 2 * a * s
    root = np.sqrt(np.maximum(discriminant, 0.0))
    rising = u >= 0
    denominator = np.where(rising, -a, root - u)
    arrives = (discriminant >= 0) & (denominator > 0)
    return np.where(arrives, np.where(rising, u + root, 2 * s) / np.where(arrives, denominator, 1.0), np.inf)


def side_of_plane(
    separation: ArrayLike,
    tolerance: ArrayLike = 0.0,
) -> NDArray[np.int64]:
    """Side of a plane on which a point is: 1 in front, 0 on it, −1 behind (slide 4).

    Parameters
    ----------
    separation : (...), signed distance, m
    tolerance : (...), m, not negative
        A point is on the plane up to and including this distance, on either side.

    Returns
    -------
    (...), 1, 0 or −1

    Raises
    ------
    ValueError
        If a separation is not finite, or a tolerance is negative.

    Notes
    -----
    The slide knows two sides, and its strict < puts a point that touches the plane
    among those in front.
    """
    s, tolerance = finite("separation", separation), not_negative("tolerance", tolerance)
    return np.asarray((s > tolerance).astype(np.int64) - (s < -tolerance))


def overlap_interval(
    distance: ArrayLike,
    normal_velocity: ArrayLike,
    radius: ArrayLike,
    thickness: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """When within a step a ball overlaps a slab: the continuous test (slide 2).

    The ball moves at constant velocity. Touching counts as overlapping, so that the
    interval includes both of its ends.

    Parameters
    ----------
    distance : (...), x, of the centre from the slab's front face, m, positive before it
    normal_velocity : (...), u, m/s
        Velocity of the ball relative to the slab, along the normal of the front face.
    radius : (...), r, m; 0 for a point
    thickness : (...), w, m
        Infinity for the half-space behind a plane, 0 for a sheet.
    dt : (...), s, length of the step

    Returns
    -------
    start, end : (...), s from now, 0 ≤ start ≤ end ≤ Δt
        Infinity and −infinity, an empty interval, where the ball and the slab do not
        meet. A ball that overlaps already starts at 0. A ball that moves with the slab
        or along it overlaps for the whole step or not at all. A ball that only touches,
        at the first or the last instant of the step, has start = end.

    Raises
    ------
    ValueError
        If distance or normal_velocity is not finite, or radius, thickness or dt is
        negative.

    Notes
    -----
    At time t the centre is at x + u t. The ball overlaps the slab while the centre is
    at most r before the front face and at most r behind the back face, which is at −w:

        −(w + r) ≤ x + u t ≤ r,  0 ≤ t ≤ Δt

    A test at the ends of the step sees two instants of this interval, or none of it.
    """
    x, u = finite("distance", distance), finite("normal_velocity", normal_velocity)
    r, w, dt = not_negative("radius", radius), not_negative("thickness", thickness), not_negative("dt", dt)
    moves = u != 0
    # A ball that crawls needs more seconds than a float holds: infinity is right.
    with np.errstate(over="ignore"):
        at_front, at_back = (r - x) / np.where(moves, u, 1.0), (-(w + r) - x) / np.where(moves, u, 1.0)
    inside = (-(w + r) <= x) & (x <= r)
    first = np.where(moves, np.minimum(at_front, at_back), 0.0)
    last = np.where(moves, np.maximum(at_front, at_back), np.where(inside, np.inf, -np.inf))
    start, end = np.maximum(first, 0.0), np.minimum(last, dt)
    meets = start <= end
    return np.where(meets, start, np.inf), np.where(meets, end, -np.inf)


def missing_probability(
    speed: ArrayLike,
    thickness: ArrayLike,
    radius: ArrayLike,
    dt: ArrayLike,
) -> Array:
    """Share of the balls that a test at each step misses: temporal aliasing (slide 9).

    Every phase of the tests is equally likely.

    Parameters
    ----------
    speed : (...), v, along the normal of the wall, m/s
    thickness, radius : (...), w and r, m
    dt : (...), s, between two tests

    Returns
    -------
    (...), 0 to 1
        0 for a ball that does not move, because it cannot pass the wall. 1 for a moving
        point against a sheet.

    Raises
    ------
    ValueError
        If an argument is negative, or speed or dt is not finite.

    Notes
    -----
    A ball overlaps the wall while its centre travels a distance of w + 2r, and it moves
    v Δt between two tests. As every phase of the tests is equally likely, a test falls
    within the overlap with the probability (w + 2r)/(v Δt), and certainly where this
    ratio exceeds
    1. The share that is missed is

        P = max(0, 1 − (w + 2r)/(v Δt))

    These are the balls whose overlap no test notices. How many of the noticed balls an
    engine then turns back is a different question.
    """
    way = finite("speed", not_negative("speed", speed)) * finite("dt", not_negative("dt", dt))
    caught = not_negative("thickness", thickness) + 2 * not_negative("radius", radius)
    return np.asarray(np.where(way > caught, 1 - caught / np.where(way > 0, way, 1.0), 0.0))


def substeps_needed(
    speed: ArrayLike,
    thickness: ArrayLike,
    radius: ArrayLike,
    dt: ArrayLike,
) -> NDArray[np.int64]:
    """Smallest number of equal substeps that lets no ball pass unseen (slide 9).

    Parameters
    ----------
    speed : (...), v, along the normal of the wall, m/s
    thickness, radius : (...), w and r, m
    dt : (...), s, length of the whole step

    Returns
    -------
    (...), at least 1
        Each substep is shorter than w + 2r; a test at the end of a substep of exactly
        this length might find a mere touch.

    Raises
    ------
    ValueError
        If an argument is negative, speed or dt is not finite, or w + 2r is zero: no
        number of tests catches a point on a sheet.

    Notes
    -----
    The result is the smallest whole number n with

        v Δt/n < w + 2r

    Each substep is then shorter than the distance over which ball and wall overlap. At
    least one substep therefore ends while they overlap, and by more than a touch.
    """
    way = finite("speed", not_negative("speed", speed)) * finite("dt", not_negative("dt", dt))
    caught = not_negative("thickness", thickness) + 2 * not_negative("radius", radius)
    return np.asarray(np.floor(way / positive("thickness + 2 radius", caught)) + 1).astype(np.int64)
