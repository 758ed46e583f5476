"""A million contacts of boxes that turn, with friction: from velocities to velocities."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions.friction import friction_impulse, point_inverse_mass
from solutions.impulse import (
    Body,
    apply_impulse,
    box_inertia,
    collide,
    point_velocity,
    relative_velocity,
    world_inverse_inertia,
)

CONTACTS, A_CALL = 1_000_000, 20_000


def _contacts() -> list[tuple[Body, Body, np.ndarray, np.ndarray, np.ndarray]]:
    """Two bodies, normals, restitutions and frictions of so many contacts a call that they stay in the cache."""
    random, made = np.random.default_rng(5), []
    for _ in range(CONTACTS // A_CALL):
        bodies = []
        for _ in "AB":
            velocity, spin, arm = random.normal(size=(3, A_CALL, 3))
            turn = random.normal(size=(A_CALL, 4))
            turn /= np.linalg.norm(turn, axis=1, keepdims=True)
            mass = random.uniform(0.5, 2.0, A_CALL)
            inertia = box_inertia(mass, random.uniform(0.5, 2.0, (A_CALL, 3)))
            bodies.append(Body(velocity, spin, arm, 1 / mass, world_inverse_inertia(inertia, turn)))
        normal = random.normal(size=(A_CALL, 3))
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        made.append((bodies[0], bodies[1], normal, *random.uniform(0, 1, (2, A_CALL))))
    return made


def _answer(a: Body, b: Body, normal: np.ndarray, restitution: np.ndarray, friction: np.ndarray) -> object:
    slip = relative_velocity(point_velocity(*a[:3]), point_velocity(*b[:3]))
    softness = point_inverse_mass(*a[3:], a.arm) + point_inverse_mass(*b[3:], b.arm)
    return apply_impulse(a, b, friction_impulse(slip, normal, softness, restitution, friction))


def rough() -> Callable[[], object]:
    contacts = _contacts()
    return lambda: [_answer(*each) for each in contacts]


def smooth() -> Callable[[], object]:
    contacts = _contacts()
    return lambda: [collide(a, b, normal, restitution) for a, b, normal, restitution, _ in contacts]


BENCHES = (
    Bench(
        "contacts",
        f"{CONTACTS:_} contacts of boxes with friction, {A_CALL:_} a call".replace("_", " "),
        rough,
        {"without friction": smooth},
        goal=2.0,
    ),
)
