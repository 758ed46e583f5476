"""Several contacts at once, by hand: discs that are struck together, complementarity problems, a ladder."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import STILL, UP, X, Y
from reference.published.case import Published
from reference.scene.scenario import GRAVITY

STEP = 1e-3
"""Step over which the ladder's impulses are taken, s."""
ENOUGH = 1.0
"""A coefficient of friction with which the ladder holds for sure."""
HOLDS = 1e-6
"""A ladder that holds is slower than this after a step, m/s and rad/s; one that slips at μ = 0.37 has 9e-5 m/s."""


def three_discs(case: Published, code: Implementation) -> Answers:
    """P37: both impulses from one complementarity problem, elastic: it asks that the closing velocities reverse."""
    return as_answers(velocity=tuple(_after(case, code, spread) for spread in case.numbers("spread")))


def _after(case: Published, code: Implementation, spread: float) -> float:
    """Velocity of the disc that strikes, along its way, m/s."""
    aside = spread / 2  # sine of the angle between its way and the line to the centre of each of the two
    ahead = math.sqrt(1 - aside**2) * X
    normals = -np.array([ahead + aside * Y, ahead - aside * Y])
    arms = case.value("radius") * normals
    jacobian = code.function("contact_jacobian")([0, 0], [1, 2], normals, -arms, arms, 3)
    inverse = code.function("inverse_mass_matrix")(
        np.full(3, 1 / case.value("mass")), np.zeros((3, 3, 3))
    )  # nothing turns them
    velocity = np.concatenate([case.value("speed") * X, np.zeros(15)])
    matrix, closing = code.function("resting_problem")(jacobian, inverse, case.value("mass") * velocity)
    impulses = code.function("solve_by_pivots")(matrix, 2 * closing)
    return float((velocity + inverse @ jacobian.T @ impulses) @ np.concatenate([X, np.tile(STILL, 5)]))


def handbook(case: Published, code: Implementation) -> Answers:
    """P38: Lemke's method."""
    solve, order = code.function("solve_by_pivots"), round(case.value("triangular_order"))
    triangular = np.eye(order) + 2 * np.triu(np.ones((order, order)), 1)
    first, second, sixth = case.numbers("market_offset")
    found = {
        "triangular": solve(triangular, -np.ones(order)),
        "cottle": solve(_square(case, "cottle_matrix"), case.numbers("cottle_offset")),
    }
    for cost in case.numbers("market_cost"):
        found[f"market_{cost:g}"] = solve(_square(case, "market_matrix"), (first, second, cost, sixth))
    return as_answers(**{name: tuple(forces.tolist()) for name, forces in found.items()})


def _square(case: Published, name: str) -> Array:
    """A matrix, from the set-up's numbers row by row."""
    numbers = case.numbers(name)
    return np.reshape(numbers, 2 * (math.isqrt(len(numbers)),))


def ladder(case: Published, code: Implementation) -> Answers:
    """P41: the impulses at both ends that keep a ladder at rest for a step, and whether there are any."""
    (wall, _), (floor, rub) = _ends(case, code, ENOUGH)[1] / STEP
    found = {
        "floor_normal": floor,
        "wall": wall,
        "friction": abs(rub),
        "floor": math.hypot(floor, rub),
        "direction": math.degrees(math.atan2(floor, abs(rub))),
        "coefficient": abs(rub) / floor,
    }
    holds = [bool(np.max(np.abs(_ends(case, code, mu)[0])) < HOLDS) for mu in case.numbers("tried_friction")]
    return as_answers(**{name: float(value) for name, value in found.items()}, holds=tuple(map(float, holds)))


def _ends(case: Published, code: Implementation, friction: float) -> tuple[Array, Array]:
    """Velocity of the ladder, (6,), after a step, and impulses, N s, at the wall and the floor, (2, 2).

    The columns of the impulses are along the normal and along the floor, or up the wall.
    """
    length, weight, angle = case.value("length"), case.value("weight"), math.radians(case.value("angle"))
    mass = weight / GRAVITY
    up_the_ladder = length / 2 * (math.cos(angle) * X + math.sin(angle) * UP)
    arms = np.array([up_the_ladder, -up_the_ladder])
    jacobian, ground = code.function("contact_jacobian"), [-1, -1]
    rows = [
        jacobian([0, 0], ground, np.array(directions), arms, 0 * arms, 1)
        for directions in ((-X, UP), (UP, X), (Y, Y))  # normals, and two directions along each surface
    ]
    inertia = code.function("rod_inertia")(mass, length)
    moment = float(np.max(inertia)) * np.eye(3)  # in its plane it turns about one axis alone
    inverse = code.function("inverse_mass_matrix")([1 / mass], np.linalg.inv(moment)[None])
    falling = np.concatenate([-GRAVITY * STEP * UP, STILL])
    solve = code.function("sequential_impulses")
    velocity, impulses = solve(falling, np.stack(rows, axis=1), inverse, [0.0, friction])
    return velocity, impulses[:, :2]
