"""Probes of the functions of forces: a step, gravity, springs and their step limits, drag, wind, and their sum."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes.probe import Draw, Probe, edge, made, refused, usual

REST, DOWN = [0.0, 0.0, 0.0], [0.0, 0.0, -10.0]
HERE, THERE = [1.0, 2.0, -1.0], [3.0, 1.0, 1.0]
"""Two places that are 3 m apart."""
HEAVY = 1e10
"""A mass, kg, that pulls 1 kg from 1 m away with 0.667 N."""


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def _euler() -> list[Probe]:
    by_hand = [
        usual("thrown", REST, [3, 0, 4], DOWN, 0.1),
        usual("let go", [0, 0, 5], REST, DOWN, 0.5),
        usual("nothing pushes", [1, -2, 3], [2, 1, -1], REST, 0.5),
        usual("along no axis", [1, -2, 3], [2, 1, -1], [-4, 3, 2], 0.25),
        usual("a long step", [1, -2, 3], [2, 1, -1], [-4, 3, 2], 3.0),
        edge("a step of no length", [1, -2, 3], [2, 1, -1], [-4, 3, 2], 0.0),
        edge("at rest, and nothing pushes", [1, -2, 3], REST, REST, 0.5),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        return draw.vector(), draw.vector(), draw.vector(9), draw.number(0.1, 2)

    return made("explicit_euler", by_hand, maker)


def _gravity() -> list[Probe]:
    by_hand = [
        usual("along an axis", 3.0, HEAVY, REST, [2, 0, 0], 0.0),
        usual("in the other direction", 3.0, HEAVY, [2, 0, 0], REST, 0.0),
        usual("along no axis", 3.0, 2 * HEAVY, HERE, THERE, 0.0),
        usual("both heavy", HEAVY, 2 * HEAVY, HERE, THERE, 0.0),
        usual("two balls of lead", 3.0, 2.0, HERE, THERE, 0.0),
        usual("near each other", 3.0, HEAVY, [1, 2, -1], [1.25, 2, -1], 0.0),
        usual("far apart", 3.0, HEAVY, [1, 2, -1], [100, -200, 300], 0.0),
        usual("softened", 3.0, HEAVY, HERE, THERE, 2.0),
        usual("softened by more than they are apart", 3.0, HEAVY, [0, 0, 1], [0, 0.5, 1], 4.0),
        usual("a softening without effect", 3.0, HEAVY, HERE, [30, 10, 10], 0.01),
        usual("grains of dust", 3e-9, 2e-9, [2e-6, 0, 1e-6], [0, 1e-6, 3e-6], 0.0),
        edge("softening left out", 3.0, HEAVY, HERE, THERE),
        edge("at the same place", 3.0, HEAVY, HERE, HERE, 0.0),
        edge("at the same place, softened", 3.0, HEAVY, HERE, HERE, 2.0),
        edge("no mass", 0.0, HEAVY, HERE, THERE, 0.0),
        edge("nothing pulls", 3.0, 0.0, HERE, THERE, 0.0),
        refused("a negative mass", -3.0, HEAVY, HERE, THERE, 0.0),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        heavy = HEAVY * draw.number(0.5, 3)
        return draw.number(0.5, 4), heavy, draw.vector(), draw.vector(), draw.number(0.1, 2)

    return made("universal_gravity", by_hand, maker)


def _spring() -> list[Probe]:
    still = REST, REST
    by_hand = [
        usual("stretched", [3, 0, 0], REST, *still, 4.0, 1.0, 0.0),
        usual("compressed", [0.5, 0, 0], REST, *still, 4.0, 1.0, 0.0),
        usual("stretched, along no axis", HERE, THERE, *still, 6.0, 2.0, 0.5),
        usual("compressed, along no axis", HERE, THERE, *still, 6.0, 4.0, 0.5),
        usual("without a rest length", HERE, THERE, *still, 6.0, 0.0, 0.5),
        usual("the first end is pulled away", HERE, THERE, [-2, 1, 0], REST, 0.0, 2.0, 0.5),
        usual("the second end is pulled away", HERE, THERE, REST, [2, -1, 0], 0.0, 2.0, 0.5),
        usual("it becomes shorter", HERE, THERE, [2, 0, 1], [0, 0, -1], 0.0, 2.0, 0.5),
        usual("it flies as a whole", HERE, THERE, [3, -1, 2], [3, -1, 2], 6.0, 2.0, 0.5),
        usual("it turns as a whole", HERE, THERE, [1, 2, 0], [-1, -2, 0], 6.0, 2.0, 0.5),
        usual("a strong damper", HERE, THERE, [-2, 1, 0], [0, 3, 1], 6.0, 2.0, 9.0),
        usual("a heavy damper on a spring at rest length", HERE, THERE, [-2, 1, 0], [0, 3, 1], 6.0, 3.0, 9.0),
        edge("at its rest length", HERE, THERE, *still, 6.0, 3.0, 0.5),
        edge("of no length", HERE, HERE, [1, 2, 3], REST, 6.0, 2.0, 0.5),
        edge("of no length and no rest length", HERE, HERE, [1, 2, 3], REST, 6.0, 0.0, 0.5),
        edge("neither spring nor damper", HERE, THERE, [-2, 1, 0], [0, 3, 1], 0.0, 2.0, 0.0),
        refused("a negative stiffness", HERE, THERE, *still, -6.0, 2.0, 0.5),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        places = draw.vector(), draw.vector(), draw.vector(), draw.vector()
        return *places, draw.number(1, 9), draw.number(0.5, 6), draw.number(0.2, 4)

    return made("spring_damper_force", by_hand, maker)


def _limit() -> list[Probe]:
    by_hand = [
        usual("a weak damper", 9.0, 4.0, 1.0),
        usual("half of critical", 9.0, 4.0, 6.0),
        usual("more than critical", 9.0, 4.0, 13.0),
        usual("far more than critical", 9.0, 4.0, 120.0),
        usual("a very weak damper", 9.0, 4.0, 0.01),
        usual("stiff", 900.0, 4.0, 6.0),
        usual("light", 9.0, 0.04, 0.3),
        usual("of unit mass", 4.0, 1.0, 2.0),
        usual("of unit stiffness", 1.0, 4.0, 2.0),
        edge("no damper", 9.0, 4.0, 0.0),
        edge("critical", 9.0, 4.0, 12.0),
        edge("all of them one", 1.0, 1.0, 1.0),
        refused("no mass", 9.0, 0.0, 1.0),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        return draw.number(0.5, 9), draw.number(0.5, 9), draw.number(0.1, 20)

    return made("spring_step_limit", by_hand, maker)


def _stokes() -> list[Probe]:
    by_hand = [
        usual("in a fluid at rest", [2, 0, 0], REST, 0.5, 0.1),
        usual("in a fluid at rest, along no axis", [2, -1, 3], REST, 0.5, 0.1),
        usual("in a stream, itself at rest", REST, [1, -2, 0], 0.5, 0.1),
        usual("across a stream", [0, 0, 2], [1, -2, 0], 0.5, 0.1),
        usual("faster than the stream", [3, -6, 0], [1, -2, 0], 0.5, 0.1),
        usual("in pitch", [2, -1, 3], [1, 1, 1], 200.0, 0.1),
        usual("a large ball", [2, -1, 3], [1, 1, 1], 0.5, 3.0),
        usual("a grain of dust", [2, -1, 3], [1, 1, 1], 0.5, 1e-5),
        edge("drifting along", [2, -1, 3], [2, -1, 3], 0.5, 0.1),
        edge("everything at rest", REST, REST, 0.5, 0.1),
        edge("no viscosity", [2, -1, 3], [1, 1, 1], 0.0, 0.1),
        edge("no ball", [2, -1, 3], [1, 1, 1], 0.5, 0.0),
        refused("a negative radius", [2, -1, 3], [1, 1, 1], 0.5, -0.1),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        return draw.vector(), draw.vector(), draw.number(0.1, 3), draw.number(0.1, 2)

    return made("stokes_drag", by_hand, maker)


def _terminal() -> list[Probe]:
    by_hand = [
        usual("a ball that sinks", 0.2, 5.0, 2.0, 3.0, DOWN),
        usual("a bubble", 0.2, 0.0, 2.0, 3.0, DOWN),
        usual("in air without weight", 0.2, 5.0, 0.0, 3.0, DOWN),
        usual("wood in water", 0.2, 1.5, 2.0, 3.0, DOWN),
        usual("hardly denser", 0.2, 2.01, 2.0, 3.0, DOWN),
        usual("a large ball", 2.0, 5.0, 2.0, 300.0, DOWN),
        usual("in pitch", 0.2, 5.0, 2.0, 300.0, DOWN),
        usual("on the Moon", 0.2, 5.0, 2.0, 3.0, [0, 0, -1.6]),
        usual("where down is elsewhere", 0.2, 5.0, 2.0, 3.0, [3, -6, 2]),
        edge("as dense as the fluid", 0.2, 2.0, 2.0, 3.0, DOWN),
        edge("without gravity", 0.2, 5.0, 2.0, 3.0, REST),
        refused("no viscosity", 0.2, 5.0, 2.0, 0.0, DOWN),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        # slow enough for Stokes' drag: the Reynolds number is below 0.1
        densities = draw.number(1, 9), draw.number(0.5, 4)
        return draw.number(0.1, 0.9), *densities, draw.number(40, 90), draw.vector()

    return made("terminal_velocity", by_hand, maker)


def _wind() -> list[Probe]:
    by_hand = [
        usual("at rest in a wind", REST, [2, 0, 0], 0.5, 0.47, 1.2),
        usual("cycling in still air", [4, 0, 0], REST, 0.5, 0.47, 1.2),
        usual("with the wind", [4, 0, 0], [6, 0, 0], 0.5, 0.47, 1.2),
        usual("against the wind", [4, 0, 0], [-6, 0, 0], 0.5, 0.47, 1.2),
        usual("across the wind", [4, 0, 0], [0, 3, 0], 0.5, 0.47, 1.2),
        usual("along no axis", [1, -2, 2], [3, 0, 1], 0.5, 0.47, 1.2),
        usual("in a storm", [1, -2, 2], [30, 20, 10], 0.5, 0.47, 1.2),
        usual("a large plate", [1, -2, 2], [3, 0, 1], 8.0, 1.3, 1.2),
        usual("in water", [1, -2, 2], [3, 0, 1], 0.5, 0.47, 1000.0),
        usual("a light breeze", [0.01, 0.02, 0], [0.03, 0, 0.01], 0.5, 0.47, 1.2),
        edge("drifting along", [1, -2, 2], [1, -2, 2], 0.5, 0.47, 1.2),
        edge("no air", [1, -2, 2], [3, 0, 1], 0.5, 0.47, 0.0),
        edge("no area", [1, -2, 2], [3, 0, 1], 0.0, 0.47, 1.2),
        refused("a negative area", [1, -2, 2], [3, 0, 1], -0.5, 0.47, 1.2),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        return draw.vector(), draw.vector(), draw.number(0.2, 3), draw.number(0.2, 2), draw.number(0.3, 2)

    return made("wind_force", by_hand, maker)


_PLACES = [[0, 0, 0], [1, 2, 2], [1, 2, -1], [-2, 1, 0]]
_SPEEDS = [[1, 0, 0], [0, -1, 2], [3, 0, 0], [0, 0, 2]]
_BALLS = _PLACES, _SPEEDS, [2.0, 1.0, 0.5, 3.0], [0.5, 0.25, 0.1, 0.4]
_NONE = np.zeros((0, 2), dtype=int), np.zeros(0), np.zeros(0), np.zeros(0)
_CHAIN = np.array([[0, 1], [1, 2], [3, 0]]), [4.0, 6.0, 9.0], [2.0, 2.0, 3.0], [0.5, 1.0, 2.0]


def _one(first: int, second: int, *numbers: float) -> tuple[Any, ...]:
    return np.array([[first, second]]), *([number] for number in numbers)


def _total() -> list[Probe]:
    still, air, stream = (REST, 0.0, REST), (DOWN, 0.2, REST), (DOWN, 0.2, [1.0, -2.0, 0.5])
    by_hand = [
        usual("weights alone", *_BALLS, DOWN, 0.0, REST, *_NONE),
        usual("drags alone", *_BALLS, REST, 0.2, REST, *_NONE),
        usual("in a stream", *_BALLS, REST, 0.2, [1.0, -2.0, 0.5], *_NONE),
        usual("in an eddy", *_BALLS, REST, 0.2, [[1, 0, 0], [0, -2, 0], [0, 0, 3], [1, 1, 1]], *_NONE),
        usual("one spring", *_BALLS, *still, *_one(0, 1, 4.0, 2.0, 0.0)),
        usual("one damper", *_BALLS, *still, *_one(0, 1, 0.0, 2.0, 0.5)),
        usual("one spring, its ends exchanged", *_BALLS, *still, *_one(1, 0, 4.0, 2.0, 0.5)),
        usual("two springs at one ball", *_BALLS, *still, np.array([[0, 1], [0, 2]]), [4, 5], [2, 1], [0.5, 1]),
        usual("two springs side by side", *_BALLS, *still, np.array([[0, 1], [0, 1]]), [4, 5], [2, 1], [0.5, 1]),
        usual("a chain", *_BALLS, *still, *_CHAIN),
        usual("a chain that hangs", *_BALLS, DOWN, 0.0, REST, *_CHAIN),
        usual("a chain in still oil", *_BALLS, *air, *_CHAIN),
        usual("a chain in a stream", *_BALLS, *stream, *_CHAIN),
        edge("one ball", *(each[:1] for each in _BALLS), *stream, *_NONE),
        edge("nothing acts", *_BALLS, *still, *_NONE),
        edge("a spring of no length", [HERE, HERE], [REST, [1, 0, 0]], [1.0, 2.0], [0.5, 0.5], *air,
             *_one(0, 1, 4.0, 2.0, 0.5)),
        refused("a ball that there is not", *_BALLS, *still, *_one(0, 4, 4.0, 2.0, 0.5)),
    ]  # fmt: skip

    def maker(draw: Draw) -> tuple[Any, ...]:
        return scene_of(draw)

    return made("total_force", by_hand, maker, single=range(11))


def scene_of(draw: Draw) -> tuple[Any, ...]:
    """Arguments of `total_force`: five balls in a stream, and six springs between them."""
    balls, springs = 5, 6
    rows = (np.array([draw.vector() for _ in range(balls)]) for _ in range(3))
    position, velocity, stream = rows
    mass, radius = (np.array([draw.number(0.3, 3) for _ in range(balls)]) for _ in range(2))
    ends = np.array([draw.rng.permutation(balls)[:2] for _ in range(springs)])
    numbers = (np.array([draw.number(0.5, 6) for _ in range(springs)]) for _ in range(3))
    return position, velocity, mass, radius, draw.vector(9), draw.number(0.05, 0.4), stream, ends, *numbers


_TABLE = {
    "explicit_euler": _euler,
    "universal_gravity": _gravity,
    "spring_damper_force": _spring,
    "spring_step_limit": _limit,
    "stokes_drag": _stokes,
    "terminal_velocity": _terminal,
    "wind_force": _wind,
    "total_force": _total,
}
