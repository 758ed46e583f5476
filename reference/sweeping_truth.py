"""Closed forms of what a test at the ends of steps misses, each with its derivation; SI throughout."""

from __future__ import annotations

import math

from reference import truth


def missed_balls(way: float, reach: float) -> float:
    """Share of the balls that would touch another one and never overlap it at the end of a step.

    way: D, what a ball moves in a step as seen from the other one, m. reach: R, the sum of their radii, m.

    A ball that flies past the other centre at a distance b < R overlaps it along a chord of c = 2 √(R² − b²). Over all
    phases of a step, no step ends on the chord with the probability max(0, 1 − c/D). Balls that come from anywhere are
    spread evenly over the area π R², so u = b²/R² is spread evenly from 0 to 1, and so is s = 1 − u with c = 2 R √s.
    Where D ≤ 2R, the chord is shorter than D for s < s₁ = D²/4R² alone, and the share is

        ∫₀^s₁ (1 − 2 R √s/D) ds = s₁ − (4 R/3 D) s₁^(3/2) = D²/4R² − D²/6R² = D²/12R²

    Where D ≥ 2R, every chord is, and the share is the same integral up to s = 1, which is 1 − 4R/3D. Both are 1/3 at
    D = 2R.
    """
    if way <= 2 * reach:
        return way**2 / (12 * reach**2)
    return 1 - 4 * reach / (3 * way)


def unturned_balls(way: float, reach: float) -> float:
    """Share of those balls that a response at the ends of steps leaves as they are.

    A response pushes only two balls that approach, and after half of their chord they part again. A step has to end on
    the first half, so that everything is as for a test of overlap whose steps are twice as long.
    """
    return missed_balls(2 * way, reach)


def impulse_of_a_meeting(speed: float, offset: float, restitution: float, mass: float, other_mass: float) -> float:
    """Impulse of two smooth balls that meet at an offset, a share of the sum of their radii, N s.

    The offset is the sine of the angle α between the line of flight and the line of centres, along which the balls
    approach at v cos α. The impulse turns that into e v cos α.
    """
    closing = speed * math.sqrt((1 - offset) * (1 + offset))
    return truth.impact_impulse(closing, restitution, 1 / mass + 1 / other_mass)


def unturned_hands(turn: float, reach: float, distance: float) -> float:
    """Share of the balls that a turning rod passes, if it is looked at after every turn by an angle, rad.

    turn: ω Δt. reach: half the rod's thickness and the ball's radius, m. distance: of the ball from the axis, m.

    The rod's middle line stands at an angle φ to the ball, whose centre is d sin φ away from it. They overlap while
    |d sin φ| < c, that is for |φ| < asin(c/d). The rod pushes the ball only before its middle has reached the ball's
    centre, on the angle asin(c/d). Over all phases, no turn ends there with the probability 1 − asin(c/d)/(ω Δt).
    """
    return max(0.0, 1 - math.asin(reach / distance) / turn)


def struck_arm(reach: float, distance: float) -> float:
    """Distance along the rod at which it touches the ball, m: √(d² − c²), with the centre a height c above it."""
    return math.sqrt(distance**2 - reach**2)
