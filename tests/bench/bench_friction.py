"""Friction side by side: contact forces of a heap, friction in many impacts."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions import friction, world

CONTACTS, IMPACTS, ODD_IMPACTS = 30, 100_000, 1_000


def heap() -> tuple[np.ndarray, np.ndarray]:
    """Rows of contacts among twelve bodies, and what pulls at them."""
    rng = np.random.default_rng(1)
    return rng.normal(size=(CONTACTS, 72)), rng.normal(size=72)


def pivots() -> Callable[[], object]:
    """Thirty contacts by Lemke's method."""
    problem = world.resting_problem(heap()[0], np.eye(72), heap()[1])
    return lambda: world.solve_by_pivots(*problem)


def sweeps() -> Callable[[], object]:
    """The same in a hundred sweeps of projected Gauss–Seidel."""
    problem = world.resting_problem(heap()[0], np.eye(72), heap()[1])
    return lambda: world.solve_by_sweeps(*problem, 100)


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


def odd_bodies() -> tuple[np.ndarray, ...]:
    """Impacts of bodies that are struck off their centre: u, n, K, e and μ of each."""
    rng = np.random.default_rng(3)
    turn = np.linalg.qr(rng.normal(size=(ODD_IMPACTS, 3, 3)))[0]
    inverse_inertia = (turn / rng.uniform(0.02, 0.1, (ODD_IMPACTS, 1, 3))) @ np.swapaxes(turn, -1, -2)
    k = friction.point_inverse_mass(1.0, inverse_inertia, 0.3 * rng.normal(size=(ODD_IMPACTS, 3)))
    normal, e, mu = np.array([0.0, 0.0, 1.0]), rng.uniform(size=ODD_IMPACTS), rng.uniform(0, 1, ODD_IMPACTS)
    return rng.normal(size=(ODD_IMPACTS, 3)) - 2 * normal, normal, k, e, mu


def by_law(law: Callable[..., object]) -> Callable[[], Callable[[], object]]:
    """These impacts by a law."""
    return lambda: lambda: law(*odd_bodies())


BENCHES = (
    Bench(
        "contact-forces",
        f"forces of {CONTACTS} contacts",
        pivots,
        {"ours, 100 sweeps": sweeps, "scipy nnls": least_squares},
    ),
    Bench("friction-impacts", f"{IMPACTS:,} impacts of spinning balls".replace(",", " "), balls, goal=0.5),
    Bench(
        "impact-laws",
        f"{ODD_IMPACTS:,} impacts of odd bodies by Stronge's law".replace(",", " "),
        by_law(friction.stronge_impulse),
        {
            "ours, Poisson's law": by_law(friction.poisson_impulse),
            "ours, maximal dissipation": by_law(friction.dissipative_impulse),
            "ours, Newton's law": by_law(friction.friction_impulse),
        },
    ),
)
