"""Probes of the functions of friction: what presses and pushes, what holds, and how a body slides."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes import friction_impacts
from labs.grading.diagnosis.probes.probe import YES_OR_NO, Draw, Probe, edge, made, refused, usual

UP, LEANS, REST = [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
INFINITY = float("inf")


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple((_TABLE | friction_impacts.TABLE)[function]())


def _apparent() -> list[Probe]:
    by_hand = [
        usual("the weight alone", 2.0, [0, 0, -10], REST, REST),
        usual("a push from the side", 2.0, [0, 0, -10], [5, 0, 0], REST),
        usual("someone lifts", 2.0, [0, 0, -10], [0, 0, 8], REST),
        usual("a lift that starts up", 2.0, [0, 0, -10], REST, [0, 0, 3]),
        usual("a lorry that brakes", 2.0, [0, 0, -10], REST, [-4, 0, 0]),
        edge("free fall", 2.0, [0, 0, -10], REST, [0, 0, -10]),
        edge("far from everything", 2.0, REST, REST, REST),
        refused("no mass", 0.0, [0, 0, -10], REST, REST),
    ]
    maker = lambda draw: (draw.number(0.3, 5), draw.vector(10), draw.vector(10), draw.vector(4))  # noqa: E731
    return made("apparent_force", by_hand, maker)


def _normal_force() -> list[Probe]:
    by_hand = [
        usual("the weight on a floor", [0, 0, -20], UP),
        usual("the weight on an incline", [0, 0, -20], LEANS),
        usual("a push from the side as well", [7, 0, -20], UP),
        usual("lifted off", [3, 0, 5], UP),
        usual("lifted off an incline", [2, 2, 5], LEANS),
        usual("pressed against a wall", [-9, 0, -20], [1, 0, 0]),
        edge("along the floor", [5, 2, 0], UP),
        edge("nothing acts", REST, UP),
        refused("a normal that is not of unit length", [0, 0, -20], [0, 0, 2]),
    ]
    return made("normal_force", by_hand, lambda draw: (draw.vector(20), draw.unit()))


def _along() -> list[Probe]:
    by_hand = [
        usual("slanting on a floor", [3, 4, -20], UP),
        usual("the weight on an incline", [0, 0, -20], LEANS),
        usual("from below", [3, 4, 20], UP),
        usual("along the floor", [3, -4, 0], UP),
        edge("straight on", [0, 0, -20], UP),
        edge("straight on an incline", [-3, -6, -6], LEANS),
        edge("nothing acts", REST, UP),
        refused("a normal that is not of unit length", [0, 0, -20], [0, 0, 2]),
    ]
    return made("along_surface", by_hand, lambda draw: (draw.vector(20), draw.unit()))


def _holds() -> list[Probe]:
    by_hand = [
        usual("a weak push", [1, 0, 0], 10.0, 0.5),
        usual("a strong push", [8, 0, 0], 10.0, 0.5),
        usual("along the diagonal, too strong", [4, 4, 0], 10.0, 0.5),
        usual("each component below the limit, not the whole", [0, -4, 4], 10.0, 0.5),
        usual("backwards and strong", [-9, 0, 0], 10.0, 0.5),
        usual("rough", [8, 6, 0], 10.0, 1.25),
        edge("just at the limit", [3, 4, 0], 10.0, 0.5),
        edge("no push", REST, 10.0, 0.5),
        edge("no push and nothing to hold", REST, 0.0, 0.5),
        edge("lifted off", [1, 0, 0], 0.0, 0.5),
        edge("no friction, a push", [1, 0, 0], 10.0, 0.0),
        refused("a negative normal force", [1, 0, 0], -10.0, 0.5),
    ]
    maker = lambda draw: (draw.vector(7), draw.number(4, 20), draw.number(0.2, 1))  # noqa: E731
    return made("holds", by_hand, maker, count=YES_OR_NO)


def _angle() -> list[Probe]:
    by_hand = [
        usual("half", 0.5),
        usual("45 degrees", 1.0),
        usual("more than 45 degrees", 1.5),
        usual("very rough", 20.0),
        edge("no friction", 0.0),
        edge("nearly a wall", 1e6),
        refused("a negative coefficient", -0.5),
    ]
    return made("friction_angle", by_hand, lambda draw: (draw.number(0.05, 1.3),))


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
        usual("pushed back, it stops and is held", start, [2, 0, 0], [-2, 0, 0], 10.0, 0.5, 0.25, 2.0, 4.0),
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


def _square() -> list[Probe]:
    x, y = [1, 0, 0], [0, 1, 0]
    by_hand = [
        usual("below the limit", [1, 2, 0], 5.0, x, y),
        usual("above in both", [6, 8, 0], 5.0, x, y),
        usual("above in one", [1, -9, 0], 5.0, x, y),
        usual("within the square, outside of the circle", [4, -4, 0], 5.0, x, y),
        usual("backwards", [-6, -7, 0], 2.0, x, y),
        usual("axes turned", [6, 1, 0], 4.0, [0.6, 0.8, 0], [-0.8, 0.6, 0]),
        usual("a part across the surface is left out", [1, 2, 9], 5.0, x, y),
        edge("just at the limit", [5, -5, 0], 5.0, x, y),
        edge("no force", REST, 5.0, x, y),
        edge("no friction", [3, 4, 0], 0.0, x, y),
        refused("axes that are not at right angles", [3, 4, 0], 1.0, x, [0.6, 0.8, 0]),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        turn = draw.turn()
        return draw.vector(6), draw.number(1, 6), turn[0], turn[1]

    return made("clamp_to_square", by_hand, maker)


def _break_away() -> list[Probe]:
    press = [0, 0, -10]
    by_hand = [
        usual("a push that grows", press, [2, 0, 0], UP, 0.5),
        usual("from a push that is there", [1, 0, -10], [2, 0, 0], UP, 0.5),
        usual("a push that first has to turn round", [3, 0, -10], [-2, 0, 0], UP, 0.5),
        usual("pressed harder and harder, it holds for ever", press, [1, 0, -4], UP, 0.5),
        usual("lifted while pushed", press, [1, 0, 2], UP, 0.5),
        usual("lifted straight off", press, [0, 0, 2], UP, 0.5),
        usual("not held even now", [8, 0, -10], [1, 0, 0], UP, 0.5),
        usual("a push that grows sideways", [3, 0, -10], [0, 2, 0], UP, 0.5),
        usual("nothing changes", [3, 0, -10], REST, UP, 0.5),
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
    "apparent_force": _apparent,
    "normal_force": _normal_force,
    "along_surface": _along,
    "holds": _holds,
    "friction_angle": _angle,
    "friction_force": _force,
    "sliding_motion": _sliding,
    "clamp_to_circle": _circle,
    "clamp_to_square": _square,
    "break_away_time": _break_away,
}
