"""Friction side by side: contact forces of a heap, friction in many impacts."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions import friction

CONTACTS, IMPACTS = 30, 100_000


def heap() -> tuple[np.ndarray, np.ndarray]:
    """Rows of contacts among twelve bodies, and what pulls at them."""
    rng = np.random.default_rng(1)
    return rng.normal(size=(CONTACTS, 72)), rng.normal(size=72)


def pivots() -> Callable[[], object]:
    """Thirty contacts by Lemke's method."""
    problem = friction.resting_problem(heap()[0], np.eye(72), heap()[1])
    return lambda: friction.solve_by_pivots(*problem)


def sweeps() -> Callable[[], object]:
    """The same in a hundred sweeps of projected Gauss–Seidel."""
    problem = friction.resting_problem(heap()[0], np.eye(72), heap()[1])
    return lambda: friction.solve_by_sweeps(*problem, 100)


def least_squares() -> Callable[[], object]:
    """The same as non-negative least squares."""
    from scipy.optimize import nnls  # noqa: PLC0415

    rows, force = heap()
    return lambda: nnls(rows.T, -force)


def balls() -> Callable[[], object]:
    """A hundred thousand spinning balls strike the floor."""
    rng = np.random.default_rng(2)
    velocity, spin = rng.normal(size=(2, IMPACTS, 3))
    return lambda: friction.sphere_impact(velocity, spin, (0.0, 0.0, 1.0), 0.1, 0.5, 0.3)


BENCHES = (
    Bench(
        "contact-forces",
        f"forces of {CONTACTS} contacts",
        pivots,
        {"ours, 100 sweeps": sweeps, "scipy nnls": least_squares},
    ),
    Bench("friction-impacts", f"{IMPACTS:,} impacts of spinning balls".replace(",", " "), balls, goal=0.5),
)
