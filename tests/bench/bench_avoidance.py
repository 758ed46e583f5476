"""Flocks and crowds: our steps beside scipy's search for neighbours, all distances, and navground."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions.avoidance import crowd_step, flock_step, neighbour_pairs

BOIDS, FEW, SEEN = 10_000, 2_000, 20
CROWD = 200


def flock(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Places and velocities of boids, evenly spread in space so that each sees some 20 others within 1 m."""
    rng = np.random.default_rng(1)
    side = (count * 4 / 3 * math.pi / SEEN) ** (1 / 3)
    return rng.uniform(0, side, (count, 3)), rng.normal(size=(count, 3))


def our_step() -> Callable[[], object]:
    position, velocity = flock(BOIDS)
    return lambda: flock_step(position, velocity, 0.02, 1.0, (0.1, 0.5, 0.3), 2.0, 10.0)


def our_pairs(count: int) -> Callable[[], Callable[[], object]]:
    def prepare() -> Callable[[], object]:
        position, _ = flock(count)
        return lambda: neighbour_pairs(position, 1.0)

    return prepare


def a_tree(count: int) -> Callable[[], Callable[[], object]]:
    def prepare() -> Callable[[], object]:
        from scipy.spatial import cKDTree  # noqa: PLC0415 a rival may be missing

        position, _ = flock(count)
        return lambda: cKDTree(position).query_pairs(1.0, output_type="ndarray")

    return prepare


def all_distances(count: int) -> Callable[[], Callable[[], object]]:
    def prepare() -> Callable[[], object]:
        position, _ = flock(count)

        def search() -> object:
            squared = sum((axis[:, None] - axis) ** 2 for axis in position.T)
            return np.nonzero(np.triu(squared <= 1.0, 1))

        return search

    return prepare


def ring() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A crowd in a loose lattice, each with a wish of its own."""
    rng = np.random.default_rng(1)
    side = math.ceil(math.sqrt(CROWD))
    position = 2.0 * np.argwhere(np.ones((side, side)))[:CROWD] + rng.uniform(-0.4, 0.4, (CROWD, 2))
    velocity, wish = rng.normal(size=(2, CROWD, 2))
    return position, velocity / 2, wish / 2


def our_crowd() -> Callable[[], object]:
    position, velocity, wish = ring()
    return lambda: crowd_step(position, velocity, wish, 0.5, 1.5, 2.0, 0.1)


def navground_crowd() -> Callable[[], object]:
    from navground import core  # noqa: PLC0415 a rival may be missing

    position, velocity, wish = ring()
    behaviors = []
    for place, moving, wanted in zip(position, velocity, wish, strict=True):
        kinematics = core.kinematics.OmnidirectionalKinematics(max_speed=1.5, max_angular_speed=1.0)
        behavior = core.behaviors.ORCABehavior(kinematics, 0.5)
        behavior.time_horizon, behavior.horizon, behavior.max_number_of_neighbors = 2.0, 7.0, 1000
        behavior.position, behavior.velocity = place, moving
        behavior.target = core.Target.Direction(wanted / np.linalg.norm(wanted))
        behaviors.append(behavior)
    discs = [
        core.Neighbor(place, 0.5, moving, index)
        for index, (place, moving) in enumerate(zip(position, velocity, strict=True))
    ]
    near = np.linalg.norm(position[:, None] - position, axis=-1) <= 7.0

    def step() -> None:
        for i, behavior in enumerate(behaviors):
            seen = [discs[j] for j in np.flatnonzero(near[i]) if j != i]
            behavior.environment_state.neighbors = seen
            behavior.compute_cmd(0.1)

    return step


BENCHES = (
    Bench(
        "flock",
        f"a step of a flock of {BOIDS} boids, some {SEEN} neighbours each; of the rivals only the search for them",
        our_step,
        {
            "hand-written, neighbours alone": our_pairs(BOIDS),
            "scipy cKDTree, neighbours alone": a_tree(BOIDS),
        },
        goal=0.15,
    ),
    Bench(
        "neighbours",
        f"all pairs within a radius among {FEW} points, some {SEEN} neighbours each",
        our_pairs(FEW),
        {"scipy cKDTree": a_tree(FEW), "all distances": all_distances(FEW)},
    ),
    Bench(
        "crowd",
        f"a step of a crowd of {CROWD} discs by reciprocal avoidance; navground's neighbours were found before",
        our_crowd,
        {"navground": navground_crowd},
    ),
)
