"""Closed forms of the impacts of two bodies and of rows of balls."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference import truth

# Impacts of two bodies


def test_the_softness_of_a_rod_agrees_with_the_sum_of_its_parts():
    # A bar of 2 kg, cut into 2000 × 80 cells; its moment about the centre by adding them up, to 1e-6 of it.
    x, z = np.meshgrid((np.arange(2000) + 0.5) / 2000 - 0.5, 0.04 * ((np.arange(80) + 0.5) / 80 - 0.5))
    moment = 2.0 * np.mean(x**2 + z**2)
    for arm in (0.0, 0.2, 0.5):
        softness = 1 / 2.0 + arm**2 / moment  # what a unit impulse does to the centre, and the spin adds at the arm
        assert truth.rod_softness(2.0, arm, 0.5, 0.02) == pytest.approx(softness, rel=1e-6)
    assert truth.rod_softness(1.0, 0.5, 0.5, 0.0) == pytest.approx(4.0, rel=1e-15)  # the end of a thin rod


@given(
    offset=st.floats(0, 1),
    e=st.floats(0, 1),
    mass=st.floats(0.1, 10),
    other=st.floats(0.1, 1e6),
    speed=st.floats(0.1, 9),
)
def test_two_balls_keep_momentum_and_part_with_e_times_the_closing_speed(offset, e, mass, other, speed):
    after, other_after = truth.balls_after(speed, offset, e, mass, other)
    before = np.array([speed, 0.0])
    normal = np.array([-math.sqrt((1 - offset) * (1 + offset)), offset])
    across = np.array([normal[1], -normal[0]])
    near = 1e-12 * speed  # rounding of numbers up to the speed
    assert mass * after + other * other_after == pytest.approx(mass * before, abs=near * (mass + other))
    assert (after - other_after) @ normal == pytest.approx(-e * (before @ normal), abs=near)
    assert after @ across == pytest.approx(before @ across, abs=near)
    assert other_after @ across == pytest.approx(0.0, abs=near)


def test_equal_elastic_balls_part_at_a_right_angle_or_the_striker_stops():
    for offset in (0.1, 0.5, 0.9):
        after, other_after = truth.balls_after(2.0, offset, 1.0, 1.5, 1.5)
        assert after @ other_after == pytest.approx(0.0, abs=1e-15)
    assert truth.balls_after(2.0, 0.0, 1.0, 1.5, 1.5)[0] == pytest.approx([0.0, 0.0], abs=1e-15)


@pytest.mark.parametrize("velocities", [(1, 0, 0, 0, 0), (1, 1, 0, 0, 0), (1, 0, 0.1), (3, -1, 2, 0.5)])
def test_balls_that_swap_velocities_two_at_a_time_end_up_in_order(velocities):
    swapped = list(velocities)
    while any(a > b for a, b in itertools.pairwise(swapped)):
        i = next(i for i in range(len(swapped) - 1) if swapped[i] > swapped[i + 1])
        swapped[i], swapped[i + 1] = swapped[i + 1], swapped[i]
    assert truth.cradle_in_turn(np.array(velocities, dtype=float)).tolist() == swapped


@pytest.mark.parametrize(
    ("velocities", "struck"),
    [((1, 0, 0), 0), ((1, 0, 0, 0, 0), 0), ((1, 1, 0, 0, 0), 1), ((1, 0, 0.1), 0), ((1, 0, 0.5), 0)],
)
def test_simultaneous_impacts_keep_momentum_and_obey_newton_everywhere(velocities, struck):
    before = np.array(velocities, dtype=float)
    after = truth.cradle_at_once(before, struck)
    pushes = np.cumsum(before - after)  # what ball i gives to the next: all that the balls up to i have lost
    parting, closing = np.diff(after), np.maximum(-np.diff(before), 0.0)
    assert pushes[-1] == pytest.approx(0, abs=1e-15)  # momentum
    assert np.all(pushes[:-1] > 0)
    assert parting == pytest.approx(closing, abs=1e-15)  # every contact pushes, so that none parts faster than it must


def test_five_simultaneous_balls_agree_with_the_lecture():
    assert truth.cradle_at_once(np.array([1.0, 0, 0, 0, 0]), 0) == pytest.approx([-0.6, 0.4, 0.4, 0.4, 0.4], abs=1e-15)
    made = truth.cradle_at_once(np.array([1.0, 0.0, 0.1]), 0)
    assert made == pytest.approx([-0.3, 0.7, 0.7], abs=1e-15)
    assert float(made @ made) / 2 == pytest.approx(0.535, abs=1e-15)  # of 0.505


@given(closing=st.floats(0.01, 5), parting=st.floats(0.01, 5))
def test_reversing_every_contact_keeps_momentum_and_energy(closing, parting):
    before = np.array([closing, 0.0, parting])
    after = truth.cradle_turned_back(before)
    assert after.sum() == pytest.approx(before.sum(), rel=1e-14)
    assert float(after @ after) == pytest.approx(float(before @ before), rel=1e-13)


@pytest.mark.parametrize("e", [0.2, 0.5, 0.9, 1.0])
def test_a_contact_noticed_late_misses_e_by_less_than_its_bound(e):
    stiffness, speed = 1e6, 2.0
    ratio = truth.damping_ratio(e)
    for late in (5e-5, 1e-4, 2e-4):
        depth, velocity, dt = speed * late, speed, 1e-7
        while True:
            pull = stiffness * depth + 2 * ratio * math.sqrt(stiffness) * velocity
            if pull <= 0 or depth < 0:
                break
            velocity -= pull * dt
            depth += velocity * dt
        # The little steps: √k dt is 1e-4.
        assert abs(-velocity - e * speed) < truth.coarse_contact(e, stiffness, late) * speed + 1e-3 * speed
    assert truth.coarse_contact(e, math.inf, 1e-3) == 0.0
    assert truth.coarse_contact(0.0, stiffness, 1e-4) == pytest.approx(0.005, rel=1e-12)
