"""Numbers of a throw: they do not depend on where the samples lie, and a throw that is too short has none."""

from __future__ import annotations

import numpy as np
import pytest

from reference.catalogue import throws
from reference.errors import RunFailed
from reference.scene.forces import Force
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

VELOCITY, PUSH = np.array([3.0, -2.0, 6.0]), np.array([1.0, 0.5, 1.0])
PULL = np.array([0.0, 0.0, -9.81]) + PUSH / 2.0
BALL = Body("ball", Sphere(0.1), 2.0, (1.0, 2.0, 3.0), velocity=tuple(VELOCITY))
SCENE = Scenario("throw", (BALL,), (), 2.0, forces=(Force("ball", tuple(PUSH)),))


def thrown(times: np.ndarray) -> Trajectory:
    places = np.array(BALL.position) + VELOCITY * times[:, None] + PULL * times[:, None] ** 2 / 2
    still = np.zeros((len(times), 1, 3))
    turns = np.tile([1.0, 0.0, 0.0, 0.0], (len(times), 1, 1))
    return Trajectory(SCENE, Settings(1e-3), "made up", times, places[:, None], turns, still, still)


@pytest.mark.parametrize(
    "times", [np.linspace(0, 1.5, 11), np.linspace(0, 1.4, 1000), np.array([0, 0.2, 0.3, 1.2, 1.5])]
)
def test_apex_and_landing_are_those_of_the_flight_wherever_the_samples_lie(times):
    flight = -2 * VELOCITY[2] / PULL[2]
    when, height = throws.apex(thrown(times), "ball")
    assert when == pytest.approx(flight / 2, abs=1e-12)
    assert height == pytest.approx(VELOCITY[2] ** 2 / -PULL[2] / 2, abs=1e-12)
    way = VELOCITY * flight + PULL * flight**2 / 2
    np.testing.assert_allclose(throws.landing(thrown(times), "ball"), way, atol=1e-12)


def test_a_ball_that_still_rises_has_no_apex_and_one_in_the_air_no_landing():
    with pytest.raises(RunFailed, match="ball still rises at the end"):
        throws.apex(thrown(np.linspace(0, 0.3, 11)), "ball")
    with pytest.raises(RunFailed, match="ball is not back at the height of its launch"):
        throws.landing(thrown(np.linspace(0, 1.0, 11)), "ball")
