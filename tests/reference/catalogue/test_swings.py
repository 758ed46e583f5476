"""Numbers of a swing: a curve through the samples finds what lies between them."""

from __future__ import annotations

import numpy as np
import pytest

from reference.catalogue import swings
from reference.errors import RunFailed
from reference.scene.forces import Spring
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

TIMES = np.linspace(0, 3, 401)
SWING = np.exp(-TIMES) * np.sin(4 * TIMES)
TURN = np.arctan(4) / 4  # where the derivative is zero: tan 4t = 4


def test_a_turn_and_a_value_between_samples_are_those_of_the_curve():
    when, size = swings.first_turn(TIMES, SWING)
    # (ω dt)⁶ = (4 · 7.5 ms)⁶ = 10⁻⁹ of the swing; a time, from the slope, one order less
    assert when == pytest.approx(TURN, abs=1e-8)
    assert size == pytest.approx(np.exp(-TURN) * np.sin(4 * TURN), abs=1e-9)
    for time in (0.0, 0.001, 1.2345, 3.0):
        assert swings.at(TIMES, SWING, time) == pytest.approx(np.exp(-time) * np.sin(4 * time), abs=1e-9)


def test_the_last_time_beyond_a_limit_is_found_on_either_side():
    for side in (1, -1):
        time = swings.last_beyond(TIMES, side * SWING, 0.1)
        assert abs(np.exp(-time) * np.sin(4 * time)) == pytest.approx(0.1, abs=1e-9)
        assert np.abs(SWING[time < TIMES]).max() < 0.1


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: swings.at(TIMES, SWING, 3.1), "the run ends at 3 s"),
        (lambda: swings.first_turn(TIMES, TIMES), "still growing at the end"),
        (lambda: swings.last_beyond(TIMES, TIMES, 0.1), "no last time"),
        (lambda: swings.last_beyond(TIMES, SWING, 2.0), "no last time"),
    ],
)
def test_a_swing_without_such_a_number_says_so(ask, message):
    with pytest.raises(RunFailed, match=message):
        ask()


def test_a_spring_ends_at_its_points_also_on_a_ball_that_turns():
    ball = Body("ball", Sphere(0.1), 1.0, (0.0, 0.0, 0.0))
    scene = Scenario(
        "end", (ball,), (), 1.0, springs=(Spring("ball", "", 1.0, 0.0, 0.0, (1.0, 0.0, 0.0), (4.0, 0, 0)),)
    )
    one = np.ones(2)[:, None, None]
    spin, quarter = np.array([0.0, 0.0, 2.0]), np.array([np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)])
    run = Trajectory(
        scene,
        Settings(1.0),
        "made up",
        np.arange(2.0),
        0 * one + np.zeros(3),
        one * quarter,
        0 * one + [0.0, 3.0, 0.0],
        one * spin,
    )
    length, rate = swings.length(run)
    # The point is at (0, 1, 0) and moves with (−2, 3, 0); from the fixed end it lies in the direction (−4, 1, 0)/√17.
    assert length == pytest.approx(np.sqrt(17.0))
    assert rate == pytest.approx((8.0 + 3.0) / np.sqrt(17.0))
