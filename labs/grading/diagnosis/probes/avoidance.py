"""Probes of the functions about avoidance: steering, fields, ways around, flocks and half-planes."""

from __future__ import annotations

import itertools

import numpy as np

from labs.grading.diagnosis.probes.probe import Arguments, Draw, Probe, edge, made, refused, usual
from reference.arrays import Integers

REST = [0.0, 0.0, 0.0]


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def _seek() -> list[Probe]:
    by_hand = [
        usual("along an axis", [0, 0, 0], [4, 0, 0], 2.0),
        usual("slanted", [1, -2, 3], [3, -1, 1], 3.0),
        usual("to the other side", [3, -1, 1], [1, -2, 3], 1.5),
        usual("in the plane", [1, 1], [4, 5], 2.0),
        usual("near the target", [1, 2, 3], [1.02, 1.99, 3.02], 3.0),
        usual("far away", [100, -200, 50], [-300, 200, 250], 3.0),
        usual("slowly", [1, -2, 3], [3, -1, 1], 0.25),
        usual("a target at the origin", [2, -3, 6], REST, 3.5),
        usual("from the origin", REST, [2, -3, 6], 3.5),
        edge("at the target", [1, -2, 3], [1, -2, 3], 3.0),
        edge("at the target in the origin", REST, REST, 3.0),
        edge("no speed", [1, -2, 3], [3, -1, 1], 0.0),
        edge("a hair's breadth away", REST, [2e-5, -1e-5, 2e-5], 3.0),
        edge("hardly away at all", REST, [2e-10, -1e-10, 2e-10], 3.0),
        refused("a negative speed", [1, -2, 3], [3, -1, 1], -1.0),
    ]
    return made("seek", by_hand, lambda draw: (draw.vector(), draw.vector(), draw.number(0.5, 4)))


def _arrive() -> list[Probe]:
    by_hand = [
        usual("outside the radius", [0, 0, 0], [4, 0, 0], 2.0, 1.0),
        usual("inside the radius", [0, 0, 0], [4, 0, 0], 2.0, 8.0),
        usual("slanted, outside", [1, -2, 3], [3, -1, 1], 3.0, 2.0),
        usual("slanted, inside", [1, -2, 3], [3, -1, 1], 3.0, 6.0),
        usual("the other way, inside", [3, -1, 1], [1, -2, 3], 1.5, 6.0),
        usual("in the plane, outside", [1, 1], [4, 5], 2.0, 4.0),
        usual("in the plane, inside", [1, 1], [4, 5], 2.0, 10.0),
        usual("just inside", [1, -2, 3], [3, -1, 1], 3.0, 3.125),
        usual("just outside", [1, -2, 3], [3, -1, 1], 3.0, 2.875),
        usual("near the target", [1, 2, 3], [1.02, 1.99, 3.02], 3.0, 2.0),
        usual("nearly there", [1, 2, 3], [1.002, 1.999, 3.002], 3.0, 6.0),
        usual("far away", [100, -200, 50], [-300, 200, 250], 3.0, 2.0),
        usual("a small radius", [1, -2, 3], [1.5, -1.75, 2.5], 0.5, 0.25),
        edge("on the radius", [1, -2, 3], [3, -1, 1], 3.0, 3.0),
        edge("at the target", [1, -2, 3], [1, -2, 3], 3.0, 2.0),
        edge("no speed", [1, -2, 3], [3, -1, 1], 0.0, 2.0),
        refused("a radius of zero", [1, -2, 3], [3, -1, 1], 3.0, 0.0),
        refused("a negative speed", [1, -2, 3], [3, -1, 1], -3.0, 2.0),
    ]

    def maker(draw: Draw) -> Arguments:
        return draw.vector(), draw.vector(), draw.number(0.5, 4), draw.number(2, 12)

    return made("arrive", by_hand, maker)


def _field() -> list[Probe]:
    up, leans = [0, 0, 1], [1 / 3, 2 / 3, -2 / 3]
    by_hand = [
        usual("halfway", 1.0, up, 8.0, 2.0),
        usual("a quarter of the way", 0.5, up, 8.0, 2.0),
        usual("halfway, slanted", 1.0, leans, 6.0, 2.0),
        usual("near the reach", 1.75, leans, 6.0, 2.0),
        usual("a longer reach", 1.0, leans, 6.0, 4.0),
        usual("a short reach", 0.125, leans, 6.0, 0.5),
        usual("beyond the reach", 3.0, leans, 6.0, 2.0),
        usual("far beyond the reach", 30.0, leans, 6.0, 2.0),
        usual("inside the obstacle", -0.5, leans, 6.0, 2.0),
        usual("deep inside the obstacle", -5.0, up, 6.0, 2.0),
        usual("a weak field", 1.0, leans, 0.25, 2.0),
        edge("on the surface", 0.0, leans, 6.0, 2.0),
        edge("at the reach", 2.0, leans, 6.0, 2.0),
        edge("no field", 1.0, leans, 0.0, 2.0),
        refused("a normal that is not of unit length", 1.0, [0, 0, 2], 6.0, 2.0),
        refused("a reach of zero", 1.0, up, 6.0, 0.0),
        refused("a negative strength", 1.0, up, -6.0, 2.0),
    ]

    def maker(draw: Draw) -> Arguments:
        reach = draw.number(0.5, 5)
        return round(draw.number(-0.3, 1.3) * reach, 3), draw.unit(), draw.number(0.5, 20), reach

    return made("repelling_force", by_hand, maker)


def _tangent() -> list[Probe]:
    middle = [1, -2, 3]
    by_hand = [
        usual("it heads to the left", [-4, -2, 3], [2, 1, 0], middle, 3.0),
        usual("it heads to the right", [-4, -2, 3], [2, -1, 0], middle, 3.0),
        usual("it heads up", [-4, -2, 3], [2, 0, 1], middle, 3.0),
        usual("it heads down and to the left", [-4, -2, 3], [1, 0.5, -1], middle, 4.0),
        usual("slanted", [5, 4, 5], [-1, 2, 0.5], middle, 2.0),
        usual("slanted, the other side", [5, 4, 5], [-1, -2, -0.5], middle, 2.0),
        usual("far away", [40, -30, 20], [-4, 1, 3], middle, 2.0),
        usual("near the sphere", [3.5, -2, 3], [-1, 1, 1], middle, 2.0),
        usual("it flies away", [-4, -2, 3], [-2, 1, 0.5], middle, 3.0),
        usual("a large sphere", [-12, -2, 3], [1, 0.25, -0.5], middle, 12.0),
        usual("inside the sphere", [2, -1, 4], [-1, 2, 0.5], middle, 3.0),
        usual("inside the sphere, farther out", [-1, -3.5, 3.5], [2, 1, 0], middle, 3.0),
        edge("straight at the centre", [-4, -2, 3], [2, 0, 0], middle, 3.0),
        edge("straight away from the centre", [-4, -2, 3], [-2, 0, 0], middle, 3.0),
        edge("without a heading", [-4, -2, 3], REST, middle, 3.0),
        edge("straight down at the centre", [1, -2, 9], [0, 0, -2], middle, 3.0),
        edge("on the surface", [4, -2, 3], [-1, 2, 1], middle, 3.0),
        edge("at the centre", middle, [1, 2, 0], middle, 3.0),
        refused("a radius of zero", [-4, -2, 3], [2, 1, 0], middle, 0.0),
        refused("a place that is no number", [float("nan"), 2, 3], [2, 1, 0], middle, 3.0),
    ]

    def maker(draw: Draw) -> Arguments:
        centre, radius = draw.vector(), draw.number(0.5, 3)
        far = draw.number(0.7, 4) * radius
        position = (centre + far * draw.unit()).round(3)
        return position, draw.vector(3), centre, radius

    return made("tangent_point", by_hand, maker)


def _approach() -> list[Probe]:
    by_hand = [
        usual("they pass", [7, -2, 0], [-1, 3, 5], [1, -2, 3], [1, 2, 3], 0.5, 0.25),
        usual("they pass, unlike radii", [-4, 1, 0], [2, 0, 0], [3, -1, 2], [-1, 0.5, 0], 0.25, 1.0),
        usual("they will overlap", [7, -2, 0], [-1, 3, 5], [1, -2, 3], [1, 2, 3], 2.0, 1.5),
        usual("they move apart", [7, 0, 6], [2, 1, 2], [1, -2, 3], [0, 0, 0], 1.0, 0.5),
        usual("they move apart and overlap", [2, 0, 4], [2, 1, 2], [1, -2, 3], [0, 0, 0], 2.0, 1.5),
        usual("A alone moves", [-4, 1, 0], [2, 0, 0.5], [3, -1, 2], REST, 0.25, 1.0),
        usual("B alone moves", [-4, 1, 0], REST, [3, -1, 2], [-1, 0.5, 0], 0.25, 1.0),
        usual("a wind carries both", [-4, 1, 0], [12, 7, 0], [3, -1, 2], [9, 7.5, 0], 0.25, 1.0),
        usual("side by side", [1, 2, 0], [3, 1, 2], [4, 2, 4], [3, 1, 2], 0.5, 1.0),
        usual("slowly", [-4, 1, 0], [0.2, 0, 0], [3, -1, 2], [-0.1, 0.05, 0], 0.25, 1.0),
        usual("two points", [7, -2, 0], [-1, 3, 5], [1, -2, 3], [1, 2, 3], 0.0, 0.0),
        edge("head-on", [-4, 0, 0], [2, 0, 0], [4, 0, 0], [-1, 0, 0], 1.0, 0.5),
        edge("nearest now", [3, 0, 0], [0, 2, 0], [1, 0, 0], [0, -1, 0], 0.5, 0.25),
        edge("both at rest", [-4, 1, 0], REST, [3, -1, 2], REST, 0.25, 1.0),
        edge("at one place", [1, 2, 3], [1, 0, 0], [1, 2, 3], [0, 2, 0], 0.25, 1.0),
        refused("a negative radius", [-4, 1, 0], [2, 0, 0], [3, -1, 2], [-1, 0, 0], -0.5, 1.0),
        refused("a place that is no number", [float("nan"), 1, 0], [2, 0, 0], [3, -1, 2], [-1, 0, 0], 0.5, 1.0),
    ]

    def maker(draw: Draw) -> Arguments:
        place, velocity, towards = draw.vector(), draw.vector(3), draw.vector(3)
        start = place - draw.number(-0.5, 2) * towards + draw.vector(1.5)
        radii = draw.number(0.2, 1.5), draw.number(0.2, 1.5)
        return start.round(3), velocity + towards, place, velocity, *radii

    return made("nearest_approach", by_hand, maker)


def _pairs(*pairs: tuple[int, int]) -> tuple[Integers, Integers]:
    """Indices of pairs, as `neighbour_pairs` gives them."""
    both = np.array(pairs, dtype=int).reshape(-1, 2)
    return both[:, 0], both[:, 1]


def _some(draw: Draw, count: int) -> tuple[Integers, Integers]:
    """About two thirds of all pairs."""
    return _pairs(*(pair for pair in itertools.combinations(range(count), 2) if draw.number(0, 3) < 2))


FOUR = [[1, -2, 3], [3, -1, 1], [1, 1, 7], [-2, -4, 9]]


def _flock(name: str) -> list[Probe]:
    by_hand = [
        usual("two", [[1, -2, 3], [3, -1, 1]], *_pairs((0, 1))),
        usual("two, near each other", [[1, -2, 3], [1.5, -2.25, 3.5]], *_pairs((0, 1))),
        usual("two in the plane", [[1, 1], [4, 5]], *_pairs((0, 1))),
        usual("one with two neighbours", FOUR, *_pairs((0, 1), (0, 2))),
        usual("another with two neighbours", FOUR, *_pairs((0, 2), (1, 2))),
        usual("a chain", FOUR, *_pairs((0, 1), (1, 2), (2, 3))),
        usual("two pairs", FOUR, *_pairs((0, 3), (1, 2))),
        usual("all", FOUR, *_pairs(*itertools.combinations(range(4), 2))),
        usual("one alone beside two", FOUR[:3], *_pairs((0, 2))),
        usual("all, in the plane", [[1, 1], [4, 5], [-2, 3], [0, -3], [2, 2]], *_pairs((0, 1), (0, 4), (1, 4), (2, 3))),
        edge("nobody near", FOUR, *_pairs()),
        edge("two at one place", [[1, -2, 3], [1, -2, 3], [2, 0, 1]], *_pairs((0, 1), (0, 2), (1, 2))),
        edge("all at one place", [[1, -2, 3]] * 3, *_pairs((0, 1), (0, 2), (1, 2))),
        edge("one alone", [[1, -2, 3]], *_pairs()),
    ]

    def maker(draw: Draw) -> Arguments:
        count = 3 + int(draw.number(0, 2.9))
        return np.array([draw.vector(3) for _ in range(count)]), *_some(draw, count)

    return made(name, by_hand, maker, single=range(3))


def _half_plane() -> list[Probe]:
    def told(ahead: float, left: float, horizon: float, radii: tuple[float, float] = (2.0, 1.0)) -> Arguments:
        """B is 5 m from A, in the direction of (0.6, 0.8), where the relative velocity has these two parts."""
        velocity = np.array([0.5, -1.0])
        relative = np.array([0.6 * ahead - 0.8 * left, 0.8 * ahead + 0.6 * left])
        return [1, -2], velocity + relative, radii[0], [4, 2], velocity, radii[1], horizon, 0.1

    by_hand = [
        usual("inside the cone, on the left", *told(2, 0.5, 10.0)),
        usual("inside the cone, on the right", *told(2, -0.5, 10.0)),
        usual("deep inside the cone", *told(6, 1.0, 4.0)),
        usual("outside the cone, on the left", *told(1, 2, 8.0)),
        usual("outside the cone, on the right", *told(1, -2.5, 8.0)),
        usual("they move apart", *told(-2, 0.5, 4.0)),
        usual("they move apart sideways", *told(-0.5, 3.0, 4.0)),
        usual("at the round end, inside", *told(1.75, 0.25, 2.0)),
        usual("at the round end, outside", *told(0.5, -0.25, 2.0)),
        usual("smaller discs", *told(3, 0.25, 5.0, (0.25, 0.5))),
        usual("B alone moves", [1, -2], [0, 0], 0.5, [4, 2], [-1, -1.5], 0.25, 6.0, 0.1),
        usual("A alone moves", [1, -2], [1, 1.25], 0.5, [4, 2], [0, 0], 0.25, 6.0, 0.1),
        usual("side by side", [1, -2], [1, 1], 0.5, [4, 2], [1, 1], 0.25, 6.0, 0.1),
        usual("they overlap", [1, -2], [1, 1], 2.0, [2, 0], [0.5, -1], 1.0, 6.0, 0.125),
        usual("they overlap and part fast", [1, -2], [-90, -40], 2.0, [2, 0], [0.5, -1], 1.0, 6.0, 0.125),
        edge("exactly head-on", [0, 0], [1, 0], 0.5, [6, 0], [-1, 0], 0.5, 8.0, 0.1),
        edge("exactly head-on, from the right", [0, 0], [-1, 0], 0.5, [-6, 0], [1, 0], 1.0, 8.0, 0.1),
        edge("exactly head-on, upwards", [0, 0], [0, 1], 0.5, [0, 6], [0, -1], 1.0, 8.0, 0.1),
        edge("they touch", [0, 0], [1, 0.5], 2.0, [3, 0], [-1, 0], 1.0, 8.0, 0.25),
        edge("two points", [0, 0], [1, 0.25], 0.0, [4, 0], [-1, 0], 0.0, 8.0, 0.1),
        edge("both at rest", [1, -2], [0, 0], 0.5, [4, 2], [0, 0], 0.25, 6.0, 0.1),
        edge("at one place", [1, 2], [1, 0.5], 0.5, [1, 2], [0, 0], 0.5, 6.0, 0.1),
        refused("a negative radius", [1, -2], [1, 1], -0.5, [4, 2], [0, 0], 0.25, 6.0, 0.1),
        refused("a horizon of zero", [1, -2], [1, 1], 0.5, [4, 2], [0, 0], 0.25, 0.0, 0.1),
    ]

    def maker(draw: Draw) -> Arguments:
        a, ahead, va, vb = (draw.vector(size)[:2] for size in (4, 4, 2, 2))
        far = float(np.linalg.norm(ahead))
        radii = draw.number(0.1, 0.5) * far, draw.number(0.1, 0.4) * far
        return a, va, round(radii[0], 3), a + ahead, vb, round(radii[1], 3), draw.number(2, 9), draw.number(0.05, 0.3)

    return made("orca_half_plane", by_hand, maker)


def _separation() -> list[Probe]:
    return _flock("separation")


def _mean() -> list[Probe]:
    return _flock("towards_mean")


_TABLE = {
    "seek": _seek,
    "arrive": _arrive,
    "repelling_force": _field,
    "tangent_point": _tangent,
    "nearest_approach": _approach,
    "separation": _separation,
    "towards_mean": _mean,
    "orca_half_plane": _half_plane,
}
