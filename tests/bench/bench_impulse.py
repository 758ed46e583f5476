"""Impacts: ours in one call, in a loop over the pairs, and pymunk's step over as many pairs of discs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions.impulse import Body, collide, sphere_inertia, world_inverse_inertia

PAIRS, MANY = 1_000, 100_000
RADIUS, E = 0.5, 0.5
X = np.array([1.0, 0.0, 0.0])


def pairs(count: int) -> tuple[Body, Body]:
    """Pairs of balls that close along x at 2 m/s and more, each with a spin and a velocity of its own."""
    rng = np.random.default_rng(1)
    orientation = rng.normal(size=(count, 4))
    orientation /= np.linalg.norm(orientation, axis=1)[:, None]
    inverse = world_inverse_inertia(sphere_inertia(1.0, RADIUS), orientation)
    velocity = rng.uniform(-0.5, 0.5, (2, count, 3)) + np.array([[-1.5 * X], [1.5 * X]])
    spin = rng.normal(size=(2, count, 3))
    arm = np.broadcast_to(RADIUS * X, (count, 3))
    mass = np.ones(count)
    return Body(velocity[0], spin[0], -arm, mass, inverse), Body(velocity[1], spin[1], arm, mass, inverse)


def ours(count: int) -> Callable[[], Callable[[], object]]:
    def prepare() -> Callable[[], object]:
        a, b = pairs(count)
        return lambda: collide(a, b, X, E)

    return prepare


def one_by_one() -> Callable[[], object]:
    a, b = pairs(PAIRS)
    bodies = [tuple(Body(*(np.asarray(part)[index] for part in body)) for body in (a, b)) for index in range(PAIRS)]
    return lambda: [collide(*pair, X, E) for pair in bodies]


def pymunk_step() -> Callable[[], object]:
    import pymunk  # noqa: PLC0415 a rival may be missing

    a, b = pairs(PAIRS)
    space = pymunk.Space()
    space.iterations = 1
    found = []
    for index in range(PAIRS):
        for side, body in ((1, a), (-1, b)):
            disc = pymunk.Body(1.0, RADIUS**2 / 2)
            shape = pymunk.Circle(disc, RADIUS)
            shape.elasticity = E**0.5
            space.add(disc, shape)
            speed = np.asarray(body.velocity)[index, :2].tolist()
            found.append((disc, (side * RADIUS * (1 - 1e-9), 3.0 * index), tuple(speed)))

    def step() -> None:
        for disc, place, speed in found:  # they have parted: back to the start
            disc.position, disc.velocity = place, speed
        space.step(1e-6)

    return step


BENCHES = (
    Bench(
        "impacts",
        f"impacts of {PAIRS} pairs of balls; pymunk's are discs, and finding them and setting them up is included",
        ours(PAIRS),
        {"hand-written, one by one": one_by_one, "pymunk": pymunk_step},
        goal=0.005,
    ),
    Bench(
        "impacts-many",
        f"impacts of {MANY} pairs of balls in space, in one call",
        ours(MANY),
        goal=0.5,
    ),
)
