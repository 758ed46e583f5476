"""Probes of the functions of an impact: velocities at the contact, its normal, and impulse and momentum."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes import impulse_bodies
from labs.grading.diagnosis.probes.probe import YES_OR_NO, Draw, Probe, edge, made, refused, usual
from reference.arrays import Array

X, Y, UP, LEANS = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3]
REST = [0.0, 0.0, 0.0]


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple((_TABLE | impulse_bodies.TABLE)[function]())


def _point() -> list[Probe]:
    by_hand = [
        usual("no spin", [1, 2, 3], REST, X),
        usual("spin alone", REST, [0, 0, 2], X),
        usual("both", [1, 0, 0], [0, 0, 2], [0, 0.5, 0]),
        usual("the lowest point of a ball that rolls", [1, 0, 0], [0, 2, 0], [0, 0, -0.5]),
        usual("about a slanting axis", [0, 0, 1], [1, 2, 3], [-1, 0, 2]),
        edge("the centre of mass", [1, 2, 3], [4, 5, 6], REST),
        edge("on the axis", [1, 2, 3], [0, 0, 2], [0, 0, 3]),
        edge("at rest", REST, REST, X),
        refused("two components", [1, 2], [0, 0], [1, 0]),
    ]
    return made("point_velocity", by_hand, lambda draw: (draw.vector(), draw.vector(), draw.vector(2)))


def _relative() -> list[Probe]:
    by_hand = [
        usual("A comes down on B at rest", [0, 0, -2], REST),
        usual("B comes up to A at rest", REST, [0, 0, 2]),
        usual("both move", [1, 2, 3], [3, 1, 0]),
        usual("head on", [2, 0, 0], [-2, 0, 0]),
        edge("side by side", [1, 2, 3], [1, 2, 3]),
        edge("both at rest", REST, REST),
        refused("two components", [1, 2], [0, 0]),
    ]
    return made("relative_velocity", by_hand, lambda draw: (draw.vector(), draw.vector()))


def _normal_velocity() -> list[Probe]:
    by_hand = [
        usual("A comes down on B", [1, 0, -2], REST, UP),
        usual("B comes up to A", REST, [0, 3, 2], UP),
        usual("moving apart", [0, 0, 3], [0, 0, -1], UP),
        usual("along a normal that leans", [3, 0, 0], [0, -3, 0], LEANS),
        usual("against the normal", [-1, -2, -2], [1, 0, 0], LEANS),
        edge("along the surface", [3, 1, 0], [-1, 2, 0], UP),
        edge("side by side", [1, 2, 3], [1, 2, 3], UP),
        refused("a normal that is not of unit length", [0, 0, -2], REST, [0, 0, 2]),
    ]
    return made("normal_velocity", by_hand, lambda draw: (draw.vector(), draw.vector(), draw.unit()))


def _rebound() -> list[Probe]:
    by_hand = [
        usual("half comes back", -2.0, 0.5),
        usual("nearly all comes back", -3.0, 0.9),
        usual("moving apart", 2.0, 0.5),
        usual("moving apart slowly", 0.25, 0.8),
        edge("grazing", 0.0, 0.5),
        edge("nothing comes back", -2.0, 0.0),
        edge("all comes back", -2.0, 1.0),
        edge("moving apart, e = 0", 3.0, 0.0),
        refused("a restitution above 1", -2.0, 1.5),
    ]
    return made("rebound_velocity", by_hand, lambda draw: (draw.number(-5, 2), draw.number(0.1, 0.9)))


def _classify() -> list[Probe]:
    by_hand = [
        usual("coming nearer", -2.0, 0.5),
        usual("moving apart", 2.0, 0.5),
        usual("coming nearer slowly", -0.25, 0.5),
        usual("moving apart slowly", 0.25, 0.5),
        usual("coming nearer, no threshold", -1.0),
        usual("moving apart, no threshold", 1.0),
        edge("grazing", 0.0),
        edge("grazing, with a threshold", 0.0, 0.5),
        edge("coming nearer at the threshold", -0.5, 0.5),
        edge("moving apart at the threshold", 0.5, 0.5),
        refused("a velocity that is no number", float("nan"), 0.5),
        refused("a negative threshold", 1.0, -0.5),
    ]
    maker = lambda draw: (draw.number(-2, 2), draw.number(0.1, 1))  # noqa: E731
    return made("classify_contact", by_hand, maker, count=YES_OR_NO)


def _impulse_of_force() -> list[Probe]:
    force, ramp = [[0, 0, 5]] * 3, [[0, 0, 0], [0, 0, 4], [0, 0, 8]]
    by_hand = [
        usual("a constant force", force, [0, 1, 2]),
        usual("a force that grows", ramp, [0, 1, 2]),
        usual("uneven samples", ramp, [0, 0.5, 2]),
        usual("two samples", [[1, 2, 3], [3, 2, 1]], [0, 0.5]),
        usual("it does not start at zero", ramp, [1, 2, 4]),
        usual("a force that turns", [[4, 0, 0], [0, 4, 0], [0, 0, 4], [-4, 0, 0]], [0, 0.25, 0.5, 1]),
        edge("a single sample", [[1, 2, 3]], [0.5]),
        edge("a force that jumps", [[2, 0, 0], [2, 0, 0], [0, 6, 0], [0, 6, 0]], [0, 1, 1, 3]),
        edge("no force", [REST] * 3, [0, 1, 2]),
        refused("time that runs backwards", ramp, [0, 2, 1]),
    ]

    def maker(draw: Draw) -> tuple[Array, Array]:
        steps = [draw.number(0.05, 0.9) for _ in range(4)]
        return np.array([draw.vector(20) for _ in range(5)]), np.round(np.cumsum([draw.number(0, 2), *steps]), 2)

    return made("impulse_of_force", by_hand, maker)


def _mean_force() -> list[Probe]:
    by_hand = [
        usual("the net force", [0, 0, 4], 0.5),
        usual("a ball on the floor, with its weight", [0, 0, 6], 0.25, [0, 0, -10]),
        usual("a short impact", [1, 0, 6], 0.001, [0, 0, -10]),
        usual("a long push", [3, 4, 0], 8.0, [0, 2, -10]),
        edge("no change", REST, 0.5, [0, 0, -10]),
        edge("nothing at all", REST, 0.5, REST),
        refused("no duration", [0, 0, 4], 0.0),
    ]
    return made("mean_force", by_hand, lambda draw: (draw.vector(9), draw.number(0.05, 3), draw.vector(9)))


def _plane_normal() -> list[Probe]:
    by_hand = [
        usual("A above the floor", UP, [0, 0, 1], REST),
        usual("A below the ceiling", UP, [0, 0, -1], REST),
        usual("the normal is not of unit length", [0, 3, 4], [0, 2, 2], REST),
        usual("not of unit length, and to be flipped", [0, 3, 4], REST, [0, 2, 2]),
        usual("centres aside of one another", [1, 2, 2], [5, 0, 1], [1, 1, 1]),
        edge("centres across the normal: as given", [0, 0, 2], [3, 0, 0], REST),
        edge("the same centre", [2, 0, 0], [1, 1, 1], [1, 1, 1]),
        refused("no normal", REST, UP, REST),
    ]
    return made("point_plane_normal", by_hand, lambda draw: (draw.vector(4), draw.vector(3), draw.vector(3)))


def _edge_normal() -> list[Probe]:
    by_hand = [
        usual("crossed at right angles, A above", X, Y, UP, REST),
        usual("crossed at right angles, A below", X, Y, REST, UP),
        usual("the other edge first", Y, X, UP, REST),
        usual("long edges", [3, 0, 0], [0, 5, 0], [0, 0, 2], REST),
        usual("at a small angle", [1, 0, 0], [4, 0.5, 0], [0, 0, 1], REST),
        edge("centres across the normal: along A × B", [2, 0, 0], [0, 3, 0], [1, 0, 0], REST),
        refused("parallel edges", [1, 2, 3], [2, 4, 6], UP, REST),
    ]
    maker = lambda draw: (draw.vector(3), draw.vector(3), draw.vector(3), draw.vector(3))  # noqa: E731
    return made("edge_edge_normal", by_hand, maker)


def _contact_impulses() -> list[Probe]:
    by_hand = [
        usual("up", 2.0, UP),
        usual("along a normal that leans", 3.0, LEANS),
        usual("against the normal", -1.5, LEANS),
        edge("none", 0.0, LEANS),
        refused("a normal that is not of unit length", 2.0, [0, 0, 2]),
    ]
    return made("contact_impulses", by_hand, lambda draw: (draw.number(-5, 9), draw.unit()))


def _momenta() -> list[Probe]:
    by_hand = [
        usual("through the centre", [1, 0, 0], [0, 0, 1], [0, 0, -1], [0, 0, 3]),
        usual("beside the centre", REST, REST, [1, 0, 0], [0, 0, 3]),
        usual("both momenta there", [1, 2, 3], [3, 2, 1], [0, 0.5, 0], [2, 0, 0]),
        edge("no impulse", [1, 2, 3], [3, 2, 1], [0, 0.5, 0], REST),
        edge("at the centre", [1, 2, 3], [3, 2, 1], REST, [2, 0, 1]),
        refused("two components", [1, 2], [0, 0], [1, 0], [0, 1]),
    ]
    maker = lambda draw: (draw.vector(), draw.vector(), draw.vector(1), draw.vector(4))  # noqa: E731
    return made("apply_impulse_to_momenta", by_hand, maker)


def _velocities() -> list[Probe]:
    by_hand = [
        usual("a body along the axes", [2, 4, 6], [1, 2, 3], 0.5, np.diag([1.0, 2.0, 4.0])),
        usual("no spin", [2, 4, 6], REST, 0.25, np.eye(3)),
        usual("a turned body", [0, 0, 1], [0, 0, 1], 2.0, [[2, 1, 0], [1, 2, 0], [0, 0, 1]]),
        edge("an immovable body", [2, 4, 6], [1, 2, 3], 0.0, np.zeros((3, 3))),
        edge("on a pivot", [2, 4, 6], [1, 2, 3], 0.0, np.eye(3)),
        edge("at rest", REST, REST, 0.5, np.eye(3)),
        refused("a negative inverse mass", [2, 4, 6], REST, -1.0, np.eye(3)),
    ]

    def maker(draw: Draw) -> tuple[Any, ...]:
        return draw.vector(), draw.vector(), draw.number(0.2, 3), draw.inverse_inertia()

    return made("velocities_from_momenta", by_hand, maker)


_TABLE = {
    "point_velocity": _point,
    "relative_velocity": _relative,
    "normal_velocity": _normal_velocity,
    "rebound_velocity": _rebound,
    "classify_contact": _classify,
    "impulse_of_force": _impulse_of_force,
    "mean_force": _mean_force,
    "point_plane_normal": _plane_normal,
    "edge_edge_normal": _edge_normal,
    "contact_impulses": _contact_impulses,
    "apply_impulse_to_momenta": _momenta,
    "velocities_from_momenta": _velocities,
}
