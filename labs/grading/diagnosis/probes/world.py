"""Probes of the functions of a world: bodies that turn, boxes that overlap, impacts in a row, contacts that rest."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes import world_scenes
from labs.grading.diagnosis.probes.probe import Draw, Probe, edge, made, refused, usual
from reference.arrays import Array

UNTURNED, HALF_TURNS, LEANS = [1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.5, 0.5], [0.8, 0.0, 0.6, 0.0]
INFINITY = float("inf")


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def _turning() -> list[Probe]:
    brick = [1, 2, 3]
    by_hand = [
        usual("about two of its axes", UNTURNED, [1, 1, 0], brick, 0.25),
        usual("about all of its axes", UNTURNED, [1, -2, 0.5], brick, 0.25),
        usual("about its own first axis", UNTURNED, [2, 0, 0], brick, 0.25),
        usual("turned by half turns", HALF_TURNS, [1, -2, 0.5], brick, 0.25),
        usual("it leans", LEANS, [0.5, 2, -1], [3, 1, 2], 0.25),
        usual("a plate", LEANS, [0.5, 2, -1], [0.1, 0.1, 0.2], 0.25),
        usual("a pin", [0.1, 0.5, 0.5, 0.7], [1, 0.5, -2], [0.02, 1, 1], 0.125),
        usual("a long step", LEANS, [3, 1, -2], brick, 1.5),
        usual("a short step", LEANS, [3, 1, -2], brick, 0.01),
        usual("fast", LEANS, [30, 10, -20], brick, 0.05),
        usual("back in time", LEANS, [0.5, 2, -1], brick, -0.25),
        edge("a ball", LEANS, [0.5, 2, -1], [2, 2, 2], 0.25),
        edge("at rest", LEANS, [0, 0, 0], brick, 0.25),
        edge("held by something else", LEANS, [0.5, 2, -1], [INFINITY, INFINITY, INFINITY], 0.25),
        edge("a step of no length", LEANS, [0.5, 2, -1], brick, 0.0),
        edge("large and small", LEANS, [0.5, 2, -1], [1e6, 2e6, 3e6], 0.25),
        refused("a negative moment", UNTURNED, [1, 1, 0], [1, -2, 3], 0.25),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        return world_scenes.orientation(draw), draw.vector(3), np.abs(draw.vector(2)) + 0.2, 0.25

    return made("rotate_by_momentum", by_hand, maker, single=(3,))


def _pairs() -> list[Probe]:
    low = [[0, 0, 0], [1, 1, 1], [4, 4, 4], [-3, 0.5, 0.5]]
    high = [[2, 2, 2], [3, 3, 3], [5, 5, 5], [0.5, 4, 1.5]]
    by_hand = [
        usual("four boxes", low, high),
        usual("the same four, from the last", low[::-1], high[::-1]),
        usual("apart along x alone", [[0, 0, 0], [3, 1, 1]], [[2, 2, 2], [5, 3, 3]]),
        usual("apart along y alone", [[0, 3, 0], [1, 0, 1]], [[2, 5, 2], [3, 2, 3]]),
        usual("apart along z alone", [[0, 0, 0], [1, 1, 2.5]], [[2, 2, 2], [3, 3, 3]]),
        usual("one inside the other", [[0, 0, 0], [1, 1, 1]], [[4, 4, 4], [2, 2, 2]]),
        usual("they cross", [[0, 1, 1], [1, 0, 0]], [[4, 2, 2], [2, 3, 3]]),
        usual("three in a heap", [[0, 0, 0], [1, 0, 1], [0, 1, 1]], [[2, 2, 2], [3, 2, 3], [2, 3, 3]]),
        usual("a small one far away", [[-900, 0, 0], [-901, 0, 0]], [[-899, 1, 1], [-899.5, 1, 1]]),
        edge("they touch", [[0, 0, 0], [2, 0, 0]], [[2, 2, 2], [3, 2, 2]]),
        edge("they touch, and the second begins first", [[2, 0, 0], [0, 0, 0]], [[3, 2, 2], [2, 2, 2]]),
        edge("they touch at a corner", [[0, 0, 0], [2, 2, 2]], [[2, 2, 2], [3, 3, 3]]),
        edge("the same twice", [[0, 0, 0], [0, 0, 0]], [[2, 2, 2], [2, 2, 2]]),
        edge(
            "a half-space", [[0, 0, 1], [-INFINITY, -INFINITY, -INFINITY]], [[1, 1, 2], [INFINITY, INFINITY, INFINITY]]
        ),
        edge("a box without a size", [[0, 0, 0], [1, 1, 1]], [[2, 2, 2], [1, 1, 1]]),
        edge("one box", [[0, 0, 0]], [[2, 2, 2]]),
        refused("an upper corner below", [[0, 0, 0], [1, 1, 1]], [[2, 2, 2], [0, 2, 2]]),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        corner = np.array([draw.vector(3) for _ in range(6)])
        return corner, corner + np.abs([draw.vector(4) for _ in range(6)])

    return made("candidate_pairs", by_hand, maker, count=14, single=range(2))


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
        usual("of four the last two approach", [-1, 0, 0, -2], 1.0, 0.5),
        usual("a light one between heavy ones", [1, 0, 0], [16, 1, 16], 1.0),
        usual("one sweep at most", [0, 0, -1], 1.0, 1.0, 1),
        usual("two sweeps at most", [0, 0, -1], 1.0, 0.5, 2),
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
        edge("no contact", np.zeros((0, 3)), np.eye(3), [0, 0, -20]),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        half = np.array([draw.vector(1) for _ in range(3)])
        return np.array([draw.vector(2) for _ in range(2)]), half @ half.T + np.eye(3), draw.vector(9)

    return made("resting_problem", by_hand, maker)


def _problem(draw: Draw) -> tuple[Array, Array]:
    """A and b of three contacts."""
    half = np.array([draw.vector(1.5) for _ in range(3)])
    return half @ half.T + np.eye(3), draw.vector(5)


def _sweeps() -> list[Probe]:
    two, coupled = [[2, 0], [0, 4]], [[2, 1], [1, 2]]
    by_hand = [
        usual("one contact, one sweep", [[2]], [-4], 1),
        usual("two that do not touch each other", two, [-4, -8], 1),
        usual("two coupled, one sweep", coupled, [-4, -4], 1),
        usual("two coupled, two sweeps", coupled, [-4, -4], 2),
        usual("three coupled, two sweeps", [[2, -1, 0], [-1, 4, 1], [0, 1, 2]], [-2, -8, 2], 2),
        usual("two coupled, many sweeps", coupled, [-4, -4], 100),
        usual("one lifts off", coupled, [-6, 4], 3),
        usual("from a start", coupled, [-4, -4], 1, [3, 1]),
        usual("from a start that is too large", coupled, [-4, 2], 1, [5, 5]),
        edge("no sweep", coupled, [-4, -4], 0, [1, 2]),
        edge("all lift off", coupled, [4, 4], 3),
        edge("a contact that moves nothing", [[2, 0], [0, 0]], [-4, 1], 2),
        edge("a contact that moves nothing and is pressed", [[2, 0], [0, 0]], [-4, -1], 2),
        edge("no contact", np.zeros((0, 0)), np.zeros(0), 2),
        refused("a matrix that does not fit", two, [1], 1),
    ]
    maker = lambda draw: (*_problem(draw), 2, np.abs(draw.vector(2)))  # noqa: E731
    return made("solve_by_sweeps", by_hand, maker, single=(2,))


_TABLE = {
    "rotate_by_momentum": _turning,
    "candidate_pairs": _pairs,
    **world_scenes.TABLE,
    "propagate_impacts": _propagate,
    "resting_problem": _resting,
    "solve_by_sweeps": _sweeps,
}
