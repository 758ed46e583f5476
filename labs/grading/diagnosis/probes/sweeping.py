"""Probes of the functions about swept volumes: rays, balls, boxes, capsules, and bodies that turn."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes.probe import Arguments, Draw, Probe, edge, made, refused, usual
from reference.arrays import Array

REST = [0.0, 0.0, 0.0]
INFINITY = float("inf")


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def _across(draw: Draw, way: Array, distance: float) -> Array:
    """A vector at right angles to a way, of this length."""
    across = np.cross(way, draw.vector())
    return np.asarray(distance * across / np.linalg.norm(across))


def _passing(draw: Draw, way: Array, radius: float) -> Array:
    """Where a point is now that passes the origin at a share of a radius, and is outside of it."""
    beside = _across(draw, way, draw.number(0.05, 0.95) * radius)
    return np.asarray((beside - (draw.number(0.2, 2) + radius / np.linalg.norm(way)) * way).round(3))


def _sphere() -> list[Probe]:
    by_hand = [
        usual("straight at the sphere", [-5, 0, 0], [2, 0, 0], 1.0),
        usual("past the middle", [-6, 1, 1], [3, 0, 0], 2.0),
        usual("slanted", [4, -3, 2], [-2, 1, -1], 1.5),
        usual("a miss", [-6, 3, 0], [2, 0, 0], 2.0),
        usual("away from the sphere", [5, 0.5, 0], [2, 0, 0], 1.0),
        usual("away from the sphere, slanted", [4, -3, 2], [2, -1, 1], 1.5),
        usual("from inside", [0.5, 0.25, 0], [3, 0, 1], 2.0),
        usual("from inside, to the middle", [1, 0, -1], [-2, 0, 1], 2.0),
        usual("from inside, slanted", [1, -1, 0.5], [1, 2, 3], 3.0),
        usual("from just inside, out of it", [0, 2.75, 0], [1, 4, -1], 3.0),
        usual("from just inside, through it", [0, 2.75, 0], [1, -4, -1], 3.0),
        usual("on the surface, on its way out", [3, 0, 0], [1, 2, 0], 3.0),
        usual("on the surface, on its way in", [1, 2, 2], [-1, 0, -1], 3.0),
        usual("far away and slow", [40, 1, 0], [-0.5, 0, 0], 2.0),
        edge("it grazes the sphere", [-4, 0, 2], [2, 0, 0], 2.0),
        edge("it just misses", [-4, 0, 2.01], [2, 0, 0], 2.0),
        edge("into a grain of dust", [5e-6, 4e-6, 2e-6], [-2e-6, -1e-6, 0], 3e-6),
        edge("away from a grain of dust", [5e-6, 4e-6, 2e-6], [2e-6, 1e-6, 0], 3e-6),
        edge("it nearly grazes the sphere, behind its start", [4, 0, 1.99], [2, 0, 0], 2.0),
        edge("no direction, outside", [3, 1, 0], REST, 2.0),
        edge("no direction, inside", [1, 1, 0], REST, 2.0),
        edge("no direction, on the surface", [0, 2, 0], REST, 2.0),
        edge("a point that is met", [0, 0, -6], [0, 0, 3], 0.0),
        edge("a point that is missed", [0, 0.25, -6], [0, 0, 3], 0.0),
        edge("it starts in the middle", REST, [1, 2, 3], 1.0),
        edge("it starts at the point", REST, [1, 2, 3], 0.0),
        refused("a negative radius", [-5, 0, 0], [2, 0, 0], -1.0),
        refused("a start that is no number", [float("nan"), 0, 0], [2, 0, 0], 1.0),
    ]

    def maker(draw: Draw) -> Arguments:
        way, radius = draw.vector(3), draw.number(0.5, 2.5)
        return _passing(draw, way, radius), way, radius

    return made("ray_sphere", by_hand, maker)


def _balls() -> list[Probe]:
    by_hand = [
        usual("head-on, both move", [-4, 0, 0], [2, 0, 0], 1.0, [4, 0, 0], [-1, 0, 0], 0.5, 4.0),
        usual("one flies past the other's middle", [-5, 1, 0], [3, 0, 1], 1.0, [2, 0, 1], [1, 0, 1], 1.5, 4.0),
        usual("B alone moves", [1, 2, 3], REST, 0.5, [5, 2, 2], [-2, 0, 0.5], 1.0, 4.0),
        usual("a wind carries both", [-4, 0, 0], [12, 5, 0], 1.0, [4, 0, 0], [9, 5, 0], 0.5, 4.0),
        usual("they meet after the step", [-4, 0, 0], [2, 0, 0], 1.0, [4, 0, 0], [-1, 0, 0], 0.5, 2.0),
        usual("they miss", [-4, 3, 0], [2, 0, 0], 1.0, [4, 0, 0], [-1, 0, 0], 0.5, 4.0),
        usual("they part", [-4, 0, 1], [-2, 0, 0], 1.0, [4, 0, 0], [1, 0, 0], 0.5, 4.0),
        usual("side by side", [1, 2, 0], [3, 1, 2], 0.5, [4, 2, 0], [3, 1, 2], 1.0, 4.0),
        usual("they overlap and part", [1, 0, 0], [2, 0, 0], 1.0, [2, 0, 0], [5, 0, 0], 0.5, 1.0),
        usual("they overlap and part, slanted", [1, 0, 2], [2, 1, 0], 1.0, [2, 1, 2], [5, 3, -1], 1.0, 3.0),
        usual("they overlap and come nearer", [1, 0, 2], [2, 1, 0], 1.0, [2, 1, 2], [-1, 0.5, 1], 1.0, 3.0),
        usual("they touch and part", [0, 0, 1], [0, 0, 1], 1.0, [0, 0, 4], [0, 0, 2], 2.0, 1.0),
        usual("the faster one comes from behind", [-5, 0.5, 0], [6, 0, 0], 0.5, [1, 0, 0], [2, 0, 0], 1.0, 3.0),
        edge("they meet at the end of the step", [-5, 0, 0], [2, 0, 0], 1.0, [0, 0, 0], [-1, 0, 0], 1.0, 1.0),
        edge("the step has no end", [-90, 1, 0], [2, 0, 0], 1.0, [0, 0, 0], [1, 0, 0], 1.0, INFINITY),
        edge("the step has no end, and they miss", [-90, 3, 0], [2, 0, 0], 1.0, REST, [1, 0, 0], 1.0, INFINITY),
        edge("a step of no length, apart", [-4, 0, 0], [2, 0, 0], 1.0, [4, 0, 0], [-1, 0, 0], 0.5, 0.0),
        edge("a step of no length, in touch", [0, 1, 0], [2, 0, 0], 1.0, [0, 4, 0], [-1, 0, 0], 2.0, 0.0),
        edge("two points that meet", [-4, 1, 3], [2, 0, 1], 0.0, [2, 1, 3], [-1, 0, 1], 0.0, 4.0),
        edge("a ball and a point", [-4, 0.5, 0], [2, 0, 0], 1.0, [4, 0, 0], [-1, 0, 0], 0.0, 4.0),
        edge("they graze each other", [-4, 3, 0], [2, 0, 0], 1.0, [4, 0, 0], [-2, 0, 0], 2.0, 4.0),
        refused("a negative radius", [-4, 0, 0], [2, 0, 0], -1.0, [4, 0, 0], [-1, 0, 0], 0.5, 4.0),
        refused("a step of negative length", [-4, 0, 0], [2, 0, 0], 1.0, [4, 0, 0], [-1, 0, 0], 0.5, -4.0),
    ]

    def maker(draw: Draw) -> Arguments:
        way, place, velocity = draw.vector(3), draw.vector(), draw.vector(3)
        radius_a, radius_b = draw.number(0.2, 1.5), draw.number(0.2, 1.5)
        start = _passing(draw, way, radius_a + radius_b)
        return place + start, velocity + way, radius_a, place, velocity, radius_b, draw.number(1.2, 5)

    return made("sweep_sphere_sphere", by_hand, maker)


def _share() -> list[Probe]:
    by_hand = [
        usual("as far as both radii", 10.0, 0.5, 1.5, 0.2),
        usual("a short way", 4.0, 0.5, 1.5, 0.1),
        usual("a way of many diameters", 40.0, 0.5, 1.5, 1.0),
        usual("a little longer than the longest chord", 50.0, 0.5, 1.5, 0.1),
        usual("a ball and a point", 20.0, 0.0, 2.0, 0.1),
        usual("a point and a ball", 20.0, 2.0, 0.0, 0.3),
        usual("two marbles at 40 m/s and 240 looks a second", 40.0, 0.01, 0.01, 1 / 240),
        edge("just the longest chord", 40.0, 0.5, 1.5, 0.1),
        edge("at rest", 0.0, 0.5, 1.5, 0.1),
        edge("one look after the other at once", 10.0, 0.5, 1.5, 0.0),
        edge("two points", 10.0, 0.0, 0.0, 0.1),
        edge("two points at rest", 0.0, 0.0, 0.0, 0.1),
        edge("very fast", 1e6, 0.5, 1.5, 0.1),
        refused("a negative radius", 10.0, -0.5, 1.5, 0.1),
        refused("a negative time", 10.0, 0.5, 1.5, -0.1),
        refused("an infinite speed", INFINITY, 0.5, 1.5, 0.1),
    ]

    def maker(draw: Draw) -> Arguments:
        return draw.number(1, 20), draw.number(0.1, 1), draw.number(0.1, 1), draw.number(0.05, 0.4)

    return made("missed_share", by_hand, maker)


def _box() -> list[Probe]:
    half = [1, 2, 3]
    by_hand = [
        usual("slanted, through three faces", [-4, -5, 2], [2, 3, -1], half),
        usual("in through one face and out through another", [-3, 0, 0], [2, 1.5, 0.5], half),
        usual("along an axis", [-3, 0.5, 0.5], [2, 0, 0], half),
        usual("along another, backwards", [0.5, 0.5, 9], [0, 0, -2], half),
        usual("from within", [0.5, -1, 2], [2, 1, -4], half),
        usual("from within, along an axis", [0.5, -1, 2], [0, 3, 0], half),
        usual("the box is behind it", [4, 5, 2], [2, 3, 1], half),
        usual("the box is behind it, along an axis", [3, 0.5, 0.5], [2, 0, 0], half),
        usual("the box is behind it, slanted", [-4, -3, -6], [-2, -1, -3], half),
        usual("past a corner", [-4, -5, 2], [2, 1, -1], half),
        usual("in the slabs of x and y, but never at the same time", [-5, 4, 0], [2, 2, 0], half),
        usual("beside the box, along an axis", [-3, 2.5, 0.5], [2, 0, 0], half),
        usual("beside the box, along a diagonal of two axes", [-3, -4, 4], [1, 1, 0], half),
        usual("a small box far away", [40, -20, 10], [-8, 4, -2], [0.5, 0.25, 0.125]),
        edge("more slowly than anything is measured", [-4, -5, 2], [2e-18, 3e-18, -1e-18], half),
        edge("along a face, on it", [-3, 2, 0.5], [2, 0, 0], half),
        edge("along an edge, on it", [-3, 2, 3], [2, 0, 0], half),
        edge("along a face, on it, at the other side", [-3, -2, 0.5], [2, 0, 0], half),
        edge("on a face, on its way out", [1, 0.5, 0.5], [2, 1, 0], half),
        edge("on a face, on its way in", [-1, 0.5, 0.5], [2, 1, 0], half),
        edge("it grazes an edge", [-3, 0, 0.5], [1, 1, 0], half),
        edge("no direction, inside", [0.5, -1, 2], REST, half),
        edge("no direction, outside", [0.5, -3, 2], REST, half),
        edge("no direction, on a face", [0.5, -2, 2], REST, half),
        edge("a sheet that it crosses", [-4, 1, 2], [2, 0.25, -1], [0, 2, 3]),
        edge("a sheet that it lies in", [0, -5, 2], [0, 2, -1], [0, 2, 3]),
        edge("a point that it meets", [-4, -2, 2], [2, 1, -1], REST),
        edge("a point where it starts", REST, REST, REST),
        refused("a negative edge", [-4, 0, 0], [2, 0, 0], [1, -2, 3]),
        refused("a direction that is no number", [-4, 0, 0], [2, float("nan"), 0], half),
    ]

    def maker(draw: Draw) -> Arguments:
        way, edges = draw.vector(3), np.abs(draw.vector(2)) + 0.5
        inside = np.array([draw.number(-0.95, 0.95) for _ in range(3)]) * edges
        return (inside - draw.number(-0.2, 2) * way).round(3), way, edges

    return made("ray_box", by_hand, maker)


def _capsule() -> list[Probe]:
    start, end = [1, -1, 2], [3, 3, 6]  # 6 m long
    by_hand = [
        usual("at the side", [6, -1, 4], [-2, 1, 0], start, end, 1.0),
        usual("at the side, from the other side", [-4, 3, 5], [2, -1, -0.25], start, end, 1.0),
        usual("at the first cap", [-1, -5, 0], [1, 2, 1], start, end, 1.0),
        usual("at the second cap", [5, 7, 9], [-1, -2, -1.5], start, end, 1.0),
        usual("past the first end, at the second cap", [5, -2.6, 5.2], [-1, 4, 1], start, end, 1.0),
        usual("past the second end, at the first cap", [5.4, -1.8, 6], [-3, 0, -3], start, end, 1.0),
        usual("along it, at the first end", [-1, -5, -2], [1, 2, 2], start, end, 1.0),
        usual("along it, at the second end", [5, 7, 10], [-1, -2, -2], start, end, 1.0),
        usual("along it, beside its middle", [-1, -4.5, -2.5], [1, 2, 2], start, end, 1.0),
        usual("parallel to it, a miss", [3, -5, -2], [1, 2, 2], start, end, 1.0),
        usual("a miss beyond an end", [4, -4, 0], [-2, 1, 0], start, end, 1.0),
        usual("away from it", [6, -1, 4], [2, -1, 0], start, end, 1.0),
        usual("from within, in its middle", [2, 1.5, 4], [3, 1, -1], start, end, 1.0),
        usual("from within, near its middle", [2.25, 1, 4.25], [-2, 2, -0.5], start, end, 1.0),
        usual("from within, slowly", [2, 1, 4], [0.25, -0.25, 0.125], start, end, 1.0),
        edge("from within a cap", [0.75, -1.5, 1.75], [-3, 1, -1], start, end, 1.0),
        usual("along an axis of the world", [0, 1, 9], [0, 0, -2], [-2, 1, 2], [3, 1, 2], 0.5),
        edge("a sphere", [-4, 0, 2], [2, 0.25, 0], [1, 1, 2], [1, 1, 2], 1.5),
        edge("no direction, outside", [6, -1, 4], REST, start, end, 1.0),
        edge("no direction, inside", [2, 1.5, 4], REST, start, end, 1.0),
        edge("the bare segment, met", [-4, 1, 0], [2, 0, 0], [1, -2, 0], [1, 3, 0], 0.0),
        edge("the bare segment, missed", [-4, 1, 0.25], [2, 0, 0], [1, -2, 0], [1, 3, 0], 0.0),
        edge("a short one", [-4, 0, 2], [2, 0.25, 0], [1, 1, 2], [1, 1.01, 2], 1.5),
        edge("it goes on after the side's end", [-3, 0, 1.5], [2, 0, 0.1], [-1, 0, 0], [4, 0, 0], 1.0),
        refused("a negative radius", [6, -1, 4], [-2, 1, 0], start, end, -1.0),
        refused("an end that is no number", [6, -1, 4], [-2, 1, 0], start, [float("nan"), 3, 6], 1.0),
    ]

    def maker(draw: Draw) -> Arguments:
        way, first, second = draw.vector(3), draw.vector(3), draw.vector(3)
        radius, share = draw.number(0.2, 1), draw.number(-0.1, 1.1)
        nearest = first + share * (second - first)
        return (nearest + _passing(draw, way, radius) - draw.number(0, 1) * way).round(3), way, first, second, radius

    return made("ray_capsule", by_hand, maker)


def _bound() -> list[Probe]:
    up, leans = [0, 0, 1], [1 / 3, 2 / 3, -2 / 3]
    by_hand = [
        usual("it only flies", [3, 1, 2], REST, 1.5, up),
        usual("it only flies, backwards", [3, 1, -2], REST, 1.5, up),
        usual("it only turns, across the direction", REST, [4, 0, 0], 1.5, up),
        usual("it only turns, about the direction", REST, [0, 0, 4], 1.5, up),
        usual("it flies and turns", [3, 1, 2], [4, -1, 5], 1.5, up),
        usual("it flies backwards and turns", [3, 1, -9], [1, 2, 0.5], 1.5, up),
        usual("along a slanted direction", [3, 1, -2], [4, -1, 5], 1.5, leans),
        usual("along a slanted direction, about it", [3, 1, -2], [2, 4, -4], 1.5, leans),
        usual("a longer body", [3, 1, 2], [4, -1, 5], 6.0, leans),
        edge("a point", [3, 1, 2], [4, -1, 5], 0.0, leans),
        edge("at rest", REST, REST, 1.5, up),
        edge("it slides along", [3, 1, 0], REST, 1.5, up),
        refused("a negative reach", [3, 1, 2], REST, -1.5, up),
        refused("a normal that is not of unit length", [3, 1, 2], REST, 1.5, [0, 0, 2]),
    ]

    def maker(draw: Draw) -> Arguments:
        return draw.vector(), draw.vector(4), draw.number(0.2, 3), draw.unit()

    return made("motion_bound", by_hand, maker)


ROD = [[-2, 0, 0], [2, 0.25, 0], [0, 0.125, 0.25]]
WEDGE = [[0, 3, -2], [0.5, 3, 2], [2, 5, 0], [-1, 4, 0.5]]
"""Its lowest edge is 3 m above the x axis."""


def _advance() -> list[Probe]:
    box = [[x, y, z] for x in (-0.5, 0.5) for y in (-0.25, 0.25) for z in (-1.0, 1.0)]
    ball, plate = [REST], [[-9, 0, -9], [9, 0, -9], [9, 0, 9], [-9, 0, 9]]
    by_hand = [
        usual("it flies without turning", ROD, REST, [0.25, 2, 0], REST, WEDGE, 4.0, 0.01, 12),
        usual("it flies and turns", ROD, [0, 0.5, 0], [0.25, 1, 0], [0.5, 0, 1.5], WEDGE, 4.0, 0.01, 12),
        usual("it turns on the spot and hits", ROD, [0, 1.5, 0], REST, [0, 0, 1], WEDGE, 4.0, 0.01, 12),
        usual("it turns on the spot and stays clear", ROD, [0, -1, 0], REST, [0, 0, 1], WEDGE, 2.0, 0.01, 12),
        usual("it turns and flies away", ROD, [0, -1, 0], [0, -4, 0], [0, 0, 1], WEDGE, 4.0, 0.01, 12),
        usual("it flies away", ROD, REST, [1, -2, 0.5], REST, WEDGE, 4.0, 0.01, 12),
        usual("it would touch later", ROD, REST, [0.25, 2, 0], REST, WEDGE, 1.0, 0.01, 12),
        usual("it flies past", ROD, [-6, 2, 5], [4, 0, 0], [0, 1, 0], WEDGE, 4.0, 0.01, 12),
        usual("too few looks", ROD, [0, 0.5, 0], [0.25, 1, 0], [0.5, 0, 1.5], WEDGE, 4.0, 0.01, 3),
        usual("a box that tumbles onto a plate", box, [1, 3, 2], [0.5, -1, 0], [0.25, 0.5, 0.5], plate, 5.0, 0.02, 12),
        usual("a point onto a plate", ball, [1, 3, 2], [0.5, -1, 0], [1, 2, 0.5], plate, 5.0, 0.02, 12),
        usual("it overlaps now", ROD, [0, 3.5, 0], [0, -1, 0], [0, 0, 1], WEDGE, 4.0, 0.01, 12),
        usual("a larger tolerance", ROD, [0, 0.5, 0], [0.25, 1, 0], [0.5, 0, 1.5], WEDGE, 4.0, 0.5, 12),
        usual("the last look says that it stays apart", ROD, REST, [0.25, 2, 0], REST, WEDGE, 1.0, 0.01, 1),
        edge("nothing moves", ROD, REST, REST, REST, WEDGE, 4.0, 0.01, 12),
        edge("a step of no length", ROD, REST, [0.25, 2, 0], REST, WEDGE, 0.0, 0.01, 12),
        edge("one look", ROD, REST, [0.25, 2, 0], REST, WEDGE, 4.0, 0.01, 1),
        edge("one look at hulls that overlap", ROD, [0, 3.5, 0], [0, -1, 0], [0, 0, 1], WEDGE, 4.0, 0.01, 1),
        refused("no look", ROD, REST, [0.25, 2, 0], REST, WEDGE, 4.0, 0.01, 0),
        refused("no tolerance", ROD, REST, [0.25, 2, 0], REST, WEDGE, 4.0, 0.0, 12),
        refused("a step of negative length", ROD, REST, [0.25, 2, 0], REST, WEDGE, -4.0, 0.01, 12),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        a, b = (np.array([draw.vector(1) for _ in range(4)]) for _ in range(2))
        place, way, far, speed = draw.vector(2), draw.unit(), draw.number(3, 5), draw.number(1, 3)
        position = place + b.mean(axis=0) - a.mean(axis=0) + far * way
        velocity = (draw.vector(0.25) - speed * way).round(3)
        return (
            a,
            position.round(3),
            velocity,
            draw.vector(1.5),
            place + b,
            draw.number(0.5, 1.2) * far / speed,
            0.02,
            60,
        )

    return made("advance", by_hand, maker, count=10, single=range(8))


_TABLE = {
    "ray_sphere": _sphere,
    "sweep_sphere_sphere": _balls,
    "missed_share": _share,
    "ray_box": _box,
    "ray_capsule": _capsule,
    "motion_bound": _bound,
    "advance": _advance,
}
