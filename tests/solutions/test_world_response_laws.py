"""The laws of impact within the world, against the functions of the topics."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from balls_and_rods import EXACT, IMPULSES, ROD_SOFTNESS, energy, once, rod, row

from solutions.friction import dissipative_impulse, friction_impulse, poisson_impulse, stronge_impulse
from solutions.world.rules import LAWS, Rules

LAW_IMPULSES = {
    "dissipative": dissipative_impulse,
    "newton": friction_impulse,
    "poisson": poisson_impulse,
    "stronge": stronge_impulse,
}


@pytest.mark.parametrize("law", list(LAW_IMPULSES))
def test_each_law_in_time_order_gives_the_impulse_of_its_topic(law):
    u = np.array([0.5, 0.3, -1.0])
    expected = LAW_IMPULSES[law](u, (0, 0, 1.0), ROD_SOFTNESS, 0.6, 0.3)
    velocity, spin = once(*rod(u, 0.6, 0.3), Rules(response="in time order", law=law))
    assert velocity[0] - u == pytest.approx(expected, abs=1e-12)  # numbers near 1
    assert spin[0] == pytest.approx(12 * np.cross((-0.4, 0, -0.3), expected), abs=1e-11)


@pytest.mark.parametrize("response", IMPULSES)
def test_newtons_law_with_friction_adds_energy_to_kanes_rod(response):
    # As in the tests of the friction topic: 5/8 J become 571/800 J; exact fractions there
    bodies, state = rod((0.5, 0.0, -1.0), 1.0, 0.75)
    assert energy(bodies, state) == 0.625
    for law in LAWS[response]:
        velocity, spin = once(bodies, state, Rules(response=response, law=law, **EXACT))
        after = energy(bodies, state._replace(velocity=velocity, angular_velocity=spin))
        if law == "newton":
            assert after == pytest.approx(float(Fraction(571, 800)), abs=1e-11)
        else:
            assert after < 0.625


@pytest.mark.parametrize("friction", [0.2, 0.9])
def test_least_energy_is_a_complementarity_problem_of_one_contact(friction):
    u = np.array([2.0, 1.0, -1.0])
    expected = dissipative_impulse(u, (0, 0, 1.0), ROD_SOFTNESS, 0.5, friction)
    velocity, _ = once(*rod(u, 0.5, friction), Rules(response="simultaneous", directions=64))
    # Between two of 64 directions the impulse is 1 − cos(π/64) = 0.12 % short, and turned by up to π/64 = 5 %
    assert velocity[0] - u == pytest.approx(expected, abs=0.05 * friction * expected[2])
    assert np.linalg.norm(velocity[0] - u) == pytest.approx(np.linalg.norm(expected), rel=0.002)


@pytest.mark.parametrize(("response", "law"), [("penalty", "newton"), ("sequential", "poisson"), ("springs", "newton")])
def test_what_a_world_does_not_know_is_refused_with_the_choices(response, law):
    choices = "dissipative" if response in LAWS else "in time order"
    with pytest.raises(ValueError, match=choices):
        once(*row([1.0, 0.0]), Rules(response=response, law=law))
