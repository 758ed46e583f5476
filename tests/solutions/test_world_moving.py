"""Overlaps are taken back beside the velocities: how far, shared by which masses, and no farther than the next body."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.world.bodies import make_bodies, make_state
from solutions.world.rules import Rules
from solutions.world.step import advance_world

RULES = Rules(margin=0.02, slop=1e-3, recovery=0.3, push_sweeps=300, tolerance=1e-14)


def balls_in_a_row(gaps, mass):
    """Balls of 0.1 m along a slanting line with these gaps; the first at the origin."""
    way = np.array([0.6, 0.0, 0.8])
    along = np.concatenate([[0.0], np.cumsum(0.2 + np.asarray(gaps))])
    return make_bodies([("sphere", 0.1)] * len(along), mass, 0.004 * np.ones(3)), make_state(along[:, None] * way), way


@pytest.mark.parametrize(
    ("gaps", "mass", "moved"),
    [
        # A share of 0.3 of what is deeper than 1 mm, between masses of 1 kg and 3 kg
        ((-0.011,), (1.0, 3.0), (-0.003 * 0.75, 0.003 * 0.25)),
        ((-0.0009,), (1.0, 3.0), (0.0, 0.0)),  # less than the slop is left alone
        # One that is 0.5 mm too deep in the one that is moved goes with it, and 0.15 mm farther
        ((-0.011, -0.0015), (np.inf, 1.0, 2.0), (0.0, 0.003, 0.00315)),
    ],
)
def test_an_overlap_is_taken_back_in_shares_of_the_inverse_masses(gaps, mass, moved):
    bodies, state, way = balls_in_a_row(gaps, mass)
    after, _, _ = advance_world(bodies, state, (0, 0, 0), 0.01, RULES)
    # sweeps end at rounding
    np.testing.assert_allclose(after.position - state.position, np.outer(moved, way), atol=1e-12)
    assert not after.velocity.any()  # it is a motion beside the velocities


def test_a_push_may_close_the_gap_to_a_third_body_and_no_more():
    # The second ball is to go 3 mm away from the first, which cannot move; 2 mm and the slop of 1 mm are free
    for gap, pushed in ((0.0021, 0.0), (0.0015, 0.0005)):
        bodies, state, way = balls_in_a_row((-0.011, gap), (np.inf, 1.0, 2.0))
        after, _, _ = advance_world(bodies, state, (0, 0, 0), 0.01, RULES)
        expected = np.outer((0.0, 0.003, pushed), way)
        np.testing.assert_allclose(after.position - state.position, expected, atol=1e-12)


def test_what_parts_in_this_step_is_not_pushed_as_well():
    # Two balls 10 mm deep in each other part at 0.4 m/s: in 0.01 s 4 mm, and 0.3 of the 5 mm that are left too deep
    bodies, state, way = balls_in_a_row((-0.010,), 1.0)
    state = state._replace(velocity=np.outer((-0.2, 0.2), way))
    after, _, _ = advance_world(bodies, state, (0, 0, 0), 0.01, RULES)
    expected = np.outer((-0.002 - 0.00075, 0.002 + 0.00075), way)
    np.testing.assert_allclose(after.position - state.position, expected, atol=1e-12)
