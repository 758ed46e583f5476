"""Our own functions on impulses that other people published."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.published import published
from solutions.impulse import Body, collide, energy_lost, impulse_magnitude, impulse_of_force, mean_force

UP, STILL = np.array([0.0, 0.0, 1.0]), (0.0, 0.0, 0.0)
FLOOR = Body(STILL, STILL, STILL, 0.0, np.zeros((3, 3)))


def dropped(mass: float, height: float, gravity: float) -> Body:
    return Body(-math.sqrt(2 * gravity * height) * UP, STILL, STILL, 1 / mass, np.zeros((3, 3)))


@pytest.mark.statement(13, oracle="P21: a textbook's bounce")
def test_p21_a_ball_takes_from_the_floor_what_the_textbook_says():
    case = published("P21")
    mass, gravity = case.setup["mass"], case.setup["gravity"]
    e = math.sqrt(case.setup["rebound"] / case.setup["height"])
    ball = dropped(mass, case.setup["height"], gravity)
    j = impulse_magnitude(ball, FLOOR, UP, e)
    weight, duration = -mass * gravity * UP, case.setup["contact_time"]
    found = {
        "restitution": e,
        "impulse": j,
        "energy_change": -energy_lost(ball, FLOOR, UP, e),
        "net_force": mean_force(j * UP, duration)[2],
        "contact_force": mean_force(j * UP, duration, weight)[2],
    }
    assert found.keys() == case.expected.keys()
    for name, value in case.expected.items():
        assert found[name] == pytest.approx(value, abs=case.tolerance[name]), name
    # Any force with that mean over the contact leaves the same impulse behind: here the floor's, less the weight
    held = np.array([found["contact_force"] * UP + weight] * 2)
    assert impulse_of_force(held, [0, duration])[2] == pytest.approx(case.expected["impulse"], abs=5e-5)
    # And the ball leaves with the speed that carries it to the height it was seen to reach
    leaving, *_ = collide(ball, FLOOR, UP, e)
    # Two square roots and back: a few roundings
    assert leaving[2] ** 2 / (2 * gravity) == pytest.approx(case.setup["rebound"], rel=1e-14)


@pytest.mark.statement(20, oracle="P22: OpenStax's elastic bounce")
@pytest.mark.parametrize("gravity", [9.8, 9.81])
def test_p22_an_elastic_bounce_changes_the_momentum_by_what_the_book_says(gravity):
    case = published("P22")
    ball = dropped(case.setup["mass"], case.setup["height"], gravity)
    found = impulse_magnitude(ball, FLOOR, UP, 1.0)
    assert found == pytest.approx(case.expected["impulse"], abs=case.tolerance["impulse"])
