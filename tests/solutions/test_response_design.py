"""A penalty contact made to measure, and whether it does what it was made for."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.forces import semi_implicit_euler
from solutions.response import design_contact, penalty_damping, penalty_force, penalty_step_limit

UP = np.array([0.0, 0.0, 1.0])


@pytest.mark.statement(8, oracle="energy: m v²/2 = k d²/2, and half a period of the spring")
def test_the_spring_alone_turns_the_body_at_the_permitted_depth():
    # 2 kg at 3 m/s, 0.5 m deep: k = 2 · 9/0.25, ω = 6 rad/s
    stiffness, damping, dt = design_contact(2.0, 3.0, 0.5, 1.0, 10.0)
    assert (stiffness, damping, dt) == pytest.approx((72.0, 0.0, np.pi / 60), rel=1e-15)


def test_a_millimetre_at_4_4_metres_a_second_needs_24_microseconds():
    stiffness, _, dt = design_contact(1.0, 4.4, 1e-3, 0.5, 30.0)
    assert dt == pytest.approx(24e-6, rel=0.01)
    assert dt == pytest.approx(2 * np.pi / np.sqrt(stiffness) / 60, rel=1e-14)  # a sixtieth of the period


def struck(mass, speed, contact, gravity=0.0):
    """The deepest place, m, and the speed after over the speed before."""
    stiffness, damping, dt = contact
    position, velocity, deepest = np.zeros(3), -speed * UP, 0.0
    while position[2] < 0 or velocity[2] < 0:
        force = penalty_force(position[2], velocity[2], UP, stiffness, damping)
        position, velocity = semi_implicit_euler(position, velocity, force / mass - gravity * UP, dt)
        deepest = min(deepest, position[2])
    return -deepest, velocity[2] / speed


@pytest.mark.statement(8, oracle="the depth √e v/ω of a damped contact, and the restitution")
@pytest.mark.parametrize("e", [0.1, 0.5, 0.8, 1.0])
def test_a_contact_of_many_steps_keeps_to_the_depth_and_the_restitution(e):
    mass, speed, depth = 0.3, 4.4, 2e-3
    deepest, kept = struck(mass, speed, design_contact(mass, speed, depth, e, 1000.0))
    # Of first order in the step: a thousandth of the contact
    assert kept == pytest.approx(e, abs=3e-3)
    assert deepest == pytest.approx(np.sqrt(e) * depth, rel=3e-3)


def test_the_reserve_of_a_damped_contact_holds_the_weight_too():
    for e in (0.2, 0.5, 0.8):
        deepest, _ = struck(0.3, 1.0, design_contact(0.3, 1.0, 1e-3, e, 30.0), gravity=9.81)
        assert deepest < 1e-3


def test_ten_steps_per_contact_are_stable_down_to_a_restitution_of_a_twentieth():
    stiffness, damping, dt = design_contact(1.0, 2.0, 0.01, np.array([0.05, 0.5, 1.0]), 10.0)
    assert np.all(dt < penalty_step_limit(1.0, stiffness, damping))


def test_many_contacts_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(5)
    given = rng.uniform(0.1, 1.0, size=(5, 4, 3))
    together = design_contact(*given)
    for at in np.ndindex(4, 3):
        one = [float(value) for value in design_contact(*given[:, *at])]
        assert [value[at] for value in together] == pytest.approx(one, rel=1e-14)
    assert together[1] == pytest.approx(penalty_damping(given[3], given[0], together[0]), rel=1e-14)


@pytest.mark.parametrize("place", range(5))
@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan, np.inf])
def test_what_is_not_positive_and_finite_is_refused_by_name(place, wrong):
    names = ("mass", "speed", "depth", "restitution", "steps_per_contact")
    given = [1.0, 2.0, 0.01, 0.5, 20.0]
    given[place] = wrong
    with pytest.raises(ValueError, match=f"{names[place]} must be"):
        design_contact(*given)


def test_a_restitution_above_1_is_refused():
    with pytest.raises(ValueError, match="restitution must be from 0 to 1"):
        design_contact(1.0, 2.0, 0.01, 1.5, 20.0)
