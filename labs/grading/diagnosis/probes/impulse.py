"""Probes of the functions of an impact: the normal of two edges, and what takes whole bodies."""

from __future__ import annotations

from labs.grading.diagnosis.probes import impulse_bodies
from labs.grading.diagnosis.probes.probe import Probe, edge, made, refused, usual

X, Y, UP, REST = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple((_TABLE | impulse_bodies.TABLE)[function]())


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


_TABLE = {"edge_edge_normal": _edge_normal}
