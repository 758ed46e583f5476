"""Impulses that other people published, by hand, and what is behind the figures."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.published.theirs import published
from solutions.impulse import Body, collide, impulse_of_force

UP, STILL = np.array([0.0, 0.0, 1.0]), (0.0, 0.0, 0.0)
FLOOR = Body(STILL, STILL, STILL, 0.0, np.zeros((3, 3)))


@pytest.mark.statement(13, oracle="P21: a textbook's bounce")
def test_p21_a_ball_receives_the_impulse_that_the_textbook_gives(as_published):
    found, case = as_published("P21"), published("P21")
    mass, gravity, height = case.values("mass", "gravity", "height")
    # Any force with that mean over the contact leaves the same impulse behind: here the floor's, less the weight
    held = np.array([(found["contact_force"][0] - mass * gravity) * UP] * 2)
    left = impulse_of_force(held, [0, case.value("contact_time")])[2]
    assert left == pytest.approx(case.expected["impulse"], abs=5e-5)
    # And the ball leaves with the speed that carries it to the height it was seen to reach
    ball = Body(-math.sqrt(2 * gravity * height) * UP, STILL, STILL, 1 / mass, np.zeros((3, 3)))
    leaving, *_ = collide(ball, FLOOR, UP, found["restitution"][0])
    # Two square roots and back: a few roundings
    assert leaving[2] ** 2 / (2 * gravity) == pytest.approx(case.value("rebound"), rel=1e-14)


@pytest.mark.statement(20, oracle="P22: OpenStax's elastic bounce")
@pytest.mark.parametrize("gravity", [9.8, 9.81])
def test_p22_an_elastic_bounce_changes_the_momentum_as_in_the_book(gravity, as_published):
    as_published("P22", gravity=gravity)


@pytest.mark.statement(20, oracle="P27: Chrono's colliding balls")
def test_p27_two_balls_of_any_mass_part_with_the_given_restitution(as_published):
    for mass in (1e-3, 1.0, 1e3):
        # An impulse is exact, but for a few roundings of the two velocities
        assert as_published("P27", mass=mass)["restitution"] == pytest.approx([0, 0.25, 0.5, 0.75, 1], abs=1e-14)
