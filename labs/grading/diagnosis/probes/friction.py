"""Probes of the functions of friction: what presses and pushes, what holds, and how a body slides."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes.probe import Draw, Probe, edge, made, refused, usual

UP, LEANS, REST = [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
INFINITY = float("inf")


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def _support() -> list[Probe]:
    down = [0, 0, -10]
    by_hand = [
        usual("the weight alone, on a floor", 2.0, down, REST, REST, UP),
        usual("the weight on an incline", 2.0, down, REST, REST, LEANS),
        usual("a push from the side", 2.0, down, [5, 0, 0], REST, UP),
        usual("someone leans on it", 2.0, down, [3, 0, -8], REST, UP),
        usual("someone lifts", 2.0, down, [0, 1, 8], REST, UP),
        usual("a lift that starts up", 2.0, down, REST, [0, 0, 3], UP),
        usual("a lorry that brakes", 2.0, down, REST, [-4, 0, 0], UP),
        usual("a lorry that brakes on a slope", 3.0, down, REST, [-2, -4, -4], LEANS),
        usual("lifted off an incline", 1.0, down, [2, 2, 15], REST, LEANS),
        usual("pressed against a wall", 1.0, down, [-9, 0, 0], REST, [1, 0, 0]),
        edge("free fall", 2.0, down, REST, down, UP),
        edge("far from everything", 2.0, REST, REST, REST, UP),
        edge("just lifted", 2.0, down, [5, 2, 20], REST, UP),
        refused("no mass", 0.0, down, REST, REST, UP),
        refused("a normal that is not of unit length", 2.0, down, REST, REST, [0, 0, 2]),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        return draw.number(0.3, 5), draw.vector(10), draw.vector(20), draw.vector(4), draw.unit()

    return made("support_force", by_hand, maker)


def _roll() -> list[Probe]:
    by_hand = [
        usual("thrown without spin", [5, 0, 0], REST, 0.1, 0.2, 10.0, 0.05),
        usual("thrown with backspin", [2, 0, 0], [0, -30, 0], 0.1, 0.2, 10.0, 0.05),
        usual("with topspin, which drives it", [1, 0, 0], [0, 40, 0], 0.1, 0.2, 10.0, 0.05),
        usual("spinning on the spot", REST, [0, 40, 0], 0.1, 0.2, 10.0, 0.05),
        usual("hooking, across its way", [4, 0, 0], [30, 0, 0], 0.1, 0.2, 10.0, 0.05),
        usual("it rolls within the step", [1, -2, 0], REST, 0.2, 0.5, 10.0, 1.0),
        usual("spin about the vertical as well", [3, 1, 0], [2, 4, 20], 0.25, 0.3, 10.0, 0.1),
        usual("another radius", [5, 2, 0], [0, 4, 0], 0.5, 0.2, 10.0, 0.05),
        usual("on the Moon", [5, 2, 0], REST, 0.1, 0.2, 1.6, 0.05),
        edge("rolling already", [2, 0, 0], [0, 20, 0], 0.1, 0.2, 10.0, 0.05),
        edge("at rest", REST, REST, 0.1, 0.2, 10.0, 0.05),
        edge("spin about the vertical alone", REST, [0, 0, 30], 0.1, 0.2, 10.0, 0.05),
        edge("on ice", [3, 1, 0], [2, 4, 1], 0.1, 0.0, 10.0, 0.05),
        edge("a step of no length", [3, 1, 0], [2, 4, 1], 0.1, 0.2, 10.0, 0.0),
        refused("no radius", [3, 1, 0], REST, 0.0, 0.2, 10.0, 0.05),
        refused("a velocity that leaves the floor", [3, 1, 1], REST, 0.1, 0.2, 10.0, 0.05),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        velocity = draw.vector(5) * [1, 1, 0]
        radius, friction, dt = draw.number(0.05, 0.5), draw.number(0.05, 0.6), draw.number(0.02, 0.3)
        return velocity, draw.vector(20), radius, friction, draw.number(2, 12), dt

    return made("roll_step", by_hand, maker)


def _force() -> list[Probe]:
    by_hand = [
        usual("sliding, no push", REST, [2, 0, 0], 10.0, 0.5, 0.25),
        usual("sliding fast, no push", REST, [-9, 12, 0], 10.0, 0.5, 0.25),
        usual("sliding against the push", [3, 0, 0], [-2, 0, 0], 10.0, 0.5, 0.25),
        usual("sliding across the push", [0, 3, 0], [2, 0, 0], 10.0, 0.5, 0.25),
        usual("at rest, held", [3, 1, 0], REST, 10.0, 0.5, 0.25),
        usual("at rest, hardly pushed", [0.25, 0, 0], REST, 10.0, 0.5, 0.25),
        usual("at rest, pushed away", [6, 8, 0], REST, 10.0, 0.5, 0.25),
        usual("at rest, pushed between kinetic and static", [4, 0, 0], REST, 10.0, 0.5, 0.25),
        usual("sliding, a push that would be held", [1, 0, 0], [0, 3, 0], 10.0, 0.8, 0.5),
        usual("at rest, within the limit along x and along y alone", [4, -4, 0], REST, 10.0, 0.5, 0.25),
        edge("sliding very slowly, a push that would be held", [1, 0, 0], [0, 1e-6, 0], 10.0, 0.5, 0.25),
        edge("sliding very slowly, a push that would not be held", [0, 0, 9], [-1e-6, 0, 0], 10.0, 0.5, 0.25),
        edge("sliding more slowly than anything is measured", [1, 0, 0], [0, 1e-15, 0], 10.0, 0.5, 0.25),
        edge("at rest, no push", REST, REST, 10.0, 0.5, 0.25),
        edge("at rest, just held", [3, 4, 0], REST, 10.0, 0.5, 0.25),
        edge("lifted off, sliding", [1, 0, 0], [2, 0, 0], 0.0, 0.5, 0.25),
        edge("no friction", [1, 0, 0], [2, 0, 0], 10.0, 0.0, 0.0),
        edge("both coefficients the same, at rest", [4, 0, 0], REST, 10.0, 0.25, 0.25),
        refused("kinetic friction above static", [1, 0, 0], REST, 10.0, 0.25, 0.5),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        kinetic = draw.number(0.1, 0.6)
        velocity = draw.vector(4) if draw.rng.uniform() < 0.5 else np.zeros(3)
        return draw.vector(9), velocity, draw.number(4, 20), round(kinetic + draw.number(0.05, 0.4), 2), kinetic

    return made("friction_force", by_hand, maker)


def _sliding() -> list[Probe]:
    start = [1, 0, 0]
    by_hand = [
        usual("sliding on", start, [4, 0, 0], REST, 10.0, 0.5, 0.25, 2.0, 0.5),
        usual("it stops within the step", start, [1, 0, 0], REST, 10.0, 0.5, 0.25, 1.0, 2.0),
        usual("pushed along", start, [1, 0, 0], [4, 0, 0], 10.0, 0.5, 0.25, 2.0, 0.5),
        usual("pushed along, but too weakly: it stops", start, [1, 0, 0], [2, 0, 0], 10.0, 0.5, 0.25, 1.0, 1.0),
        usual("pushed back, it stops and is held", start, [2, 0, 0], [-2, 0, 0], 10.0, 0.5, 0.25, 2.0, 4.0),
        usual("pushed back, it stops and is just held", start, [2, 0, 0], [-4, 0, 0], 10.0, 0.5, 0.25, 2.0, 4.0),
        usual("it stops and is held, across the axes", start, [3, -4, 0], [-2.4, 3.2, 0], 10.0, 0.5, 0.25, 1.0, 4.0),
        usual("pushed back, it stops and slides back", start, [2, 0, 0], [-9, 0, 0], 10.0, 0.5, 0.25, 2.0, 1.0),
        usual("pushed back, it does not stop yet", start, [4, 0, 0], [-3, 0, 0], 10.0, 0.5, 0.25, 2.0, 0.5),
        usual("at rest and held", start, REST, [2, 0, 0], 10.0, 0.5, 0.25, 2.0, 1.0),
        usual("at rest and pushed away", start, REST, [8, 0, 0], 10.0, 0.5, 0.25, 2.0, 1.0),
        usual("across the axes", [0, 1, 0], [3, -4, 0], REST, 10.0, 0.5, 0.25, 1.0, 8.0),
        edge("it stops at the very end", start, [1.25, 0, 0], REST, 10.0, 0.5, 0.25, 1.0, 0.5),
        edge("no friction", start, [1, 2, 0], REST, 10.0, 0.0, 0.0, 2.0, 0.5),
        edge("at rest, nothing acts", start, REST, REST, 10.0, 0.5, 0.25, 2.0, 1.0),
        edge("a step of no length", start, [1, 0, 0], REST, 10.0, 0.5, 0.25, 2.0, 0.0),
        refused("no mass", start, [1, 0, 0], REST, 10.0, 0.5, 0.25, 0.0, 1.0),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        way, kinetic = draw.unit(), draw.number(0.1, 0.5)
        push = draw.number(-9, 4) * way
        velocity = draw.number(0.5, 4) * way
        static = round(kinetic + draw.number(0.05, 0.4), 2)
        return (
            *(draw.vector(), velocity, push, draw.number(4, 12), static, kinetic),
            *(draw.number(0.5, 3), draw.number(0.3, 2)),
        )

    return made("sliding_motion", by_hand, maker)


def _circle() -> list[Probe]:
    by_hand = [
        usual("below the limit", [1, 2, 0], 5.0),
        usual("above the limit", [6, 8, 0], 5.0),
        usual("along the diagonal, between circle and square", [4, 4, 0], 5.0),
        usual("one component above", [1, -9, 0], 5.0),
        usual("backwards", [-6, 0, 0], 2.0),
        edge("just at the limit", [3, 4, 0], 5.0),
        edge("no force", REST, 5.0),
        edge("no friction", [3, 4, 0], 0.0),
        edge("no force and no friction", REST, 0.0),
        refused("a negative limit", [3, 4, 0], -1.0),
    ]
    return made("clamp_to_circle", by_hand, lambda draw: (draw.vector(6), draw.number(1, 9)))


def _break_away() -> list[Probe]:
    press = [0, 0, -10]
    by_hand = [
        usual("a push that grows", press, [2, 0, 0], UP, 0.5),
        usual("from a push that is there", [1, 0, -10], [2, 0, 0], UP, 0.5),
        usual("a push that first has to turn round", [3, 0, -10], [-2, 0, 0], UP, 0.5),
        usual("pressed harder and harder, it holds for ever", press, [1, 0, -4], UP, 0.5),
        usual("lifted while pushed", press, [1, 0, 2], UP, 0.5),
        usual("lifted while pushed, from a push that is there", [3, 0, -10], [2, 0, 4], UP, 0.5),
        usual("lifted straight off", press, [0, 0, 2], UP, 0.5),
        usual("not held even now", [8, 0, -10], [1, 0, 0], UP, 0.5),
        usual("a push that grows sideways", [3, 0, -10], [0, 2, 0], UP, 0.5),
        usual("nothing changes", [3, 0, -10], REST, UP, 0.5),
        usual("pushed steadily while it is lifted", [3, 0, -10], [0, 0, 2], UP, 0.5),
        usual("pushed steadily down a slope while it is lifted", [-1, -8, -5], [0.5, 1, 1], LEANS, 0.5),
        usual("pulled off now", [1, 0, 6], [1, 0, 0], UP, 0.5),
        usual("pulled off now, but less and less", [0, 1, 4], [0, 1, -1], UP, 0.5),
        usual("pulled off a slope now", [1, 3, 2], [2, 0, 1], LEANS, 0.8),
        edge("no friction, no push yet", press, [2, 0, 0], UP, 0.0),
        edge("just held, and growing", [5, 0, -10], [1, 0, 0], UP, 0.5),
        edge("pulled off the plane now", [0, 0, 2], [1, 0, 0], UP, 0.5),
        edge("nothing acts at all", REST, REST, UP, 0.5),
        refused("a negative coefficient", press, [2, 0, 0], UP, -0.5),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        normal = draw.unit()
        force = draw.tangent(normal, 2) - draw.number(12, 20) * normal
        rate = draw.tangent(normal, 4) + draw.number(-1, 3) * normal
        return force, rate, normal, draw.number(0.3, 0.9)

    return made("break_away_time", by_hand, maker)


_TABLE = {
    "support_force": _support,
    "roll_step": _roll,
    "friction_force": _force,
    "sliding_motion": _sliding,
    "clamp_to_circle": _circle,
    "break_away_time": _break_away,
}
