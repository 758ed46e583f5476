"""Closed forms of dry friction beside those of `truth`, each with its derivation: break-away, and other cones.

Symbols: μ friction, m mass, g gravity, R rate at which a push grows, φ heading, from the x axis of the ground; SI, and
angles in rad. A cone says which friction forces a level plane can make: Coulomb's is a circle of radius μ m g. Two
approximations of it lie along the axes of the ground: a diamond, |f_x| + |f_y| ≤ μ m g, and a square, |f_x| and |f_y| ≤
μ m g. Friction is the force of the cone that takes most energy from the slip.
"""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array

CIRCLE, DIAMOND, SQUARE = "circle", "diamond", "square"
ALONG_AN_AXIS = 1e-12
"""Sine of an angle to an axis that is none."""
ROUNDS = 20
"""Rounds in which an impedance and the overlap that depends on it settle; each gains two digits."""


def least_push(cone: str, heading: float) -> float:
    """The push at which a body breaks away, over μ m g: where a ray with this heading leaves the cone."""
    x, y = abs(math.cos(heading)), abs(math.sin(heading))
    return {CIRCLE: 1.0, DIAMOND: 1 / (x + y), SQUARE: 1 / max(x, y)}[cone]


def moving_share(cone: str, heading: float) -> float:
    """Share of the growth of a push with a heading that a slip has for itself, once it has begun.

    Friction on a circle is constant. Off the axes, a diamond lets the body go along the diagonal, and a square along
    the nearer axis: what is left of the push is its part in that direction, and the rest is held.
    """
    x, y = abs(math.cos(heading)), abs(math.sin(heading))
    if min(x, y) < ALONG_AN_AXIS:
        return 1.0
    return {CIRCLE: 1.0, DIAMOND: (x + y) / math.sqrt(2), SQUARE: max(x, y)}[cone]


def way_after_break_away(
    static: float, kinetic: float, mass: float, gravity: float, rate: float, duration: float
) -> float:
    """Way, m, that a body slides along a push R t, in a time from its break-away on, s.

    It breaks away as R t = μ_s m g. With τ from there, m a = R t − μ_k m g = (μ_s − μ_k) m g + R τ, so that the way is
    (μ_s − μ_k) g τ²/2 + R τ³/(6 m).
    """
    tau = max(duration, 0.0)
    return (static - kinetic) * gravity * tau**2 / 2 + rate * tau**3 / (6 * mass)


def end_of_pushed_way(
    cone: str, friction: float, mass: float, gravity: float, rate: float, heading: float, time: float
) -> tuple[float, float]:
    """Where a body is that a push R t with a heading from 0 to 90° has moved from rest, (x, y), m.

    Circle: along the push. Square: each axis has friction μ m g of its own, and breaks away when the push along it
    exceeds that. Diamond: every force of its side f_x + f_y = μ m g takes the same power from a slip along the diagonal
    of the axes; any other slip has one corner of the diamond against it, which turns it towards the diagonal. So the
    body goes along the diagonal, with m (a_x + a_y) = R t (cos φ + sin φ) − μ m g. Half of it along each axis means
    f_x − f_y = R t (cos φ − sin φ), which the side allows up to μ m g. Along an axis friction is the circle's.
    """
    limit, x, y = friction * mass * gravity, math.cos(heading), math.sin(heading)
    broken = least_push(cone, heading) * limit / rate
    if cone == SQUARE:
        ways = [
            way_after_break_away(0.0, 0.0, mass, gravity, rate * part, time - limit / (rate * part))
            if part > ALONG_AN_AXIS
            else 0.0
            for part in (x, y)
        ]
        return ways[0], ways[1]
    if cone == DIAMOND and min(x, y) > ALONG_AN_AXIS:
        if rate * time * abs(x - y) > limit:
            raise ValueError(f"by {time} s the push is so large that the body has left the diagonal")
        each = way_after_break_away(0.0, 0.0, mass, gravity, rate * (x + y) / 2, time - broken)
        return each, each
    way = way_after_break_away(0.0, 0.0, mass, gravity, rate, time - broken)
    return way * x, way * y


def end_of_slide(cone: str, speed: float, friction: float, gravity: float, heading: float) -> tuple[float, float]:
    """Where a body stops that was sent off from the origin with a heading from 0 to 90°, (x, y), m.

    D = v²/(2 μ g), c = cos φ, s = sin φ. Circle: friction opposes the velocity, and the way is D (c, s). Square: each
    axis is braked with μ g by itself, and the way is D (c², s²). Diamond: as long as one part of the velocity is the
    larger one, the corner of the diamond against it brakes this part alone, with μ g. From there on the body goes along
    the diagonal, each part braked with μ g/2. For c > s the larger part goes (c² − s²) D and then 2 s² D, together D;
    the other one 2 s (c − s) D and then 2 s² D, together 2 s c D. So the way is D (1, sin 2φ).
    """
    x, y = math.cos(heading), math.sin(heading)
    distance = speed**2 / (2 * friction * gravity)
    if cone == SQUARE:
        return distance * x**2, distance * y**2
    if cone == DIAMOND:
        return (distance, 2 * distance * x * y) if x >= y else (2 * distance * x * y, distance)
    return distance * x, distance * y


# Creep: friction as a soft constraint

LEAST_IMPEDANCE, MOST_IMPEDANCE, IMPEDANCE_WIDTH = 0.9, 0.95, 1e-3
"""MuJoCo's default `solimp`: the impedance d at no overlap, and at one of this width, m, and more."""
TIME_CONSTANT = 0.02
"""MuJoCo's default `solref`, s: a contact is a critically damped spring, b = 2/(d_max t_c) and k = 1/(d_max t_c)²."""


def creep_of_a_soft_pyramid(friction: float, pull: tuple[float, float], pressed: float) -> tuple[float, float]:
    """Velocity, m/s, along the two axes of a block that MuJoCo's default contacts should hold, on four corners.

    pull: along the axes of the plane, none below zero. pressed: into the plane. Both are forces over the mass, m/s².

    A corner's force is a sum of f_i ≥ 0 along the four edges n ± μ t_x, n ± μ t_y of a pyramid. MuJoCo lets each edge
    yield: J_i a + R f_i = −b J_i v − k d r, with R = 2 μ² (1 − d)/d (1 + μ²)/m. Here −r is the overlap, and J_i v the
    rate at the edge. A block that creeps evenly has a = 0. With c = −k d r/R and δ = b μ v_x/R the two edges along x
    have f = c ± δ, or 0 in place of what would pull. At each corner they carry a quarter of the load and of the pull, N
    and T:

        all push:            N = 4 c,       T_x = 2 μ δ,        v_x = R T_x/(2 μ² b)
        one along x is off:  N = 3 c + δ,   T_x = μ (c + δ),    c = (N − T_x/μ)/2, δ = T_x/μ − c

    So any pull makes the block creep, and the faster, the larger t_c is. d depends on r and so on c, which a few rounds
    settle.
    """
    load, (x, y) = pressed / 4, (each / 4 for each in pull)
    if x + y > friction * load:
        raise ValueError(f"a pull of {pull} m/s² is more than the corners of the pyramid hold")
    damping = 2 / (MOST_IMPEDANCE * TIME_CONSTANT)
    stiffness = 1 / (MOST_IMPEDANCE * TIME_CONSTANT) ** 2
    impedance, shares = LEAST_IMPEDANCE, [0.0, 0.0]
    for _ in range(ROUNDS):
        softness = 2 * friction**2 * (1 - impedance) / impedance * (1 + friction**2)
        each = load / 4
        larger = max(x, y)
        if larger > 2 * friction * each:
            each = (load - larger / friction) / 2
        shares = [part / friction - each if part > 2 * friction * each else part / (2 * friction) for part in (x, y)]
        depth = each * softness / (stiffness * impedance)
        impedance = LEAST_IMPEDANCE + (MOST_IMPEDANCE - LEAST_IMPEDANCE) * 2 * (depth / IMPEDANCE_WIDTH) ** 2
    speeds = [share * softness / (damping * friction) for share in shares]
    return speeds[0], speeds[1]


# A slab on a spring


def turning_points(start: float, velocity: float, frequency: float, dead_band: float) -> tuple[Array, Array]:
    """Instants, s, and places, m, of the turning points of a mass on a spring with dry friction, up to where it sticks.

    start: its distance from where the spring is at rest, m. velocity: m/s. frequency: ω = √(k/m), rad/s. dead_band:
    f = μ m g/k, m, within which friction holds the spring.

    While the mass moves one way, friction is a constant force, which shifts the centre of the swing by f against the
    motion. So a half swing that begins at the distance X ends, after π/ω, at X − 2 f on the other side. The mass sticks
    at the first turning point with |x| ≤ f. A start with a velocity is on the way of a half swing: with the distance
    s = x + f from its centre, along the motion, it ends √(s² + v²/ω²) beyond the centre, after the angle atan2(v/ω, s).
    """
    times, places = [0.0], [start]
    if velocity:
        way = math.copysign(1.0, velocity)
        ahead, rate = way * start + dead_band, abs(velocity) / frequency
        times.append(math.atan2(rate, ahead) / frequency)
        places.append(way * (math.hypot(ahead, rate) - dead_band))
    while abs(places[-1]) > dead_band:
        times.append(times[-1] + math.pi / frequency)
        places.append(math.copysign(1.0, -places[-1]) * (abs(places[-1]) - 2 * dead_band))
    return np.array(times[1:]), np.array(places[1:])
