"""Closed forms of avoidance: how near bodies come that do not avoid each other, and where they wait forever."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

from reference.checks import Vector


def least_gap_of_straight_ways(
    positions: Sequence[Vector], velocities: Sequence[Vector], radii: Sequence[float]
) -> float:
    """Least gap that any two balls have on straight ways at constant velocities, m; negative where they overlap.

    With x = p_A − p_B and u = v_A − v_B, the squared distance of two centres is x² + 2 x·u t + u² t². It is least at
    t = −x·u/u², where it is x² − (x·u)²/u², or now, if the balls already move apart.
    """
    balls = list(zip(positions, velocities, radii, strict=True))
    return min(_nearest(*one, *other) for one, other in itertools.combinations(balls, 2))


def _nearest(p: Vector, v: Vector, r: float, q: Vector, w: Vector, s: float) -> float:
    apart = [a - b for a, b in zip(p, q, strict=True)]
    speed = [a - b for a, b in zip(v, w, strict=True)]
    closing = -sum(a * b for a, b in zip(apart, speed, strict=True))
    squared = sum(each * each for each in speed)
    time = max(0.0, closing / squared) if squared > 0 else 0.0
    return math.hypot(*(a + b * time for a, b in zip(apart, speed, strict=True))) - r - s


def left_where_two_meet(ways: tuple[float, float], gap: float) -> float:
    """What is left of the longer way, m, of two bodies that walk at each other, equally fast, until their gap is gone.

    Each goes half of the gap, and neither can go on. ways: to the goals, m, in which the gap lies.
    """
    return max(ways) - gap / 2


def gap_of_balance(strength: float, reach: float, pull: float) -> float:
    """The gap, m, at which a repelling field F0 (1 − s/R)² carries a pull, N, towards the obstacle.

    F0 (1 − s/R)² = F gives s = R (1 − √(F/F0)); a pull that is stronger than the field at the surface, F > F0, is
    carried nowhere, and s is 0.
    """
    return max(0.0, reach * (1 - math.sqrt(pull / strength)))


def way_around(start: Vector, goal: Vector, centre: Vector, radius: float) -> float:
    """The shortest way around a ball, m: two tangents, and the arc between their tangent points, or straight past it.

    From a distance L of the centre a tangent is √(L² − r²) long, and its tangent point lies by the angle acos(r/L) from
    the line to the centre. What is left of the angle at the centre between start and goal is the arc. If nothing is
    left, the straight line misses the ball.
    """
    ends = [[a - b for a, b in zip(end, centre, strict=True)] for end in (start, goal)]
    lengths = [math.hypot(*end) for end in ends]
    cosine = sum(a * b for a, b in zip(*ends, strict=True)) / (lengths[0] * lengths[1])
    arc = math.acos(max(-1.0, min(1.0, cosine))) - sum(math.acos(radius / length) for length in lengths)
    if arc <= 0:
        return math.dist(start, goal)
    return sum(math.sqrt(length**2 - radius**2) for length in lengths) + radius * arc
