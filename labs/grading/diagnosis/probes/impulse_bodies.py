"""Probes of the functions of an impact that take whole bodies."""

from __future__ import annotations

from typing import Any

import numpy as np

from labs.grading.diagnosis.probes.probe import Arguments, Draw, Probe, edge, made, refused, usual
from reference.arrays import Array

UP, LEANS, REST = [0.0, 0.0, 1.0], [1 / 3, 2 / 3, 2 / 3], [0.0, 0.0, 0.0]
NO_TURN = np.zeros((3, 3))
_QUATERNIONS = ((1, 1, 1, 1, 2), (4, 2, 2, 1, 5), (1, 1, 7, 7, 10), (1, 5, 5, 7, 10), (2, 4, 5, 6, 11), (2, 3, 6, 0, 7))
"""Whole numbers whose first four are the parts of a quaternion of nearly or just the length of the fifth."""


def _body(velocity: Any, arm: Any = REST, spin: Any = REST, share: float = 1.0, turning: Any = None) -> Arguments:
    """A body of 1 kg that does not turn alike about any two axes, unless said otherwise."""
    return velocity, spin, arm, share, np.diag([1.0, 2.0, 4.0]) if turning is None else turning


def _ground(arm: Any = REST) -> Arguments:
    return _body(REST, arm, share=0.0, turning=NO_TURN)


def _orientation(draw: Draw) -> Array:
    *parts, _ = _QUATERNIONS[draw.rng.integers(len(_QUATERNIONS))]
    turn = draw.rng.permutation(parts) * draw.rng.choice([-1, 1], 4)
    return np.asarray(turn / np.linalg.norm(turn))


def _world_inertia() -> list[Probe]:
    quarter = [np.sqrt(0.5), 0, 0, np.sqrt(0.5)]
    by_hand = [
        usual("along the axes", [1, 2, 4], [1, 0, 0, 0]),
        usual("a quarter turn about z", [1, 2, 4], quarter),
        usual("half a turn about z", [1, 2, 4], [0, 0, 0, 1]),
        usual("a third of a turn about the diagonal", [1, 2, 4], [0.5, 0.5, 0.5, 0.5]),
        usual("turned about x", [1, 2, 4], [0.8, 0.6, 0, 0]),
        edge("a ball", [2, 2, 2], [0.8, 0, 0.6, 0]),
        edge("a thin rod: no inertia about its axis", [2, 2, 0], [0.8, 0, 0.6, 0]),
        edge("an immovable body", [np.inf, np.inf, np.inf], [0.8, 0, 0.6, 0]),
        refused("a quaternion that is not of unit length", [1, 2, 4], [1, 1, 0, 0]),
    ]

    def maker(draw: Draw) -> Arguments:
        return np.array([draw.number(0.2, 4) for _ in range(3)]), _orientation(draw)

    return made("world_inverse_inertia", by_hand, maker)


def _pairs() -> list[tuple[str, str, Arguments, Arguments, Any]]:
    """Impacts of two bodies: group, note, A, B, normal."""
    return [
        ("usual", "two balls head on", _body([0, 0, -1]), _body([0, 0, 1]), UP),
        ("usual", "a light ball on a heavy one", _body([0, 0, -1], share=4.0), _body(REST, share=0.25), UP),
        ("usual", "beside A's centre", _body([0, 0, -2], [0.5, 0, -0.5]), _body(REST), UP),
        ("usual", "beside B's centre", _body([0, 0, -2]), _body(REST, [0, 0.5, 0.5]), UP),
        ("usual", "A spins", _body([0, 0, -1], [1, 0, -1], spin=[0, 3, 0]), _body(REST), UP),
        ("usual", "B spins", _body([0, 0, -1]), _body(REST, [1, 0, 1], spin=[0, -3, 0]), UP),
        ("edge", "on the ground", _body([0, 0, -2], [0.5, 0, -0.5]), _ground(), UP),
        ("edge", "A is the ground", _ground(), _body([0, 0, 2], [0.5, 0, 0.5]), UP),
        ("usual", "moving apart", _body([0, 0, 1], [0.5, 0, -0.5]), _body([0, 0, -1]), UP),
        ("usual", "slanting", _body([1, 0, -2], [0.25, 0, -1]), _body([0, 1, 0], [0, 0, 1]), LEANS),
        ("edge", "A on a pivot", _body(REST, [1, 0, 0], [0, 2, 0], share=0.0), _body([0, 0, 1]), UP),
        ("edge", "two immovable bodies", _body([0, 0, -1], share=0.0, turning=NO_TURN), _ground(), UP),
        ("edge", "grazing", _body([3, 0, 0], [0, 0, -1]), _body(REST), UP),
        ("edge", "both at rest", _body(REST, [1, 0, 0]), _body(REST), UP),
        ("edge", "a body that cannot turn", _body([0, 0, -2], [1, 0, 0], turning=NO_TURN), _body(REST), UP),
    ]


def _by_hand(*more: Any) -> list[Probe]:
    found = [
        (usual if group == "usual" else edge)(note, _arrays(a), _arrays(b), normal, *more)
        for group, note, a, b, normal in _pairs()
    ]
    bad = _arrays(_body([0, 0, -1])), _arrays(_body(REST))
    return [*found, refused("a normal that is not of unit length", *bad, [0, 0, 2], *more)]


def _arrays(body: Arguments) -> Arguments:
    """A body as a plain tuple: three vectors, a number, a matrix."""
    return tuple(part if isinstance(part, float) else np.asarray(part, dtype=float) for part in body)


def _two(draw: Draw) -> tuple[Arguments, Arguments, Array]:
    """Two bodies and a normal, mostly coming nearer."""
    normal = draw.unit()
    v_a, *rest = draw.body()
    return (v_a - draw.number(2, 6) * normal, *rest), draw.body(), normal


def _normal_velocity() -> list[Probe]:
    rolling, still = _arrays(_body([1, 0, 0], [0, 0, -0.5], spin=[0, 2, 0])), _arrays(_body(REST))
    axis, centre = _arrays(_body([1, 2, 3], [0, 0, 3], spin=[0, 0, 2])), _arrays(_body([1, 2, 3], spin=[4, 5, 6]))
    by_hand = [
        *_by_hand(),
        usual("the lowest point of a ball that rolls", rolling, still, [1, 0, 0]),
        usual("about a slanting axis", _arrays(_body([0, 0, 1], [-1, 0, 2], spin=[1, 2, 3])), still, LEANS),
        edge("on the axis", axis, still, UP),
        edge("the centre of mass", still, centre, LEANS),
    ]
    return made("normal_velocity", by_hand, _two)


def _effective() -> list[Probe]:
    return made("inverse_effective_mass", _by_hand(), _two)


def _magnitude() -> list[Probe]:
    by_hand = [
        *_by_hand(0.5),
        edge("perfect bounce", _arrays(_body([0, 0, -2])), _arrays(_ground()), UP, 1.0),
        edge("no bounce", _arrays(_body([0, 0, -2])), _arrays(_ground()), UP, 0.0),
    ]
    return made("impulse_magnitude", by_hand, lambda draw: (*_two(draw), draw.number(0.1, 0.9)))


def _apply() -> list[Probe]:
    by_hand = [
        usual("through both centres", _arrays(_body([0, 0, -1])), _arrays(_body([0, 0, 1])), [0, 0, 2]),
        usual("beside A's centre", _arrays(_body(REST, [0.5, 0, 0])), _arrays(_body(REST)), [0, 0, 2]),
        usual("beside B's centre", _arrays(_body(REST)), _arrays(_body(REST, [0, 0.5, 0])), [0, 0, 2]),
        usual("a heavy B", _arrays(_body(REST)), _arrays(_body([1, 0, 0], share=0.25)), [3, 0, 1]),
        edge("on the ground", _arrays(_body([0, 0, -2], [1, 0, 0])), _arrays(_ground()), [0, 0, 3]),
        edge("no impulse", _arrays(_body([1, 2, 3], spin=[3, 2, 1])), _arrays(_body([0, 1, 0])), REST),
        edge("two immovable bodies", _arrays(_ground()), _arrays(_ground()), [0, 0, 3]),
        refused("an impulse that is no number", _arrays(_body(REST)), _arrays(_body(REST)), [0, 0, np.nan]),
    ]
    return made("apply_impulse", by_hand, lambda draw: (draw.body(), draw.body(), draw.vector(4)))


def _collide() -> list[Probe]:
    slow = _arrays(_body([0, 0, -0.25], [0.5, 0, 0]))
    drifting = _arrays(_body([0, 0, 0.25], [0.5, 0, 0]))
    still = _arrays(_body(REST))
    rising, falling = (_arrays(_body([0, 0, z], [1, 0, -z], spin=[0, 3 * z, 0])) for z in (1, -1))
    by_hand = [
        *_by_hand(0.5),
        usual("slower than the threshold", slow, _arrays(_body(REST)), UP, 0.5, 0.5),
        usual("faster than the threshold", slow, _arrays(_body(REST)), UP, 0.5, 0.125),
        usual("moving apart, with a threshold", _arrays(_body([0, 0, 2])), _arrays(_body(REST)), UP, 0.5, 0.25),
        usual("moving apart more slowly than the threshold", drifting, _arrays(_body(REST)), UP, 0.5, 0.5),
        usual("A moves away, but its spin brings them together", rising, still, UP, 0.5),
        usual("B moves away, but its spin brings them together", still, falling, UP, 0.5),
        edge("at the threshold", slow, _arrays(_body(REST)), UP, 0.5, 0.25),
        edge("perfect bounce", _arrays(_body([0, 0, -2])), _arrays(_ground()), UP, 1.0),
        edge("no bounce", _arrays(_body([0, 0, -2])), _arrays(_ground()), UP, 0.0),
    ]
    return made("collide", by_hand, lambda draw: (*_two(draw), draw.number(0.1, 0.9)))


def _audit() -> list[Probe]:
    a = _arrays(_body([0, 0, -2], [0.5, 0, -0.5], spin=[0, 1, 0]))
    b = _arrays(_body([0, 1, 0], [0, 0.5, 0.5], share=0.25))
    ground, rod = _arrays(_ground()), _arrays(_body(REST, [0, 0, 0.5], turning=np.diag([12.0, 12.0, 0.0])))
    beside = _arrays(_body([0, 0, -1], [0.5, 0, 0]))
    pivot = _arrays(_body(REST, [0, 1, 0], share=0.0))
    by_hand = [
        usual(
            "two balls head on", _arrays(_body([0, 0, -1])), _arrays(_body([0, 0, 1])), _after([0, 0, 1], [0, 0, -1])
        ),
        usual("A alone is faster", a, b, _after([1, 2, 3], b[0], a[1])),
        usual("B alone is faster", a, b, _after(a[0], [3, 2, 1], a[1])),
        usual("A alone spins", a, b, _after(a[0], b[0], [1, 2, 3])),
        usual("B alone spins", a, b, _after(a[0], b[0], a[1], [3, 2, 1])),
        usual("beside A's centre", beside, b, _after([0, 0, 1], [0, 1, -0.5], [0, -0.5, 0])),
        edge("nothing happens", a, b, _after(a[0], b[0], a[1])),
        edge("on the ground", beside, ground, _after([0, 0, 1], REST, [0, -0.5, 0])),
        edge("A is the ground", ground, b, _after(REST, [0, 1, 2], REST, [1, 0, 0])),
        edge("B turns on a pivot", beside, pivot, _after([0, 0, 1], REST, [0, -0.5, 0], [2, 0, 0])),
        edge("A turns on a pivot", pivot, b, _after(REST, [0, 1, 2], [0, 0, -1], [1, 0, 0])),
        edge("a thin rod, struck at its end", rod, b, _after([1, 0, 0], [-0.25, 1, 0], [0, 6, 3])),
        edge("two immovable bodies", ground, ground, _after(UP, REST, [1, 0, 0])),
        refused("a velocity that is no number", a, b, _after([0, 0, np.nan], REST)),
    ]

    def maker(draw: Draw) -> Arguments:
        return draw.body(), draw.body(), tuple(draw.vector(size) for size in (3, 2, 3, 2))

    return made("audit", by_hand, maker)


def _after(v_a: Any, v_b: Any, w_a: Any = REST, w_b: Any = REST) -> Arguments:
    """Velocities after an impact, in the order in which functions return them."""
    return tuple(np.asarray(part, dtype=float) for part in (v_a, w_a, v_b, w_b))


TABLE = {
    "normal_velocity": _normal_velocity,
    "world_inverse_inertia": _world_inertia,
    "inverse_effective_mass": _effective,
    "impulse_magnitude": _magnitude,
    "apply_impulse": _apply,
    "collide": _collide,
    "audit": _audit,
}
