"""Boxes that slide or hold, by hand: on the flat, on a ramp, and under a load of balls."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import STILL, UP, X, Y
from reference.published.case import Published
from reference.published.solid_sphere import inertia_of

LONG = 100.0
"""How long a box slides at most, s; every box here has stopped by then."""
STEP = 1.0
"""Timestep of P2, s. All forces are constant, so that the speeds at the end are the same with any."""


def box_under_balls(case: Published, code: Implementation) -> Answers:
    """P2: a plate and its balls as bodies with one contact each, by sequential impulses; then with a square cone."""
    balls, duration = int(case.value("balls")), case.value("duration")
    masses = np.array([case.value("box_mass")] + balls * [case.value("ball_mass")])
    push = _push(case)
    acceleration = np.zeros((balls + 1, 6))
    acceleration[:, 2] = -case.value("gravity")
    acceleration[0, :3] += push / masses[0]
    rows, weights = _contacts(case, code, masses)
    friction = np.array([case.value("ground_friction")] + balls * [case.value("ball_friction")])
    solve, velocity = code.function("sequential_impulses"), np.zeros(6 * (balls + 1))
    for _ in range(round(duration / STEP)):
        velocity, _ = solve(velocity + STEP * acceleration.ravel(), rows, weights, friction)
    box, ball = (float(np.linalg.norm(body[:3])) for body in velocity.reshape(-1, 6)[:2])
    return as_answers(
        box_speed=box,
        ball_speed=ball,
        box_acceleration=box / duration,
        ball_acceleration=ball / duration,
        square_cone_error=_square_cone_error(case, code, push, float(np.sum(masses))),
    )


def _push(case: Published) -> Array:
    angle = math.radians(case.value("push_angle"))
    return case.value("push") * (math.cos(angle) * X + math.sin(angle) * Y)


def _contacts(case: Published, code: Implementation, masses: Array) -> tuple[object, object]:
    """Jacobian and inverse masses of the plate on the ground and of each ball on the plate.

    The plate is pushed and loaded evenly, and so it is kept from turning.
    """
    bodies, radius = len(masses), case.value("ball_radius")
    below = np.array([-1] + (bodies - 1) * [0])
    arms = np.outer(below + 1, -radius * UP)
    jacobian = code.function("contact_jacobian")
    directions = [np.broadcast_to(direction, (bodies, 3)) for direction in (UP, X, Y)]
    rows = [jacobian(np.arange(bodies), below, direction, arms, 0 * arms, bodies) for direction in directions]
    inertia = np.array([math.inf, *(inertia_of(mass, radius) for mass in masses[1:])])
    weights = code.function("inverse_mass_matrix")(1 / masses, np.eye(3) / inertia[:, None, None])
    return np.stack(rows, axis=1), weights


def _square_cone_error(case: Published, code: Implementation, push: Array, mass: float) -> float:
    """Mean of the squared errors of both speeds, before each step, if friction is clamped to a square along x and y."""
    press, _ = code.function("support_force")(mass, -case.value("gravity") * UP, STILL, STILL, UP)
    friction = code.function("clamp_to_square")(-push, case.value("ground_friction") * press, X, Y)
    assert np.array_equal(friction, -push), "the square holds the plate"
    times = case.value("timestep") * np.arange(round(case.value("duration") / case.value("timestep")))
    errors = sum((case.expected_value(name) * times) ** 2 for name in ("box_acceleration", "ball_acceleration"))
    return float(np.mean(errors))


def stopping(case: Published, code: Implementation) -> Answers:
    """P7, P8: how far a box slides, in one step of the lecture's motion with friction, exact to the stop."""
    # for 1 kg; the way is the same for any mass
    press, _ = code.function("support_force")(1.0, -case.value("gravity") * UP, STILL, STILL, UP)
    friction = np.array(case.numbers("friction"))
    end, *_ = code.function("sliding_motion")(
        STILL, case.value("speed") * X, STILL, press, friction, friction, 1.0, LONG
    )
    found = np.ravel(end[..., 0])
    return as_answers(distance=tuple(found.tolist()) if len(found) > 1 else float(found[0]))


def ramp(case: Published, code: Implementation) -> Answers:
    """P10: whether a box rests, for every pair of coefficient and slope."""
    angles = np.radians(np.array(case.numbers("slope")))
    normal = np.stack([-np.sin(angles), 0 * angles, np.cos(angles)], axis=-1)
    press, push = code.function("support_force")(1.0, -case.value("gravity") * UP, STILL, STILL, normal)
    rests = code.function("holds")(push, press, np.array(case.numbers("friction"))[:, None])
    return as_answers(rests=tuple(np.ravel(rests).astype(float).tolist()))
