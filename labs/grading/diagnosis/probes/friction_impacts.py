"""Probes of the functions of friction in an impact and of contacts that rest."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes.probe import YES_OR_NO, Draw, Probe, edge, made, refused, usual
from reference.arrays import Array

UP, LEANS, REST = [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
ONE = np.eye(3).tolist()
BALL = [[3.5, 0.0, 0.0], [0.0, 3.5, 0.0], [0.0, 0.0, 1.0]]
"""K of a solid sphere of 1 kg on a floor."""
INFINITY = float("inf")


def _grips() -> list[Probe]:
    by_hand = [
        usual("little slip", 1.0, 2.0, 0.5, 0.5),
        usual("a lot of slip", 9.0, 2.0, 0.5, 0.5),
        usual("between 1 and 7/2", 2.5, 2.0, 0.5, 0.5),
        usual("between 1 and 1 + e", 4.0, 2.0, 0.5, 0.5),
        usual("no bounce", 4.0, 2.0, 0.0, 0.5),
        edge("just gripping", 5.25, 2.0, 0.5, 0.5),
        edge("no slip", 0.0, 2.0, 0.5, 0.5),
        edge("no slip, no friction", 0.0, 2.0, 0.5, 0.0),
        edge("no approach", 1.0, 0.0, 0.5, 0.5),
        edge("perfect bounce", 6.5, 2.0, 1.0, 0.5),
        refused("a negative slip", -1.0, 2.0, 0.5, 0.5),
    ]

    def maker(draw: Draw) -> tuple[float, ...]:
        speed, e, friction = draw.number(0.5, 4), draw.number(0.1, 0.9), draw.number(0.1, 0.8)
        return round(3.5 * friction * speed * (1 + e) * draw.number(0.05, 1.6), 2), speed, e, friction

    return made("sphere_grips", by_hand, maker, count=YES_OR_NO)


def _matrix(draw: Draw) -> Array:
    """K of the contact of two bodies."""
    total = np.zeros((3, 3))
    for _ in range(2):
        arm, share, turning = draw.vector(0.6), draw.number(0.3, 2), draw.inverse_inertia()
        across = np.cross(arm, np.eye(3))
        total += share * np.eye(3) + across @ turning @ across.T
    return np.asarray((total + total.T) / 2)


def _impulse() -> list[Probe]:
    by_hand = [
        usual("straight on", [0, 0, -2], UP, ONE, 0.5, 0.5),
        usual("it grips", [0.5, 0, -2], UP, ONE, 0.5, 0.5),
        usual("it slips", [8, 0, -2], UP, ONE, 0.5, 0.25),
        usual("a ball grips", [3, 1, -2], UP, BALL, 0.5, 0.5),
        usual("a ball slips", [9, -12, -2], UP, BALL, 0.5, 0.25),
        usual("no friction", [3, 1, -2], UP, ONE, 0.5, 0.0),
        usual("no bounce", [6, 0, -2], UP, ONE, 0.0, 0.25),
        usual("perfect bounce", [6, 0, -2], UP, BALL, 1.0, 0.25),
        usual("moving apart", [3, 0, 2], UP, BALL, 0.5, 0.5),
        usual("a normal that leans", [1, 0, -4], LEANS, ONE, 0.5, 0.25),
        edge("grazing", [3, 0, 0], UP, BALL, 0.5, 0.5),
        edge("no velocity at all", REST, UP, BALL, 0.5, 0.5),
        edge("just gripping", [1.5, 0, -2], UP, ONE, 0.5, 0.5),
        refused("two immovable bodies", [0, 0, -2], UP, np.zeros((3, 3)), 0.5, 0.5),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        normal = draw.unit()
        velocity = draw.tangent(normal, 4) - draw.number(1, 5) * normal
        return velocity, normal, _matrix(draw), draw.number(0.1, 0.9), draw.number(0.1, 0.9)

    return made("friction_impulse", by_hand, maker)


def _sphere() -> list[Probe]:
    by_hand = [
        usual("straight down", [0, 0, -2], REST, UP, 0.5, 0.5, 0.5),
        usual("slanting, it grips", [1, 0, -4], REST, UP, 0.5, 0.5, 0.5),
        usual("slanting, it slips", [9, 0, -2], REST, UP, 0.5, 0.5, 0.25),
        usual("backspin", [2, 0, -3], [0, -8, 0], UP, 0.5, 0.5, 0.5),
        usual("topspin", [1, 0, -3], [0, 30, 0], UP, 0.25, 0.5, 0.25),
        usual("a hollow sphere", [2, 0, -3], [0, -8, 0], UP, 0.5, 0.5, 0.5, 2 / 3),
        usual("no friction", [2, 1, -3], [3, -8, 1], UP, 0.5, 0.5, 0.0),
        usual("moving away", [2, 1, 3], [3, -8, 1], UP, 0.5, 0.5, 0.5),
        usual("spin about the normal", [0, 0, -3], [0, 0, 5], UP, 0.5, 0.5, 0.5),
        usual("a plane that leans", [0, 0, -3], [1, 0, 0], LEANS, 0.5, 0.5, 0.25),
        edge("rolling already", [2, 0, -3], [0, 4, 0], UP, 0.5, 0.5, 0.5),
        edge("grazing", [2, 0, 0], [0, -8, 0], UP, 0.5, 0.5, 0.5),
        edge("no bounce", [2, 0, -3], REST, UP, 0.5, 0.0, 0.25),
        refused("no radius", [2, 0, -3], REST, UP, 0.0, 0.5, 0.25),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        normal = draw.unit()
        velocity = draw.tangent(normal, 4) - draw.number(1, 5) * normal
        radius = draw.number(0.1, 0.9)
        return velocity, draw.vector(9), normal, radius, draw.number(0.1, 0.9), draw.number(0.05, 0.6)

    return made("sphere_impact", by_hand, maker)


def _propagate() -> list[Probe]:
    five = [1, 0, 0, 0, 0]
    by_hand = [
        usual("a cradle of five", five, 1.0, 1.0),
        usual("two arrive", [1, 1, 0, 0, 0], 1.0, 1.0),
        usual("a cradle of three that loses", [1, 0, 0], 1.0, 0.5),
        usual("a heavy one arrives", [1, 0, 0], [3, 1, 1], 1.0),
        usual("a light one arrives", [1, 0], [1, 4], 1.0),
        usual("two balls, no bounce", [2, -1], [1, 3], 0.0),
        usual("two balls meet", [2, -1], [2, 1], 0.5),
        usual("from the right", [0, 0, -1], 1.0, 1.0),
        usual("moving apart", [-1, 0, 2], 1.0, 0.5),
        usual("different restitutions", [2, 0, 0], 1.0, [0.5, 1.0]),
        edge("a wall at the end", [1, 0, 0], [1, 1, INFINITY], 1.0),
        edge("a single ball", [3], 1.0, 0.5),
        edge("all at the same speed", [2, 2, 2], 1.0, 0.5),
        refused("no mass", [1, 0], 0.0, 1.0),
    ]
    masses = [2.0, 1.0, 0.5]
    maker = lambda draw: (draw.vector(3), masses, 0.75)  # noqa: E731
    return made("propagate_impacts", by_hand, maker, single=(1, 2))


def _resting() -> list[Probe]:
    by_hand = [
        usual("one body on one contact", [[0, 0, 1]], np.diag([0.5, 0.5, 0.5]), [0, 0, -20]),
        usual("two contacts", [[0, 1, -1], [0, 1, 1]], np.diag([1, 0.5, 4]), [3, -10, 2]),
        usual("a body that weighs more one way", [[1, 0], [0, 1]], [[2, 0.5], [0.5, 1]], [-4, 2]),
        edge("no force", [[0, 0, 1]], np.diag([0.5, 0.5, 0.5]), [0, 0, 0]),
        edge("an immovable body", [[0, 0, 1]], np.zeros((3, 3)), [0, 0, -20]),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        half = np.array([draw.vector(1) for _ in range(3)])
        return np.array([draw.vector(2) for _ in range(2)]), half @ half.T + np.eye(3), draw.vector(9)

    return made("resting_problem", by_hand, maker)


def _problem(draw: Draw) -> tuple[Array, Array]:
    """A and b of three contacts."""
    half = np.array([draw.vector(1.5) for _ in range(3)])
    return half @ half.T + np.eye(3), draw.vector(5)


def _residual() -> list[Probe]:
    by_hand = [
        usual("the solution of one contact", [[2]], [-4], [2]),
        usual("too little force", [[2]], [-4], [1]),
        usual("too much force", [[2]], [-4], [3]),
        usual("a force where it lifts off", [[2]], [4], [1]),
        usual("a contact that pulls", [[2]], [4], [-2]),
        usual("two contacts, one wrong", [[2, 0], [0, 1]], [-4, -1], [2, 3]),
        edge("the solution of a contact that lifts off", [[2]], [4], [0]),
        edge("a contact that moves nothing", [[0]], [1], [0.5]),
        edge("both are zero", [[2]], [0], [0]),
        refused("a matrix that does not fit", [[2, 0], [0, 1]], [1], [1]),
    ]
    maker = lambda draw: (*_problem(draw), draw.vector(3))  # noqa: E731
    return made("complementarity_residual", by_hand, maker)


def _sweeps() -> list[Probe]:
    two, coupled = [[2, 0], [0, 4]], [[2, 1], [1, 2]]
    by_hand = [
        usual("one contact, one sweep", [[2]], [-4], 1),
        usual("two that do not touch each other", two, [-4, -8], 1),
        usual("two coupled, one sweep", coupled, [-4, -4], 1),
        usual("two coupled, two sweeps", coupled, [-4, -4], 2),
        usual("two coupled, many sweeps", coupled, [-4, -4], 100),
        usual("one lifts off", coupled, [-6, 4], 3),
        usual("from a start", coupled, [-4, -4], 1, [3, 1]),
        usual("from a start that is too large", coupled, [-4, 2], 1, [5, 5]),
        edge("no sweep", coupled, [-4, -4], 0, [1, 2]),
        edge("all lift off", coupled, [4, 4], 3),
        edge("a contact that moves nothing", [[2, 0], [0, 0]], [-4, 1], 2),
        edge("a contact that moves nothing and is pressed", [[2, 0], [0, 0]], [-4, -1], 2),
        refused("a matrix that does not fit", two, [1], 1),
    ]
    maker = lambda draw: (*_problem(draw), 2, np.abs(draw.vector(2)))  # noqa: E731
    return made("solve_by_sweeps", by_hand, maker, single=(2,))


TABLE = {
    "sphere_grips": _grips,
    "friction_impulse": _impulse,
    "sphere_impact": _sphere,
    "propagate_impacts": _propagate,
    "resting_problem": _resting,
    "complementarity_residual": _residual,
    "solve_by_sweeps": _sweeps,
}
