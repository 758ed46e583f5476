"""Penalty contacts of bodies that weigh more than a kilogram: their greatest damping and their spring for friction."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.world.bodies import make_bodies, make_state
from solutions.world.memory import NOTHING
from solutions.world.rules import Rules
from solutions.world.step import advance_world

MASS, STIFFNESS = 3.0, 2e4
RULES = Rules(response="penalty", stiffness=STIFFNESS)


def ball(velocity, depth=0.0, restitution=0.0, friction=0.0):
    """A solid ball of radius 0.1 m in a floor."""
    shapes, moment = [("sphere", 0.1), ("half-space", (0.0, 0.0, 1.0))], 0.4 * MASS * 0.1**2
    bodies = make_bodies(shapes, [MASS, np.inf], moment * np.ones(3), restitution, friction)
    return bodies, make_state([(0, 0, 0.1 - depth), (0, 0, 0)], velocity=[velocity, (0, 0, 0)])


def test_a_penalty_contact_without_rebound_leaves_e_to_the_minus_two():
    """A critically damped contact that cannot pull ends at ω t = 2, with the speed v exp(−2)."""
    (bodies, state), memory, dt = ball((0, 0, -1.0)), NOTHING, 1e-3
    for _ in range(30):
        state, memory, _ = advance_world(bodies, state, (0, 0, 0), dt, RULES, memory)
    # first order in ω Δt = 8 %
    assert state.velocity[0, 2] == pytest.approx(np.exp(-2), rel=0.12)


def test_the_spring_of_penalty_friction_is_weaker_as_the_contact_is_lighter():
    # k_t = k m_t/m, where m/m_t = 1 + m r²/I at r = 95 mm from the centre: halfway between the surfaces
    v, dt = 1e-3, 1e-3
    bodies, state = ball((v, 0, 0), depth=0.01, restitution=1.0, friction=5.0)
    _, memory, _ = advance_world(bodies, state, (0, 0, 0), dt, RULES)
    stiffness = STIFFNESS / (1 + 0.095**2 / (0.4 * 0.1**2))
    assert memory.impulse == pytest.approx(np.array([[-stiffness * v * dt * dt, 0, 0]]), rel=1e-12)
