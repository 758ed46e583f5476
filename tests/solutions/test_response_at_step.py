"""A step that responds at its start, beside two loops that do the same three things in another order."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.detection import side_of_plane
from solutions.forces import ballistic_motion, semi_implicit_euler
from solutions.response import kinematic_response, respond_at_step

G = 9.81
UP = np.array([0.0, 0.0, 1.0])
PULL = -G * UP


@pytest.mark.statement(6, oracle="arithmetic by hand")
def test_a_ball_behind_the_plane_turns_round_and_its_weight_is_carried():
    # −2 m/s becomes 1 m/s, and moves the ball for the whole second; the weight of 2 m/s² changes nothing
    position, velocity = respond_at_step((0, 0, -2), (3, 0, -2), (0, 0, -2), UP, True, 0.5, 1.0)
    assert position.tolist() == [3.0, 0.0, -1.0]
    assert velocity.tolist() == [3.0, 0.0, 1.0]


def test_the_plane_carries_only_what_presses_the_ball_onto_it():
    along, away = [respond_at_step((0, 0, 0), (0, 0, -2), a, UP, True, 0.5, 1.0) for a in ((1, 0, -8), (0, 0, 3))]
    assert [part.tolist() for part in along] == [[1.0, 0.0, 1.0]] * 2
    assert [part.tolist() for part in away] == [[0.0, 0.0, 4.0]] * 2


@pytest.mark.parametrize(
    ("behind", "speed"), [(False, -1.0), (False, 1.0), (True, 1.0), (True, 0.0)], ids=["in", "away", "out", "at rest"]
)
def test_a_ball_in_front_or_not_on_its_way_in_takes_a_free_step(behind, speed):
    position, velocity = respond_at_step((0, 0, 5), (1, 0, speed), (0, 0, -2), UP, behind, 0.5, 0.5)
    assert velocity.tolist() == [1.0, 0.0, speed - 1]
    assert position.tolist() == [0.5, 0.0, 5 + (speed - 1) / 2]


def test_each_ball_of_a_call_is_answered_by_itself():
    after = respond_at_step((0, 0, 0), [(0, 0, -2), (0, 0, -2), (0, 0, 2)], -2 * UP, UP, [True, False, True], 0.5, 1.0)
    assert after[1][:, 2].tolist() == [1.0, -4.0, 0.0]


# Three orders of one loop


def respond_then_step(position, velocity, e, dt):
    behind = side_of_plane(position[:, 2]) < 0
    return respond_at_step(position, velocity, PULL, UP, behind, e, dt)


def step_then_respond(move):
    def step(position, velocity, e, dt):
        position, velocity = move(position, velocity, PULL, dt)
        behind = side_of_plane(position[:, 2]) < 0
        return position, np.where(behind[:, None], kinematic_response(velocity, UP, e), velocity)

    return step


def mean_apex_error(step, e, dt, drops=400):
    """First apex less e² h, m, on average over drops from 1 m that meet the floor at every phase of a step."""
    phases = (np.arange(drops) + 0.5) / drops - 0.5
    heights = G * (np.sqrt(2 / G) + phases * dt) ** 2 / 2
    position, velocity = np.outer(heights, UP), np.zeros((drops, 3))
    for _ in range(round(0.6 / dt)):  # 0.45 s of fall and some flight, before the apex and the second impact
        before = position
        position, velocity = step(position, velocity, e, dt)
    rise, place = position[:, 2] - before[:, 2], (position[:, 2] + before[:, 2]) / 2
    # The parabola through the last two places: its slope half-way between them, and its height there
    apex = place + G * dt**2 / 8 + (rise / dt) ** 2 / (2 * G)
    return np.mean(apex - e**2 * heights)


@pytest.mark.statement(3, oracle="e² h, and −(1 − e) v Δt/2")
@pytest.mark.statement(6, oracle="e² h, and −(1 − e) v Δt/2")
@pytest.mark.parametrize(
    ("step", "factor", "percent"),
    [
        (respond_then_step, lambda e: 1 - e, -4.4),
        (step_then_respond(ballistic_motion), lambda e: 1 - e**2, -6.6),
        (step_then_respond(semi_implicit_euler), lambda e: 1 + e, -13.3),
    ],
    ids=["respond, then step", "fly, then respond", "step, then respond"],
)
def test_three_orders_of_the_loop_miss_the_apex_by_three_amounts(step, factor, percent):
    v = np.sqrt(2 * G)
    # 0.01 mm: the next order is some g Δt².
    for e in (0.2, 0.5, 0.8):
        assert mean_apex_error(step, e, 1e-3) == pytest.approx(-factor(e) * v * 1e-3 / 2, abs=1e-5)
    assert 100 * mean_apex_error(step, 0.5, 0.01) / 0.25 == pytest.approx(percent, abs=0.15)
