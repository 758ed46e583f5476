"""Probes of the functions of impacts in a row and of contacts that rest."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes.probe import Draw, Probe, edge, made, refused, usual
from reference.arrays import Array

UP, LEANS, REST = [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
ONE = np.eye(3).tolist()
BALL = [[3.5, 0.0, 0.0], [0.0, 3.5, 0.0], [0.0, 0.0, 1.0]]
"""K of a solid sphere of 1 kg on a floor."""
INFINITY = float("inf")


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


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


_TABLE = {
    "propagate_impacts": _propagate,
    "resting_problem": _resting,
    "complementarity_residual": _residual,
    "solve_by_sweeps": _sweeps,
}
