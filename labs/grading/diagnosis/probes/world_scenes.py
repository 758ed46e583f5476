"""Probes of the functions that take a whole world: its contacts, what they do in a step, and the step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from labs.grading.diagnosis.probes.probe import Draw, Probe, edge, made, usual
from labs.plain_worlds import (
    BALL,
    BOX,
    EMPTY,
    FLOOR,
    PLANE,
    REST,
    UNTURNED,
    UP,
    WEIGHT,
    contacts,
    load,
    thing,
    world,
)
from reference.arrays import Array

LEANS = (0.8, 0.0, 0.6, 0.0)
SLANTED = (2 / 3, -1 / 3, 2 / 3)
"""A unit normal along no axis; (1, 2, 0) and (−4, 2, 5) are at right angles to it."""
_TURNS = ((1, 2, 2, 4, 5), (1, 1, 3, 5, 6), (2, 2, 4, 5, 7), (1, 4, 4, 4, 7))
"""Whole numbers with a² + b² + c² + d² = e²."""


def orientation(draw: Draw) -> Array:
    """A unit quaternion, of no simple turn."""
    *parts, length = _TURNS[draw.rng.integers(len(_TURNS))]
    return np.asarray(draw.rng.permutation(parts) * draw.rng.choice([-1, 1], 4) / length)


# Where bodies touch


def _collecting() -> list[Probe]:
    slope = thing(PLANE, SLANTED, position=(1, 2, 3))
    turned_plane = thing(PLANE, (0, 0, 1), position=(0.5, 0, 0), orientation=LEANS)
    low = thing(BALL, 0.5, 2.0, (3, 1, 0.45))
    box = thing(BOX, (0.5, 0.25, 0.75), 3.0, (1, -1, 0.745))
    tilted = thing(BOX, (0.5, 1.0, 2.0), 3.0, (1, -1, 1.7), LEANS)
    flat = thing(BOX, (1, 1.5, 0.5), 3.0, (0, 0, 0.5))
    upon = thing(BOX, (0.5, 0.75, 0.5), 3.0, (0.25, 0.5, 1.495))
    other = thing(BALL, 0.75, 2.0, (4, 1.25, 0.9))
    far = thing(BALL, 0.75, 2.0, (4, 8, 0.9))
    scenes = [
        ("a ball on the floor", [FLOOR, low], 0.01, {}),
        ("the floor comes last", [low, FLOOR], 0.01, {}),
        ("two balls, one on the floor", [low, other, FLOOR], 0.01, {}),
        ("a ball apart", [FLOOR, far], 0.01, {}),
        ("a ball apart by less than the margin", [FLOOR, far], 0.2, {}),
        ("two balls apart by less than half the margin", [low, thing(BALL, 0.5, 1.0, (4.08, 1, 0.45))], 0.2, {}),
        ("two balls apart by almost the margin", [low, thing(BALL, 0.5, 1.0, (4.18, 1, 0.45))], 0.2, {}),
        ("a box on the floor", [FLOOR, box], 0.01, {}),
        ("a box that leans", [FLOOR, tilted], 0.01, {}),
        ("on a slope", [slope, thing(BALL, 0.5, 2.0, np.add((1, 2, 3), np.multiply(0.4, SLANTED)))], 0.01, {}),
        ("on a plane that is turned", [turned_plane, thing(BALL, 0.5, 2.0, (1, 0, 0.3))], 0.01, {}),
        ("a box upon a box", [FLOOR, flat, upon], 0.01, {}),
        ("a ball at a box", [box, thing(BALL, 0.5, 2.0, (1.9, -1, 0.9))], 0.01, {}),
        ("a ball at the corner of a box",
         [thing(BOX, (1, 1, 1), 1, REST, (0.8, 0, 0, 0.6)), thing(BALL, 0.5, 1, (1.55, 0.85, 0.1))], 0.01, {}),
        ("a ball at a box that leans", [thing(BALL, 0.5, 2.0, (2.2, -0.5, 3.5)), tilted], 0.5, {}),
        ("two that do not meet", [low, other, FLOOR], 0.01, {"meet": [[1, 0, 1], [0, 1, 1], [1, 1, 1]]}),
        ("each meets all others", [low, other, FLOOR], 0.01, {"meet": [[0, 1, 1], [1, 0, 1], [1, 1, 0]]}),
        ("two immovable bodies", [FLOOR, thing(BOX, (1, 1, 1), position=(3, 1, -0.5)), low], 0.01, {}),
        ("a long box that is turned",
         [thing(BOX, (3, 0.1, 0.1), 1, REST, LEANS), thing(BALL, 0.5, 1, (0.9, 0.3, -2.5))], 0.01, {}),
        ("a rod that stands along y",
         [thing(BOX, (3, 0.1, 0.1), 1, REST, (0.5, 0.5, 0.5, 0.5)), thing(BALL, 0.25, 1, (0, 2.5, 0.3))], 0.01, {}),
        ("a box on its corner", [thing(BOX, (1, 1, 1), 1, (0, 0, 1.6), (0.5, 0.5, 0.1, 0.7)), FLOOR], 0.2, {}),
    ]  # fmt: skip
    by_hand = [usual(note, *world(things, **more), margin) for note, things, margin, more in scenes]
    by_hand += [
        edge("nothing touches", *world([low, far]), 0.01),
        edge("a margin of zero", *world([FLOOR, low]), 0.0),
        edge("one body", *world([low]), 0.01),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        balls = [thing(BALL, draw.number(0.4, 1), draw.number(1, 3), draw.vector(1.5)) for _ in range(2)]
        boxes = [thing(BOX, np.abs(draw.vector(1)) + 0.1, 1.0, draw.vector(1.5), orientation(draw)) for _ in range(2)]
        plane = thing(PLANE, draw.unit(), position=draw.vector(2))
        return *world([balls[0], boxes[0], plane, balls[1], boxes[1]]), draw.number(0.01, 0.3)

    return made("collect_contacts", by_hand, maker, count=9, single=range(3))


# What contacts do in a step


def _falling(velocity: Sequence[float], spin: Sequence[float] = REST, place: Any = (1, 2, 0.5)) -> tuple[Any, ...]:
    return thing(BALL, 0.5, 2.0, place, UNTURNED, velocity, spin)


def _on_floor(
    body: tuple[Any, ...], several: Sequence[Any], gap: float = 0.0, start: Any = 0.0, sweeps: int = 8, **more: Any
) -> tuple[Any, ...]:
    """Arguments of `respond` for one body above the floor, which is the other one."""
    forces = {name: more.pop(name) for name in ("others", "turning") if name in more}
    bodies, state = world([FLOOR, body], **more)
    touching = contacts(*((1, 0, place, UP, gap) for place in several))
    begin = np.array(np.broadcast_to(start, (len(several), 3)), dtype=float)
    return bodies, state, touching, load(bodies, **forces), 0.125, 2.5, sweeps, begin


UNDER = [(1, 2, 0)]
FOOT = [(0, 1.5, 0), (2, 1.5, 0), (0, 2.5, 0), (2, 2.5, 0)]
"""Where a box with the half extents 1, 1/2 and 2 around (1, 2, 2) stands."""


def _box(velocity: Sequence[float] = REST, spin: Sequence[float] = REST) -> tuple[Any, ...]:
    return thing(BOX, (1, 0.5, 2), 3.0, (1, 2, 2), UNTURNED, velocity, spin)


def _row(speeds: Sequence[float], masses: Sequence[float], e: Any = 1.0, sweeps: int = 8, **more: Any) -> Any:
    """Balls in a row along a slanted line, in touch, without weight."""
    way = np.array(SLANTED)
    balls = [
        thing(BALL, 0.5, mass, i * way, UNTURNED, v * way)
        for i, (v, mass) in enumerate(zip(speeds, masses, strict=True))
    ]
    bodies, state = world(balls, e, **more)
    touching = contacts(*((i + 1, i, (i + 0.5) * way, way, 0.0) for i in range(len(balls) - 1)))
    nothing = np.zeros((len(balls), 6))
    return bodies, state, touching, nothing, 0.125, 0.1, sweeps, np.zeros((len(balls) - 1, 3))


def _tower(sweeps: int, start: Any = 0.0, top: float = 5.0) -> Any:
    """Two balls, one upon the other, on the floor; the upper one is heavier."""
    bodies, state = world([FLOOR, thing(BALL, 0.5, 1.0, (0, 0, 0.5)), thing(BALL, 1.0, top, (0, 0, 2))])
    touching = contacts((1, 0, REST, UP, 0.0), (2, 1, (0, 0, 1), UP, 0.0))
    begin = np.array(np.broadcast_to(start, (2, 3)), dtype=float)
    return bodies, state, touching, load(bodies), 0.125, 2.5, sweeps, begin


def _rough_each_in_its_own_way() -> Any:
    """Two balls that strike and two that are pushed, and with each the floor has a friction of its own."""
    friction = np.full((5, 5), 0.5)
    friction[0, 1:] = friction[1:, 0] = [0.0625, 0.09375, 0.25, 0.125]
    arriving = [(2, 0, -4), (2, 0, -4), REST, REST]
    balls = [_falling(v, place=(3 * k, 2, 0.5)) for k, v in enumerate(arriving, 1)]
    bodies, state = world([FLOOR, *balls], friction=friction)
    touching = contacts(*((k, 0, (3 * k, 2, 0), UP, 0.0) for k in range(1, 5)))
    pushed = load(bodies, [REST, REST, REST, (80, 0, 0), (80, 0, 0)])
    return bodies, state, touching, pushed, 0.125, 2.5, 8, np.zeros((4, 3))


def _responding() -> list[Probe]:
    bottom = [(1, 2, 0)]
    by_hand = [
        usual("a ball strikes the floor", *_on_floor(_falling((0, 0, -4)), UNDER)),
        usual("without rebound", *_on_floor(_falling((0, 0, -4)), UNDER, restitution=0.0)),
        usual("it rests", *_on_floor(_falling(REST), UNDER)),
        usual("slowly, and so it rests", *_on_floor(_falling((1, 0, -1.5)), UNDER)),
        usual("faster than a resting contact by a little", *_on_floor(_falling((1, 0, -2.75)), UNDER)),
        usual("it leaves", *_on_floor(_falling((0, 1, 3)), UNDER)),
        usual("it hardly leaves", *_on_floor(_falling((0, 1, 0.5)), UNDER)),
        usual("a gap that this step closes", *_on_floor(_falling(REST), UNDER, gap=0.0625)),
        usual("a gap that it does not close", *_on_floor(_falling(REST), UNDER, gap=0.25)),
        usual("fast, across a gap that it does not close", *_on_floor(_falling((0, 1, -4)), UNDER, gap=0.75)),
        usual("a gap above a rough floor", *_on_floor(_falling((1, 0, 0)), UNDER, gap=0.0625, friction=0.25)),
        usual("in overlap", *_on_floor(_falling(REST), UNDER, gap=-0.125)),
        usual("it strikes in overlap", *_on_floor(_falling((0, 1, -4)), UNDER, gap=-0.125)),
        usual("it is pulled up", *_on_floor(_falling(REST), UNDER, others=(0, 0, 50))),
        usual("it is pushed aside", *_on_floor(_falling(REST), UNDER, others=(8, 4, 0), turning=(1, 2, 3))),
        usual("with a spin, on a rough floor", *_on_floor(_falling((2, 0, -4), (0, -8, 2)), UNDER, friction=0.25)),
        usual("it is pushed along a rough floor", *_on_floor(_falling(REST), UNDER, others=(8, 4, 0), friction=0.25)),
        usual("pushed hard along a rough floor", *_on_floor(_falling(REST), UNDER, others=(80, 40, 0), friction=0.25)),
        usual("a box stands", *_on_floor(_box(), FOOT)),
        usual("a box lands on its foot", *_on_floor(_box((0.5, 0, -4)), FOOT)),
        usual("a box lands on one corner", *_on_floor(_box((0.5, 0, -4)), FOOT[:1])),
        usual("a box lands on an edge", *_on_floor(_box((0, 0, -4)), FOOT[:2])),
        usual("a box lands, turning", *_on_floor(_box((0, 0, -4), (1.5, 0, 0)), FOOT)),
        usual("a box lands with one edge first", *_on_floor(_box((0, 0, -3), (6, 0, 0)), FOOT, others=(0, 0, 30))),
        usual("a box is pushed over", *_on_floor(_box(), FOOT, others=(0, 20, 0), turning=(-5, 0, 0))),
        usual("a box begins to slide", *_on_floor(_box(), FOOT, others=(12, 6, 0), friction=0.25, sweeps=50)),
        usual("from impulses of the last step",
              *_on_floor(_box(), FOOT, start=[[0.5, 0, 0], [1, 0, 0], [0.75, 0, 0], [1.25, 0, 0]], sweeps=2)),
        usual("two balls in the air", *_row([2, -1], [1, 3], 0.5)),
        usual("the first of three", *_row([2, 0, 0], [1, 1, 1])),
        usual("unequal balls", *_row([2, 0, 0], [3, 1, 2])),
        usual("both ends come together", *_row([2, 0, -2], [1, 3, 1])),
        usual("two that lose", *_row([2, 0], [1, 1], 0.5)),
        usual("different pairs", *_row([2, 0, 0], [1, 1, 1], [[0, 0.5, 0], [0.5, 0, 1], [0, 1, 0]])),
        usual("four, of which one is light", *_row([4, 0, 0, -1], [12, 1, 16, 3])),
        usual("each rough in its own way", *_rough_each_in_its_own_way()),
        usual("impulses of the last step along a rough floor",
              *_on_floor(_box(), FOOT[1:3], others=(4, -6, 0), friction=0.75, sweeps=50,
                         start=[[0.75, 0.125, -0.25], [1, -0.25, 0.125]])),
        usual("a tower, one sweep", *_tower(1)),
        usual("a tower, three sweeps", *_tower(3)),
        usual("a tower, many sweeps", *_tower(40)),
        usual("a tower, from what it carries", *_tower(1, [[7.5, 0, 0], [6.25, 0, 0]])),
        edge("nothing touches", *_on_floor(_falling((1, 2, -4)), [])),
        edge("no sweep", *_tower(0)),
        edge("at rest, without any load", *_row([0, 0], [1, 2])),
        edge("exactly as fast as a resting contact", *_on_floor(_falling((0, 0, -2.5)), bottom)),
    ]  # fmt: skip

    def maker(draw: Draw) -> tuple[Any, ...]:
        a, b = (
            thing(BOX, np.abs(draw.vector(1)) + 0.2, draw.number(1, 4), 3 * draw.vector(1), orientation(draw),
                  draw.vector(3), draw.vector(2))
            for _ in range(2)
        )  # fmt: skip
        bodies, state = world([a, b], draw.number(0.1, 0.9))
        touching = contacts((0, 1, state[0].mean(axis=0) + draw.vector(0.3), draw.unit(), draw.number(-0.05, 0.05)))
        return bodies, state, touching, load(bodies, draw.vector(9), draw.vector(3)), 0.125, 1.0, 4, np.zeros((1, 3))

    return made("respond", by_hand, maker, count=8, single=range(8))


# The step


def _stepping() -> list[Probe]:
    rules = (0.5, 0.01, 10)
    fall, none = WEIGHT, np.zeros(3)
    ball = thing(BALL, 0.5, 2.0, (1, 2, 3), LEANS, (1, 0.5, -2), (1, -2, 0.5))
    brick = thing(BOX, (1, 0.5, 2), 3.0, (1, 2, 5), LEANS, (1, 0.5, -2), (1, -2, 3))
    lands = thing(BOX, (1, 0.5, 2), 3.0, (1, 2, 1.9), UNTURNED, (1, 0, -4), (0.5, 0, 0))
    stands = thing(BOX, (1, 0.5, 2), 3.0, (1, 2, 2))
    sunk = thing(BALL, 0.5, 2.0, (1, 2, 0.4))
    deep = thing(BOX, (2, 0.5, 0.25), 3.0, (1, 2, 0.3), (0.9, 0.1, 0.3, 0.3), (0.5, -0.25, -0.1), (0.3, -0.4, 0.2))
    tower = [FLOOR, thing(BALL, 0.5, 1.0, (0, 0, 0.5)), thing(BALL, 1.0, 5.0, (0, 0, 2))]
    moves = thing(BOX, (1, 1, 0.5), position=(0, 0, 0), velocity=(0, 0, 2), spin=(0, 0, 3))
    by_hand = [
        usual("a ball flies", *world([ball]), fall, 0.125, rules),
        usual("a ball flies, without weight", *world([ball]), none, 0.125, rules),
        usual("a brick tumbles", *world([brick]), none, 0.125, rules),
        usual("a brick falls and tumbles", *world([brick, FLOOR]), fall, 0.125, rules),
        usual("slanted weight", *world([ball, brick]), np.array([1.0, -2.0, -3.0]), 0.125, rules),
        usual("a ball lands", *world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, 0.45), UNTURNED, (1, 0, -4))]), fall, 0.125,
              rules),
        usual("a ball comes near", *world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, 0.75), UNTURNED, (1, 0, -4))]), fall,
              0.125, rules),
        usual("a ball rests", *world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, 0.5))]), fall, 0.125, rules),
        usual("a ball is in the floor", *world([FLOOR, sunk]), fall, 0.125, rules),
        usual("a ball is almost at rest", *world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, 0.505))]), fall, 0.125, rules),
        usual("a box stands", *world([FLOOR, stands], 0.5), fall, 0.125, rules),
        usual("a box lands", *world([FLOOR, lands], 0.5), fall, 0.125, rules),
        usual("a box lands on a rough floor", *world([FLOOR, lands], 0.5, 0.25), fall, 0.125, rules),
        usual("two balls strike", *world([ball, thing(BALL, 1, 5.0, (1.5, 2.5, 1.8))]), fall, 0.125, rules),
        usual("a lift carries a ball", *world([moves, thing(BALL, 0.5, 2.0, (0.25, 0, 1))], 0.0), fall, 0.125, rules),
        usual("a ball slides", *world([FLOOR, thing(BALL, 0.5, 2.0, (1, 2, 0.5), UNTURNED, (2, 1, 0))], 0.0, 0.25),
              fall, 0.125, rules),
        usual("a memory", *world([FLOOR, thing(BALL, 0.5, 1.0, (0, 0, 0.5)), thing(BALL, 1.0, 5.0, (0, 0, 2))]), fall,
              0.125, (0.5, 0.01, 1), (65536 * np.array([3, 5]), np.array([[7.0, 0, 0], [6, 0, 0]]))),
        usual("pushed and turned", *world([ball, brick]), fall, 0.125, rules, EMPTY,
              np.array([[4.0, 2, 1], [-3, 6, 9]]), np.array([[0.5, 0.25, -1], [1, 2, 3]])),
        usual("pushed onto the floor", *world([FLOOR, stands]), fall, 0.125, rules, EMPTY,
              np.array([[0.0, 0, 0], [0, 0, -9]]), np.array([[0.0, 0, 0], [0, 0, 4]])),
        usual("a box deep in the floor", *world([FLOOR, deep]), fall, 0.125, (0.5, 0.01, 3), EMPTY, np.zeros((2, 3)),
              np.array([[0.0, 0, 0], [3, 1, -2]])),
        usual("a tower, one sweep", *world(tower), fall, 0.125, (0.5, 0.01, 1)),
        edge("nothing but the floor", *world([FLOOR]), fall, 0.125, rules),
        edge("a step of a millisecond", *world([FLOOR, lands], 0.5), fall, 0.001, rules),
    ]  # fmt: skip
    maker = lambda draw: (  # noqa: E731
        *world([thing(BALL, 0.5, draw.number(1, 3), draw.vector(), orientation(draw), draw.vector(), draw.vector()),
                thing(BOX, np.abs(draw.vector(1)) + 0.2, draw.number(1, 3), draw.vector(9), orientation(draw),
                      draw.vector(), draw.vector(2))]),
        draw.vector(), 0.125, rules,
    )  # fmt: skip
    return made("step_world", by_hand, maker, count=9, single=range(5))


TABLE = {"collect_contacts": _collecting, "respond": _responding, "step_world": _stepping}
