"""The laws of impact within the world, against the functions of the topics."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from balls_and_rods import EXACT, IMPULSES, ROD_SOFTNESS, G, drops, energy, once, rod, row

from solutions.friction import dissipative_impulse, friction_impulse, poisson_impulse, stronge_impulse
from solutions.world.rules import LAWS, Rules
from solutions.world.step import advance_world

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


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
@pytest.mark.parametrize(
    ("velocity", "friction"),
    [
        ((0.5, 0.0, -1.0), 0.75),  # the slip ends and stays ended
        ((0.5, 0.3, -1.0), 0.9),  # it ends in space
        ((-3.0, 0.0, -1.0), 0.1),  # it keeps its direction
    ],
)
def test_two_phases_are_rouths_while_the_slip_does_not_turn(response, velocity, friction):
    expected = poisson_impulse(velocity, (0, 0, 1.0), ROD_SOFTNESS, 0.6, friction)
    after, _ = once(*rod(velocity, 0.6, friction), Rules(response=response, law="poisson", **EXACT))
    assert after[0] - velocity == pytest.approx(expected, abs=1e-9)  # Routh's way is followed in steps of 1e-10


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_weight_of_the_step_rebounds_by_poissons_law_alone(response):
    bodies, state = drops([0.0], 0.5)
    state = state._replace(velocity=np.array([(0, 0, -2.0), (0, 0, 0)]))
    for law, speed in (("dissipative", 0.5 * 2.0), ("newton", 0.5 * 2.0), ("poisson", 0.5 * (2.0 + 0.01 * G))):
        after, _, _ = advance_world(bodies, state, (0, 0, -G), 0.01, Rules(response=response, law=law))
        assert after.velocity[0, 2] == pytest.approx(speed, abs=1e-14)


def test_two_phases_differ_from_routh_where_the_slip_turns():
    velocity = (0.5, 0.3, -1.0)
    expected = poisson_impulse(velocity, (0, 0, 1.0), ROD_SOFTNESS, 0.6, 0.3)
    after, _ = once(*rod(velocity, 0.6, 0.3), Rules(law="poisson", **EXACT))
    assert np.linalg.norm(after[0] - velocity - expected) > 0.1
    normal = (after[0] - velocity)[2]
    assert np.linalg.norm((after[0] - velocity)[:2]) <= 0.3 * normal + 1e-12


@pytest.mark.parametrize(("response", "law"), [("penalty", "newton"), ("sequential", "stronge"), ("springs", "newton")])
def test_what_a_world_does_not_know_is_refused_with_the_choices(response, law):
    choices = "dissipative" if response in LAWS else "in time order"
    with pytest.raises(ValueError, match=choices):
        once(*row([1.0, 0.0]), Rules(response=response, law=law))
